// The documentation's first page, which runs the library: KINESPHERE_SITE names the folder of the site, as
// `scripts/docs.sh --viewer` makes it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { gzipSync } from "node:zlib";

import { browserForTests, importSource } from "./page.mjs";

const site = process.env.KINESPHERE_SITE;
const isReady = () => window.kinesphereLive?.discs !== undefined;
const desktop = { viewport: { width: 1440, height: 900 } };
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const inBrowser = browserForTests({ site, isReady, ...desktop });
const discs = (page, f, given) => page.evaluate(`(${f})(window.kinesphereLive.discs, ${JSON.stringify(given)})`);
const state = (page) => discs(page, ({ simulation, run, playing, moment, address }) =>
  ({ time: simulation.time, hash: simulation.hash, tally: simulation.tally, probes: simulation.view.counters.probes, whole: run.hash,
     playing, moment, address }));
const loaded = (page) => page.evaluate(() => [location.href, ...performance.getEntriesByType("resource").map(({ name }) => name)]);

test("the first screen takes at most 400 KB, and the index of the search waits for a search", async () => {
  const page = await inBrowser.open();
  await page.waitForLoadState("networkidle");
  const paths = (await loaded(page)).map((name) => new URL(name).pathname).map((path) => path === "/" ? "index.html" : path.slice(1));
  const sizes = paths.map((path) => [path, gzipSync(readFileSync(join(site, path))).length]);
  const sum = sizes.reduce((all, [, size]) => all + size, 0);
  assert.ok(sum <= 400_000, `${sum} bytes: ${sizes.map((one) => one.join(" ")).join(", ")}`);
  assert.ok(!paths.some((path) => path.includes("search_index")));
  assert.deepEqual(await page.locator("h1").allTextContents(), ["Kinesphere 1.0.0"]);
  await page.locator("[data-md-component='search-query']").click();
  await page.keyboard.type("certificate");
  await page.locator(".md-search-result__item").first().waitFor();
});

test("it plays, and its numbers are those of the library", async () => {
  const page = await inBrowser.open();
  await page.waitForFunction(() => window.kinesphereLive.discs.simulation.time > 0.02);
  const { wholeRun, load } = await importSource("site/whole_run.ts");
  await load();
  for (const [where, choice] of [["", { width: 24, height: 9, seed: 4 }], ["?seed=2&shape=tall&t=0", { width: 12, height: 9, seed: 2 }]]) {
    const page = await inBrowser.open(where);
    const expected = wholeRun(choice);
    await discs(page, (demo) => { demo.setPlaying(false); demo.goTo(4); });
    const { hash, probes, tally, whole } = await state(page);
    assert.deepEqual([hash, whole, probes], [expected.hash, expected.hash, expected.probes]);
    const pairs = expected.contacts.filter(({ ofTwo }) => ofTwo);
    assert.ok(tally.missed > 5);
    assert.deepEqual([tally.contacts, tally.missed], [pairs.length, pairs.filter(({ missed }) => missed).length]);
    const shown = await page.evaluate(() => Object.fromEntries(Array.from(document.querySelectorAll("[data-number]"), (cell) =>
      [cell.dataset.number, Number(cell.textContent.replaceAll(",", ""))])));
    const looks = 241 * (choice.width === 24 ? 12 : 6);
    assert.deepEqual(shown, { found: pairs.length, seen: pairs.length - tally.missed, missed: tally.missed, asked: probes, looks });
  }
});

test("going back and forth in time changes nothing", async () => {
  const page = await inBrowser.open();
  await discs(page, (demo) => { demo.setPlaying(false); for (const time of [3, 1.234, 1.2, 0, 2.5, 4]) demo.goTo(time); });
  const { hash, whole } = await state(page);
  assert.equal(hash, whole);
});

test("a link shows everybody the same moment, and nonsense in it does no harm", async () => {
  let page = await inBrowser.open("?shape=wide&seed=12&t=1.25");
  const first = await state(page);
  assert.deepEqual([first.time, first.playing, first.moment.seed], [1.25, false, 12]);
  page = await inBrowser.open(first.address, phone);
  const second = await state(page);
  assert.deepEqual([second.time, second.hash, second.probes, second.moment], [1.25, first.hash, first.probes, first.moment]);
  page = await inBrowser.open("?shape=round&seed=-3&t=soon");
  const { moment, playing } = await state(page);
  assert.deepEqual([moment, playing], [{ shape: "wide", seed: 4, time: null, view: "all" }, true]);
});

