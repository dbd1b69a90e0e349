// The documentation's first page, whose film gives way to the viewer: KINESPHERE_SITE names the folder of the site, as
// `scripts/docs.sh --viewer` makes it.
import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";

import { browserForTests } from "./page.mjs";

const site = process.env.KINESPHERE_SITE;
const isReady = () => document.querySelector(".live img")?.naturalWidth > 0;
const inBrowser = browserForTests({ site, isReady });
/** The frame of the viewer, once it has drawn. */
async function viewerIn(page) {
  await page.waitForFunction(() => document.querySelector(".live iframe").contentWindow.kinesphereViewer?.pictures > 3,
                             null, { timeout: 60_000 });
  return page.frames().find((frame) => frame.url().endsWith("/viewer/index.html"));
}

test("nothing of the viewer is loaded before it is wanted", async () => {
  const page = await inBrowser.open();
  const loaded = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => name));
  assert.ok(loaded.some((name) => name.endsWith("film.svg")));
  assert.deepEqual(loaded.filter((name) => name.includes("/viewer/")), []);
});

test("by keyboard it runs, takes keys, lets the focus out, and closes", async () => {
  const { page } = inBrowser;
  await page.focus(".live a");
  await page.keyboard.press("Enter");
  const viewer = await viewerIn(page);
  assert.equal(await viewer.evaluate(() => window.kinesphereViewer.settings.playing), true);
  await page.keyboard.press("Space");
  assert.equal(await viewer.evaluate(() => window.kinesphereViewer.settings.playing), false);
  assert.equal(await page.getAttribute(".live iframe", "title"), "The viewer: spheres that move and touch");
  for (let presses = 0; !await page.evaluate(() => document.activeElement.matches(".live button")); ++presses) {
    assert.ok(presses < 100, "Tab does not leave the viewer");
    await page.keyboard.press("Tab");
  }
  await page.keyboard.press("Enter");
  assert.equal(await page.locator(".live iframe").count(), 0);
  assert.equal(await page.evaluate(() => document.activeElement.matches(".live a")), true);
});

for (const [name, viewport, isPhone] of [
  ["phone", { width: 390, height: 844 }, true], ["desktop", { width: 1440, height: 900 }, false],
]) {
  test(`on a ${name} it fits into the page`, async () => {
    const page = await inBrowser.open("", { viewport, hasTouch: isPhone, isMobile: isPhone });
    await page.locator(".live a").click();
    const viewer = await viewerIn(page);
    const { width, height, wide } = await page.evaluate(() => {
      const { width, height } = document.querySelector(".live iframe").getBoundingClientRect();
      return { width, height, wide: document.documentElement.scrollWidth };
    });
    assert.equal(wide, viewport.width);
    assert.ok(height <= 0.9 * viewport.height && height >= 400 && width >= 0.5 * viewport.width, `${width} x ${height}`);
    if (process.env.KINESPHERE_PICTURES !== undefined) {
      await page.locator(".live").scrollIntoViewIfNeeded();
      await page.screenshot({ path: join(process.env.KINESPHERE_PICTURES, `first-page-${name}.png`) });
    }
    await viewer.waitForFunction(() => window.kinesphereViewer.simulation.time > 0.05, null, { timeout: 60_000 });
  });
}

test("the page has complained of nothing, and asked nobody else", () => {
  assert.deepEqual(inBrowser.complaints, []);
});

test("from a folder of files the page says what is needed", async () => {
  await inBrowser.page.goto(pathToFileURL(join(site, "index.html")).href);
  assert.match(await inBrowser.page.textContent(".live figcaption"), /Where a web server shows this page/);
});
