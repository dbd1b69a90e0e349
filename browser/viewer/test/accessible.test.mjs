// All pages of the documentation, dark and bright, on desktops and phones: the rules of axe-core, which are those of
// Lighthouse, also in the viewer; and how each page looks, coarsely, beside screens.json. KINESPHERE_SITE names the folder of
// the site. KINESPHERE_PICTURES=FOLDER writes pictures of all pages there, and a new screens.json: look at them before it is
// committed. Of the references of C++, C and Python and of the pages that show sources, of which there are hundreds, few have
// pictures, and axe-core looks at one in five of each kind; KINESPHERE_EACH=1 is all. That of TypeDoc is its own.
import assert from "node:assert/strict";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";

import { browserForTests, seriousFlaws } from "./page.mjs";
import { coarsePicture, difference } from "./screens.mjs";

const site = process.env.KINESPHERE_SITE;
const pictures = process.env.KINESPHERE_PICTURES;
const file = new URL("screens.json", import.meta.url);
const known = pictures === undefined ? JSON.parse(readFileSync(file, "utf8")) : {};
/** Two pictures of a page in different fonts differ by less. */
const tolerance = 1;
const all = readdirSync(site, { recursive: true }).map(String).sort().filter((path) => path.endsWith(".html"));
const pages = all.filter((path) => !/^(sources|reference\/(cpp|python|typescript)|viewer)\//.test(path));
pages.push(...["index", "annotated", "classkinesphere_1_1World", "recording_8hpp"].map((name) => `reference/cpp/${name}.html`));
pages.push(...["Events", "Monitor", "World"].map((name) => `reference/python/${name}.html`));
pages.push("sources/examples/first_contact.cpp.html");

/** Pages that are made alike: of one folder, and in that of Doxygen of one kind of thing. */
const kindOf = (path) => path.replace(/[^/]+$/, (name) =>
  /^(class|struct|namespace|functions|globals|dir_)|_8[a-z]+(?=\.html$)/.exec(name)?.[0] ?? (name.includes("-members") ? "-members" : ""));
const each = Number(process.env.KINESPHERE_EACH ?? 5);
const alike = new Map();
for (const path of all.filter((path) => /^(sources|reference\/(cpp|python))\//.test(path) && !pages.includes(path)))
  alike.set(kindOf(path), [...alike.get(kindOf(path)) ?? [], path]);
const generated = [...alike.values()].flatMap((paths) => paths.filter((_, k) => k % each === 0));

const isReady = () => document.readyState === "complete" &&
  (document.querySelector("script[src*='live.js']") === null || window.kinesphereLive?.discs !== undefined || window.kinesphereLive?.twoBodies !== undefined);
const ofSite = browserForTests({ site, isReady, viewport: { width: 1440, height: 900 } });
const ofViewer = browserForTests({ viewport: { width: 1440, height: 900 } });

const desktop = {};
const phone = { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true };
const open = (path, options) => ofSite.open(path, { reducedMotion: "reduce", ...options });
/** Of four: "390 dark" is one. */
const modeOf = (page, colorScheme) => `${page.viewportSize().width} ${colorScheme}`;

/** Returns what is wrong with how a page looks. */
async function changeOfLook(page, path, colorScheme) {
  const mode = modeOf(page, colorScheme);
  const picture = await coarsePicture(page);
  if (pictures !== undefined) {
    await page.screenshot({ path: join(pictures, `${path.replaceAll("/", "-")}-${mode.replace(" ", "-")}.png`), fullPage: true });
    (known[path] ??= {})[mode] = picture;
    return [];
  }
  if (known[path] === undefined) return ["is new: its pictures have to be made, and looked at (accessible.test.mjs)"];
  const by = difference(picture, known[path][mode]);
  return by <= tolerance ? [] : [`${mode}: looks otherwise, by ${by.toFixed(2)}`];
}

/** Opens each page, and returns what `look` finds there, and whether it looks as it did. */
async function flawsOfAll(options, look) {
  const found = [];
  for (const path of pages) {
    const page = await open(path, options);
    const flaws = [...await changeOfLook(page, path, options.colorScheme), ...await look(page)];
    found.push(...flaws.map((flaw) => `${path}: ${flaw}`));
  }
  return found;
}

/** Rules whose answers depend on colours. */
const ofDark = ["color-contrast", "link-in-text-block"];

test("nothing serious on any page", async () => {
  assert.deepEqual(await flawsOfAll({ ...desktop, colorScheme: "light" }, (page) => seriousFlaws(page)), []);
});

test("enough contrast on each dark page", async () => {
  assert.deepEqual(await flawsOfAll({ ...desktop, colorScheme: "dark" }, (page) => seriousFlaws(page, ofDark)), []);
});

for (const [colorScheme, only] of [["light", []], ["dark", ofDark]])
  test(`nothing serious in references and sources, one in ${each} of each kind, ${colorScheme}`, async () => {
    const page = await open("index.html", { colorScheme });
    const found = [];
    for (const path of generated) {
      await page.goto(ofSite.address + path);
      found.push(...(await seriousFlaws(page, only)).map((flaw) => `${path}: ${flaw}`));
    }
    assert.deepEqual(found, []);
  });

for (const colorScheme of ["light", "dark"])
  test(`on a phone no page and no table is wider than the screen, ${colorScheme}`, async () => {
    assert.deepEqual(await flawsOfAll({ ...phone, colorScheme }, async (page) => {
      const { width, tables } = await page.evaluate(() => ({
        width: document.documentElement.scrollWidth,
        tables: Array.from(document.querySelectorAll(".md-typeset__scrollwrap")).filter((table) => table.scrollWidth > table.clientWidth).length,
      }));
      return width === 390 && tables === 0 ? [] : [`${width} wide, ${tables} tables scroll`];
    }), []);
  });

test("pictures are known of these pages alone", () => {
  if (pictures !== undefined) {
    const lines = Object.entries(known).map(([path, looks]) => `${JSON.stringify(path)}: ${JSON.stringify(looks)}`);
    writeFileSync(file, `{\n${lines.join(",\n")}\n}\n`);
  }
  assert.deepEqual(Object.keys(known).filter((path) => !pages.includes(path)), []);
});

test("a page looks as it did in other fonts, and otherwise if it is broken", async () => {
  const tables = ".md-typeset table { min-width: 600px } .md-typeset__scrollwrap, .md-typeset__table { overflow: visible }";
  const cases = [
    ["other fonts", "* { font-family: 'DejaVu Serif' !important }", false,
      ["index.html", "watch.html", "reference/cpp/classkinesphere_1_1World.html"], [desktop, phone], ["light", "dark"]],
    ["dark on dark", "[data-md-color-scheme='slate'] { --md-typeset-color: #2a2c38; --md-default-fg-color: #333; --live-ink: #222 }",
      true, ["index.html", "watch.html", "two-bodies.html"], [desktop, phone], ["dark"]],
    ["dark on dark in the reference", "html.dark-mode { --page-foreground-color: #333 }", true,
      ["reference/cpp/classkinesphere_1_1World.html"], [desktop, phone], ["dark"]],
    ["a table too wide for a phone", tables, true, ["worlds.html", "performance.html"], [phone], ["light", "dark"]],
    ["no demo", ".live-canvas { visibility: hidden }", true, ["index.html", "two-bodies.html"], [desktop, phone], ["light", "dark"]],
  ];
  for (const [name, content, isBroken, paths, screens, schemes] of cases)
    for (const path of paths) for (const screen of screens) for (const colorScheme of schemes) {
      const page = await open(path, { ...screen, colorScheme });
      await page.addStyleTag({ content });
      await page.waitForTimeout(300);
      const by = difference(await coarsePicture(page), known[path][modeOf(page, colorScheme)]);
      assert.equal(by > tolerance, isBroken, `${name}, ${path}, ${modeOf(page, colorScheme)}: differs by ${by.toFixed(2)}`);
    }
});

for (const colorScheme of ["light", "dark"])
  test(`nothing serious in the viewer, ${colorScheme}`, async () => {
    const page = await ofViewer.open("", { colorScheme });
    await page.evaluate(() => window.kinesphereViewer.setPlaying(false));
    assert.deepEqual(await seriousFlaws(page), []);
    await page.keyboard.press("n");
    await page.waitForSelector("#pair-least:not([hidden])");
    assert.deepEqual(await seriousFlaws(page), []);
    await page.keyboard.press("?");
    assert.deepEqual(await seriousFlaws(page), []);
  });

test("no page has complained of anything, or asked anybody else", () => {
  assert.deepEqual([...ofSite.complaints, ...ofViewer.complaints], []);
});
