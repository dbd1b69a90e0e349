// The lesson in two bodies on the documentation's site: KINESPHERE_SITE names the folder of the site.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

import { browserForTests, importSource } from "./page.mjs";

const site = process.env.KINESPHERE_SITE;
const isReady = () => window.kinesphereLive?.twoBodies !== undefined;
const inBrowser = browserForTests({ site, isReady, viewport: { width: 1440, height: 900 } });
const open = (query = "", options = {}) => inBrowser.open(`two-bodies.html${query}`, options);
const lesson = (page, f, given) => page.evaluate(`(${f})(window.kinesphereLive.twoBodies, ${JSON.stringify(given)})`);
const moment = (page) => lesson(page, ({ moment }) => moment);
const model = await importSource("site/two_bodies_life.ts");
await model.load();

test("what is certain of the gap is never above it, and the contact is where it is whatever is promised", () => {
  const begins = [];
  for (const limit of [0.52, 1, 2.5, 6]) {
    const { steps, samples } = model.lifeOf(limit);
    for (const { gap, certain } of samples) assert.ok(certain <= Math.max(gap, 0) + 1e-9, `${limit}: ${certain} > ${gap}`);
    assert.ok(samples.some(({ gap, certain }) => certain > 0.3 * gap));
    begins.push(steps.find(({ kind }) => kind === "begin").time);
    assert.deepEqual(steps.filter(({ kind }) => kind === "violation"), []);
  }
  for (const begin of begins) assert.ok(Math.abs(begin - begins[0]) < 1e-5, `${begins}`);
  const probes = [0.52, 6].map((limit) => model.lifeOf(limit).steps.filter(({ kind }) => kind === "probe").length);
  assert.ok(probes[1] > probes[0]);
});

test("a promise that is broken is told, or a contact may be missed", () => {
  const kinds = (limit) => new Set(model.lifeOf(limit).steps.map(({ kind }) => kind));
  assert.deepEqual(kinds(0.3), new Set(["probe", "violation", "begin", "end"]));
  assert.deepEqual(kinds(0.2), new Set(["probe"]));
});

test("until the due time nobody is asked", () => {
  for (const limit of [0.6, 1, 4])
    for (let time = 0; time < 3.5; time += 0.37) {
      const { due, probes } = model.momentOf(limit, time);
      assert.equal(model.momentOf(limit, Math.max(due - 1e-9, time)).probes, probes, `${limit}, ${time}, ${due}`);
    }
});

test("the page runs the library: steps and moments are those of the package", async () => {
  const page = await open("?limit=1.5&t=2.2");
  const { life, moment } = await lesson(page, ({ life, moment }) => ({ life, moment }));
  const expected = model.lifeOf(1.5);
  assert.equal(life.steps.length, expected.steps.length);
  // Sines may differ in their last bit from browser to browser.
  life.steps.forEach((step, k) => {
    assert.deepEqual({ ...step, time: 0 }, { ...expected.steps[k], time: 0 });
    assert.ok(Math.abs(step.time - expected.steps[k].time) < 1e-9);
  });
  assert.ok(Math.abs(moment.due - model.momentOf(1.5, 2.2).due) < 1e-9);
});

test("dragging the promise makes the bounds grow", async () => {
  const page = await open("?limit=1&t=1.2");
  const slider = page.getByRole("slider", { name: "Promise" });
  const grown = async () => (await moment(page)).bodies[0].boundRadius - 0.6;
  assert.ok(Math.abs(await grown() - 0.5 * 1 * 1.2 ** 2) < 1e-9);
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs(await grown() - 0.5 * 1.02 * 1.2 ** 2) < 1e-9);
  const box = await slider.boundingBox();
  await page.mouse.click(box.x + 0.5 * box.width, box.y + box.height / 2);
  const { limit, time, asked } = await lesson(page, ({ limit, moment }) => ({ limit, time: moment.time, asked: moment.probes }));
  assert.ok(limit > 2.9 && limit < 3.3 && time === 1.2 && asked > 0, `${limit}`);
});

test("by keyboard it goes from step to step, and says each", async () => {
  const page = await open("?limit=1&t=0", { reducedMotion: "reduce" });
  const { steps } = model.lifeOf(1);
  const said = page.locator(".live-said");
  const times = [...new Set(steps.map(({ time }) => time))];
  await page.getByRole("button", { name: "Next step" }).focus();
  for (const time of times) {
    await page.keyboard.press("Enter");
    assert.ok(Math.abs((await moment(page)).time - time) < 1e-9);
    assert.match(await said.textContent(), new RegExp(`^${time.toFixed(3)} s: `));
  }
  await page.keyboard.press("Enter");
  assert.equal((await moment(page)).time, 5);
  await page.getByRole("button", { name: "Step back" }).focus();
  await page.keyboard.press("Enter");
  assert.ok(Math.abs((await moment(page)).time - times.at(-1)) < 1e-9);
  await lesson(page, (lesson) => lesson.goTo(3));
  while (!/contact begins/.test(await said.textContent())) await page.getByRole("button", { name: "Next step" }).click();
});

test("steps and play go through the time between", async () => {
  const page = await open("?limit=1&t=0");
  const [first] = model.lifeOf(1).steps;
  await page.getByRole("button", { name: "Next step" }).click();
  assert.ok((await moment(page)).time < first.time);
  await page.waitForFunction((time) => Math.abs(window.kinesphereLive.twoBodies.moment.time - time) < 1e-9, first.time);
  await page.getByRole("button", { name: "Play" }).click();
  await page.waitForFunction((time) => window.kinesphereLive.twoBodies.moment.time > time + 0.1, first.time);
  await page.getByRole("button", { name: "Pause" }).click();
});

test("a link shows everybody the same, and nonsense in it does no harm", async () => {
  let page = await open("?limit=2.5&t=1.75");
  const [first, address] = [await moment(page), await lesson(page, ({ address }) => address)];
  assert.equal(first.time, 1.75);
  page = await inBrowser.open(address, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  assert.deepEqual(await moment(page), first);
  page = await open("?limit=huge&t=-1");
  assert.deepEqual([await lesson(page, ({ limit }) => limit), (await moment(page)).time], [1, 1.2]);
});

for (const [name, options] of [["phone", { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }], ["desktop", {}]])
  test(`on a ${name} it fits, and all can be hit`, async () => {
    const page = await open("", options);
    const { wide, small } = await page.evaluate(() => ({
      wide: document.documentElement.scrollWidth - innerWidth,
      small: Array.from(document.querySelectorAll(".live-button, .live-slider input"))
        .filter((target) => target.getBoundingClientRect().height < 44).map((target) => target.outerHTML),
    }));
    assert.deepEqual([wide, small], [0, []]);
    if (process.env.KINESPHERE_PICTURES !== undefined)
      await page.screenshot({ path: join(process.env.KINESPHERE_PICTURES, `two-bodies-${name}.png`), fullPage: true });
  });

test("the pages have complained of nothing, and asked nobody else", () => {
  assert.deepEqual(inBrowser.complaints, []);
});

test("it runs from a folder of files, too", async () => {
  const page = await inBrowser.open(pathToFileURL(join(site, "two-bodies.html")).href);
  assert.ok((await moment(page)).gap > 0);
});