test("as a loop sees it, discs stand still from look to look", async () => {
  const page = await inBrowser.open("?t=1.001");
  const picture = (time) => discs(page, (demo, time) => {
    demo.goTo(time);
    return document.querySelector(".live-canvas").toDataURL();
  }, time);
  // Between the looks at 60/60 and 61/60 of a second.
  assert.notEqual(await picture(1.001), await picture(1.015));
  await page.getByRole("button", { name: "As 60 Hz sees it" }).click();
  assert.equal(await picture(1.001), await picture(1.015));
  assert.notEqual(await picture(1.015), await picture(1.018));
  const { address } = await state(page);
  const linked = await inBrowser.open(address);
  assert.equal((await state(linked)).moment.view, "loop");
  assert.equal(await linked.getByRole("button", { name: "As 60 Hz sees it" }).getAttribute("aria-pressed"), "true");
});

for (const options of [desktop, phone])
  test(`side by side, both are seen at the same time, ${options.viewport.width} wide`, async () => {
    const page = await inBrowser.open("?t=1.001", options);
    const pictures = () => page.evaluate(() => Array.from(document.querySelectorAll(".live-canvas"),
      (canvas) => (canvas.clientWidth === 0 ? null : canvas.toDataURL())));
    assert.equal((await pictures())[1], null);
    await page.getByRole("button", { name: "Side by side" }).click();
    await discs(page, (demo) => demo.goTo(1.002));
    const [all, loop] = await pictures();
    assert.notEqual(all, loop);
    const address = (await state(page)).address;
    await discs(page, (demo) => demo.goTo(1.015));
    const [later, stillLoop] = await pictures();
    assert.equal(loop, stillLoop);
    assert.notEqual(all, later);
    await discs(page, (demo) => demo.goTo(1.018));
    assert.notEqual((await pictures())[1], loop, "after the next look");
    const boxes = await page.evaluate(() => Array.from(document.querySelectorAll(".live-views figure"), (each) => each.getBoundingClientRect().toJSON()));
    assert.ok(boxes.every(({ left, right }) => left >= 0 && right <= options.viewport.width), JSON.stringify(boxes));
    assert.equal((await state(await inBrowser.open(address, options))).moment.view, "both");
  });

test("copies the link of the moment", async () => {
  const page = await inBrowser.open("?t=0.5", { permissions: ["clipboard-read", "clipboard-write"] });
  await page.getByRole("button", { name: "Next contact" }).click();
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.getByRole("button", { name: "Copied" }).waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const { time } = await state(page);
  assert.ok(time > 0.5);
  assert.ok(Math.abs(Number(new URL(link).searchParams.get("t")) - time) <= 5e-5, link);
});

test("by keyboard it plays, pauses, goes on to the next contact and through time", async () => {
  const page = await inBrowser.open("?t=1");
  const press = async (name, key) => { await page.getByRole("button", { name }).focus(); await page.keyboard.press(key); };
  await press("Play", "Enter");
  assert.equal((await state(page)).playing, true);
  await press("Pause", "Space");
  const { time, tally } = await state(page);
  await press("Next contact", "Enter");
  const next = await state(page);
  assert.ok(next.time > time && next.tally.contacts > tally.contacts && !next.playing);
  await page.getByRole("slider", { name: "Time" }).focus();
  await page.keyboard.press("ArrowRight");
  assert.ok((await state(page)).time > next.time);
});

test("who prefers reduced motion sees a picture that stands still", async () => {
  const page = await inBrowser.open("", { reducedMotion: "reduce" });
  const { time, playing } = await state(page);
  await page.waitForTimeout(300);
  assert.deepEqual([playing, (await state(page)).time], [false, time]);
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction((time) => window.kinesphereLive.discs.simulation.time > time, time);
});

test("the picture follows the dark switch of the page, whatever the system says", async () => {
  const page = await inBrowser.open("?t=1", { colorScheme: "light" });
  const corner = () => page.evaluate(() => {
    const canvas = document.querySelector(".live-canvas");
    return Array.from(canvas.getContext("2d").getImageData(10, canvas.height - 10, 1, 1).data.slice(0, 3));
  });
  assert.deepEqual(await corner(), [255, 255, 255]);
  await page.locator("label[title='Dark']").click();
  await page.waitForFunction(() => document.body.dataset.mdColorScheme === "slate");
  assert.deepEqual(await corner(), [15, 22, 34]);
});

test("drawings follow the switch, too", async () => {
  const page = await inBrowser.open("", { colorScheme: "light" });
  await page.locator("label[title='Dark']").click();
  await page.goto(`${inBrowser.address}lessons/the-idea.html`);
  const picture = page.locator("img[src$='bound.svg']");
  const png = (await picture.screenshot()).toString("base64");
  const middle = await page.evaluate(async (png) => {
    const image = Object.assign(new Image(), { src: `data:image/png;base64,${png}` });
    await image.decode();
    const context = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }).getContext("2d");
    context.drawImage(image, 0, 0);
    return Array.from(context.getImageData(20, image.height >> 1, 1, 1).data.slice(0, 3));
  }, png);
  assert.ok(Math.max(...middle) < 60, `${middle}`);
});

