// The rules of axe-core, which are those of Lighthouse, on each page of the documentation and on the viewer; dark and
// bright, on desktops and phones. KINESPHERE_SITE names the folder of the site, and KINESPHERE_PICTURES one for pictures of
// all pages, to be looked at. Pages that show sources are all alike, so one of them stands for them, as four do for the
// reference of C++ and C; that of TypeDoc is its own.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";

import { browserForTests } from "./page.mjs";

const site = process.env.KINESPHERE_SITE;
const pictures = process.env.KINESPHERE_PICTURES;
const axe = readFileSync(resolve(process.env.PLAYWRIGHT, "../axe-core/axe.min.js"), "utf8");
const pages = readdirSync(site, { recursive: true }).map(String).sort()
  .filter((path) => path.endsWith(".html") && !/^(sources|reference\/(cpp|typescript)|viewer)\//.test(path));
pages.push(...["index", "annotated", "classkinesphere_1_1World", "recording_8hpp"].map((name) => `reference/cpp/${name}.html`));
pages.push(readdirSync(join(site, "sources"), { recursive: true }).map((path) => `sources/${path}`).find((path) => path.endsWith(".html")));

const isReady = () => document.readyState === "complete" &&
  (document.querySelector("script[src*='live.js']") === null || window.kinesphereLive?.discs !== undefined || window.kinesphereLive?.twoBodies !== undefined);
const ofSite = browserForTests({ site, isReady, viewport: { width: 1440, height: 900 } });
const ofViewer = browserForTests({ viewport: { width: 1440, height: 900 } });

/** Returns what breaks a rule so that somebody is shut out, and where; `only` names rules, all if there are none. */
async function seriousFlaws(page, only = []) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate((only) => window.axe.run(document, {
    resultTypes: ["violations"], ...(only.length > 0 && { runOnly: only }),
  }), only);
  return violations.filter(({ impact }) => impact === "serious" || impact === "critical").flatMap(({ id, nodes }) =>
    nodes.slice(0, 3).map(({ target, any }) => `${id}: ${target} ${any[0]?.message ?? ""}`));
}

/** Opens each page, and returns what `look` finds there. */
async function flawsOfAll(options, look) {
  const found = [];
  for (const path of pages) {
    const page = await ofSite.open(path, { reducedMotion: "reduce", ...options });
    found.push(...(await look(page)).map((flaw) => `${path}: ${flaw}`));
    if (pictures !== undefined)
      await page.screenshot({ path: join(pictures, `${path.replaceAll("/", "-")}-${page.viewportSize().width}-${options.colorScheme}.png`), fullPage: true });
  }
  return found;
}

test("nothing serious on any page", async () => {
  assert.deepEqual(await flawsOfAll({ colorScheme: "light" }, (page) => seriousFlaws(page)), []);
});

test("enough contrast on each dark page", async () => {
  assert.deepEqual(await flawsOfAll({ colorScheme: "dark" }, (page) => seriousFlaws(page, ["color-contrast", "link-in-text-block"])), []);
});

for (const colorScheme of ["light", "dark"])
  test(`on a phone no page is wider than the screen, ${colorScheme}`, async () => {
    const phone = { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, colorScheme };
    assert.deepEqual(await flawsOfAll(phone, async (page) => {
      const width = await page.evaluate(() => document.documentElement.scrollWidth);
      return width === 390 ? [] : [`${width} wide`];
    }), []);
  });

for (const colorScheme of ["light", "dark"])
  test(`nothing serious in the viewer, ${colorScheme}`, async () => {
    const page = await ofViewer.open("", { colorScheme });
    await page.evaluate(() => window.kinesphereViewer.setPlaying(false));
    assert.deepEqual(await seriousFlaws(page), []);
    await page.keyboard.press("?");
    assert.deepEqual(await seriousFlaws(page), []);
  });

test("no page has complained of anything, or asked anybody else", () => {
  assert.deepEqual([...ofSite.complaints, ...ofViewer.complaints], []);
});
