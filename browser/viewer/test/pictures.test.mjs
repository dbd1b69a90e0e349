// Compares pictures of the page coarsely with checked ones: pictures.json has the mean colours of the squares of a grid.
// KINESPHERE_PICTURES=FOLDER writes the pictures there, and a new pictures.json: look at them before it is committed.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";

import { browserForTests } from "./page.mjs";

const columns = 24;
const rows = 16;
/** Allowed differences of squares, in their mean and at most. Range: 0 to 255. */
const tolerance = { mean: 4, most: 40 };

const file = new URL("pictures.json", import.meta.url);
const folder = process.env.KINESPHERE_PICTURES;
const known = folder === undefined ? JSON.parse(readFileSync(file, "utf8")) : {};

const inBrowser = browserForTests();

/** Returns mean colours of the squares, three numbers each from 0 to 255, row by row. */
function coarse(page, png) {
  return page.evaluate(async ({ png, columns, rows }) => {
    const image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const sums = new Float64Array(4 * columns * rows);
    for (let y = 0; y < image.height; ++y) {
      for (let x = 0; x < image.width; ++x) {
        const square = Math.floor((y * rows) / image.height) * columns + Math.floor((x * columns) / image.width);
        for (let channel = 0; channel < 3; ++channel) sums[4 * square + channel] += data[4 * (y * image.width + x) + channel];
        sums[4 * square + 3] += 1;
      }
    }
    return Array.from({ length: 3 * columns * rows }, (_, k) => Math.round(sums[4 * Math.floor(k / 3) + (k % 3)] / sums[4 * Math.floor(k / 3) + 3]));
  }, { png: png.toString("base64"), columns, rows });
}

function difference(a, b) {
  let sum = 0;
  let most = 0;
  for (let k = 0; k < a.length; ++k) {
    sum += Math.abs(a[k] - b[k]);
    most = Math.max(most, Math.abs(a[k] - b[k]));
  }
  return { mean: sum / a.length, most };
}

/** Returns the page with a scene that stands still at a time. */
async function pictureOf({ scene, bodies, seed = 1, time, theme, overlays = {}, colouring = "size", viewport = wide }) {
  if (inBrowser.page === undefined || viewport !== wide) await inBrowser.open("", { viewport });
  const { page } = inBrowser;
  await page.evaluate(({ scene, bodies, seed, time, theme, overlays, colouring }) => {
    const viewer = window.kinesphereViewer;
    viewer.setPlaying(false);
    Object.assign(viewer.settings, { scene, bodies, seed, theme, colouring });
    // Sparks and flashes fade in real time.
    for (const overlay of Object.keys(viewer.settings.overlays)) viewer.settings.overlays[overlay] = overlays[overlay] === true;
    viewer.repaint();
    viewer.restart();
    viewer.seek(time);
  }, { scene, bodies, seed, time, theme, overlays, colouring });
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time === time, time, { timeout: 60_000 });
  const pictures = await page.evaluate(() => window.kinesphereViewer.pictures);
  await page.waitForFunction((count) => window.kinesphereViewer.pictures > count + 3, pictures, { timeout: 60_000 });
  await page.waitForTimeout(300);
  const png = await page.screenshot();
  const squares = await coarse(page, png);
  if (viewport !== wide) inBrowser.page = undefined;
  return { png, squares };
}

const wide = { width: 1200, height: 800 };
const pictures = {
  "missed": { scene: "missed", bodies: 160, time: 0.2, theme: "dark" },
  "missed-sideways": { scene: "missed", bodies: 160, time: 0.2, theme: "bright", viewport: { width: 844, height: 390 } },
  "evidence": { scene: "missed", bodies: 160, time: 0.6, theme: "bright", overlays: { evidence: true } },
  "piston": { scene: "piston", bodies: 151, time: 1, theme: "bright" },
  "paper1-dark": { scene: "paper1", bodies: 500, time: 2, theme: "dark" },
  "paper1-bright": { scene: "paper1", bodies: 500, time: 2, theme: "bright" },
  "paper1-phone": { scene: "paper1", bodies: 300, time: 1, theme: "dark", viewport: { width: 390, height: 844 } },
  "bullets": { scene: "bullets", bodies: 120, time: 0.1, theme: "dark", colouring: "safe" },
  "bounds": { scene: "gas", bodies: 200, time: 1, theme: "dark", overlays: { bounds: true, certificates: true } },
  "boxes": { scene: "periodic_gas", bodies: 150, time: 1, theme: "bright", overlays: { boxes: true, cells: true } },
  "rigid": { scene: "rigid", bodies: 90, time: 2, theme: "bright" },
  "drones": { scene: "drones", bodies: 60, time: 12, theme: "dark" },
};

for (const [name, choice] of Object.entries(pictures)) {
  test(`${name} looks as it did`, async () => {
    const { png, squares } = await pictureOf(choice);
    if (folder !== undefined) {
      writeFileSync(join(folder, `${name}.png`), png);
      known[name] = squares;
      return;
    }
    const { mean, most } = difference(squares, known[name]);
    assert.ok(mean <= tolerance.mean && most <= tolerance.most, `differs by ${mean} in the mean, ${most} at most`);
  });
}

test("another seed is seen to be another picture", { skip: folder !== undefined && "pictures are made anew" }, async () => {
  const { squares } = await pictureOf({ ...pictures["paper1-dark"], seed: 2 });
  const { mean, most } = difference(squares, known["paper1-dark"]);
  assert.ok(mean > tolerance.mean || most > tolerance.most, `differs by ${mean} in the mean, ${most} at most`);
});

after(() => {
  if (folder !== undefined) writeFileSync(file, `${JSON.stringify(known)}\n`);
  assert.deepEqual(inBrowser.complaints, []);
});