for (const [name, options] of [["phone", phone], ["desktop", desktop]]) {
  test(`on a ${name} the first screen has the picture and its numbers, and all can be hit`, async () => {
    const page = await inBrowser.open("", options);
    const { wide, bottoms, small } = await page.evaluate(() => {
      const box = (selector) => document.querySelector(selector).getBoundingClientRect();
      const targets = Array.from(document.querySelectorAll(".hero .md-button, .live-button, .live-slider input, .tabbed-labels label"));
      return {
        wide: document.documentElement.scrollWidth,
        bottoms: [".hero-buttons", ".live-canvas", ".live-table", ".live-timeline"].map((selector) => box(selector).bottom),
        small: targets.filter((target) => target.getBoundingClientRect().height < 44).map((target) => target.outerHTML),
      };
    });
    assert.equal(wide, options.viewport.width);
    assert.ok(Math.max(...bottoms) <= options.viewport.height, `${bottoms}`);
    if (name === "phone") assert.deepEqual(small, []);
    if (process.env.KINESPHERE_PICTURES !== undefined)
      await page.screenshot({ path: join(process.env.KINESPHERE_PICTURES, `first-page-${name}.png`) });
  });
}

test("there is an install line and a line of code for each language", async () => {
  const page = await inBrowser.open();
  const labels = await page.locator(".hero-install .tabbed-labels label").allTextContents();
  assert.deepEqual(labels, ["C++", "Python", "JavaScript", "C", "Rust", "C#", "no code"]);
  await page.locator(".hero-install .tabbed-labels label", { hasText: "Python" }).click();
  const shown = await page.locator(".hero-install .tabbed-block:visible code").allTextContents();
  assert.equal(shown[0], "for event in world.events(until, probe):");
  assert.match(shown[1], /pip install/);
});

test("it leads to the viewer", async () => {
  const page = await inBrowser.open();
  await page.getByRole("link", { name: "the viewer" }).click();
  await page.waitForFunction(() => window.kinesphereViewer?.pictures > 3, null, { timeout: 60_000 });
});

test("the reference of C++ follows the switch, leads back, and searches all pages, which find its names", async () => {
  const page = await inBrowser.open("", { colorScheme: "light" });
  const colour = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const reference = `${inBrowser.address}reference/cpp/classkinesphere_1_1World.html`;
  await page.goto(reference);
  assert.equal(await colour(), "rgb(255, 255, 255)");
  await page.goto(inBrowser.address);
  await page.locator("label[title='Dark']").click();
  await page.goto(reference);
  assert.equal(await colour(), "rgb(46, 48, 62)");
  await page.getByRole("searchbox").fill("GameWorld::set_gravity");
  await page.keyboard.press("Enter");
  await page.locator(".md-search-result__link[href*='reference/cpp/classkinesphere_1_1GameWorld.html?h=gameworld+set_gravity#']").first().click();
  await page.waitForURL(/classkinesphere_1_1GameWorld/);
  await page.getByRole("link", { name: "Kinesphere", exact: true }).click();
  await page.waitForFunction(() => window.kinesphereLive?.discs !== undefined);
});

test("the pages have complained of nothing, and asked nobody else", () => {
  assert.deepEqual(inBrowser.complaints, []);
});

test("it runs from a folder of files, too", async () => {
  const page = await inBrowser.open(pathToFileURL(join(site, "index.html")).href);
  await page.waitForFunction(() => window.kinesphereLive.discs.simulation.time > 0.02);
  assert.equal(await page.getByRole("link", { name: "the viewer" }).count(), 0, "it would not run there");
  assert.match(await page.textContent(".hero-legend"), /the viewer, where a server has these files/);
});

test("the reference of C++ is dark as the system is, from a folder of files, too, where nothing can search", async () => {
  const page = await inBrowser.open();
  await page.goto(pathToFileURL(join(site, "reference/cpp/index.html")).href);
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(46, 48, 62)");
  assert.equal(await page.getByRole("searchbox").count(), 0);
});

test("without Emscripten the first screen has the film, and says so", () => {
  const page = `<h1 id="k">K</h1><p>S.</p><p><picture><img src="film.svg"></picture></p><p>Rest</p><h2 id="in">In</h2><table><tbody>
    <tr><td>Python</td><td><code>environment/bin/pip install --no-build-isolation ./python</code></td><td><code>f()</code></td>
    <td><a href="python.html">more</a></td></tr></tbody></table>`;
  const made = (page) => execFileSync("python3", ["-c", "import sys, hero; print(*hero.split(sys.stdin.read(), '1.0', False, False))"],
    { input: page, cwd: fileURLToPath(new URL("../../../scripts/docs", import.meta.url)), stdio: "pipe" }).toString();
  assert.match(made(page), /film\.svg.*The picture is a recording: this site was built without Emscripten/s);
  assert.throws(() => made(page.replace("--no-build-isolation", "--fast")), /python\.md does not have the command of Python: .*--fast/);
});
