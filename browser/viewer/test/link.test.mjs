// Links to a moment of the viewer, its timeline, and the picture that it saves.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

import { browserForTests, importSource } from "./page.mjs";

const inBrowser = browserForTests();
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const state = (page) => page.evaluate(() => {
  const { simulation, settings, stage } = window.kinesphereViewer;
  const { playing, ...rest } = settings;
  return { time: simulation.time, hash: simulation.hash, playing, settings: structuredClone(rest),
           camera: stage.cameraPlace.map((place) => Number(place.toPrecision(5))) };
});
const arrived = (page, time) =>
  page.waitForFunction((time) => window.kinesphereViewer.simulation.time === time, time, { timeout: 60_000 });
const message = (page) => page.locator("#message-text").textContent();

test("a copied link shows the same moment elsewhere", async () => {
  let page = await inBrowser.open("", { permissions: ["clipboard-read", "clipboard-write"] });
  await page.evaluate(() => {
    const viewer = window.kinesphereViewer;
    viewer.choose("gas");
    Object.assign(viewer.settings, { bodies: 90, seed: 17, speed: 0.75, colouring: "safe", theme: "bright" });
    viewer.restart();
    Object.assign(viewer.settings.overlays, { bounds: true, trails: false });
    viewer.stage.lookAs([10, -80, 30, 5, 6, 7]);
    viewer.seek(1.625);
  });
  await arrived(page, 1.625);
  const before = await state(page);
  await page.getByRole("button", { name: "Copy a link" }).click();
  await page.waitForFunction(() => document.querySelector("#message-text").textContent !== "");
  assert.equal(await message(page), "Copied: the link leads to this moment.");
  const address = await page.evaluate(() => navigator.clipboard.readText());
  page = await inBrowser.open(address, phone);
  await arrived(page, 1.625);
  assert.deepEqual(await state(page), before);
});

test("the same moment is the same in another engine", async () => {
  const page = await inBrowser.open("#scene=missed&seed=5&t=1.5");
  await arrived(page, 1.5);
  const { Simulation, load } = await importSource("simulation.ts");
  const { setUp, sceneAbout } = await importSource("scenes/list.ts");
  await load();
  for (const name of ["missed", "rigid", "game"]) {
    await page.evaluate((name) => { location.hash = `scene=${name}&seed=5&t=0.5`; }, name);
    await page.waitForFunction((name) => window.kinesphereViewer.settings.scene === name, name);
    await arrived(page, 0.5);
    const simulation = new Simulation(setUp({ name, bodies: sceneAbout(name).bodies, seed: 5 }, null), sceneAbout(name));
    simulation.run(0.5);
    assert.equal((await state(page)).hash, simulation.hash, name);
    assert.notEqual(simulation.tally.contacts, 0);
  }
});

test("a link that is wrong says what is, and the page goes on", async () => {
  for (const [link, said] of [
    ["scene=gases", /The link's scene must be one of missed, .*, but is gases/],
    ["bodies=3", /The link's bodies must be a number from 10 to 10000, but is 3/],
    ["seed=2.5", /The link's seed must be a whole number, but is 2.5/],
    ["t=soon", /The link's t must be a number from /],
    ["camera=1,2,3", /The link's camera must be six numbers, but is 1,2,3/],
    ["show=contacts,ghosts", /The link's show must be one of .*, but is ghosts/],
    ["colour=red", /The link's colour must be one of size, asked, safe, but is red/],
    ["sceen=gas", /The link has an unknown part: sceen/],
  ]) {
    const page = await inBrowser.open(`#${link}`);
    assert.match(await message(page), said);
    const { settings, playing } = await state(page);
    assert.deepEqual([settings.scene, settings.seed, playing], ["missed", 1, true]);
  }
});

test("throws are not in the link, which says so", async () => {
  const page = await inBrowser.open("#scene=gas&bodies=50&t=0.25", { permissions: ["clipboard-read", "clipboard-write"] });
  await arrived(page, 0.25);
  await page.evaluate(() => window.kinesphereViewer.simulation.setVelocity(3, [1, 2, 3]));
  await page.keyboard.press("k");
  await page.waitForFunction(() => document.querySelector("#message-text").textContent.includes("without your throws"));
});

test("the timeline leads back and forth, to the same events", async () => {
  const page = await inBrowser.open("#scene=gas&bodies=80&t=2");
  await arrived(page, 2);
  await page.waitForFunction(() => Number(document.querySelector("#timeline").max) === 2);
  const { hash } = await state(page);
  const slider = page.getByRole("slider", { name: "Time" });
  await slider.focus();
  await page.keyboard.press("Home");
  await arrived(page, 0);
  await slider.fill("1.5");
  await arrived(page, 1.5);
  await page.keyboard.press("End");
  await arrived(page, 2);
  assert.equal((await state(page)).hash, hash);
  // Keys of the page work beside it.
  await page.keyboard.press("Space");
  assert.equal((await state(page)).playing, true);
});

test("the picture is saved", async () => {
  const page = await inBrowser.open("#scene=missed&t=0.25");
  await arrived(page, 0.25);
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save the picture" }).click()]);
  assert.equal(download.suggestedFilename(), "kinesphere-what-60-hz-misses-0.250.png");
  const bytes = await readFile(await download.path());
  assert.equal(bytes.subarray(1, 4).toString(), "PNG");
  // An empty picture would be smaller.
  assert.ok(bytes.length > 20_000, `${bytes.length} bytes`);
});

test("marks differ in form, not in colour alone", async () => {
  const page = await inBrowser.open();
  const forms = await page.evaluate(() => Object.fromEntries(Array.from(document.querySelectorAll("#legend li"), (item) =>
    [item.textContent, item.querySelector("i").innerHTML.replace(/stroke="[^"]*"/, "") || item.querySelector("i").className])));
  const kinds = ["contact", "contact that 60 Hz misses", "where 60 Hz looks", "asked just now", "trail"].map((words) => forms[words]);
  assert.ok(kinds.every((kind) => kind !== undefined), JSON.stringify(forms));
  assert.equal(new Set(kinds).size, kinds.length);
});

test("the page has complained of nothing, and asked nobody else", () => {
  assert.deepEqual(inBrowser.complaints, []);
});
