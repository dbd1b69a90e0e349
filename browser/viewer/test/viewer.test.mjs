// The built page in a browser: KINESPHERE_VIEWER names its folder, CHROMIUM the browser's program, and
// PLAYWRIGHT, if it is not found otherwise, the folder of playwright-core.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const folder = resolve(process.env.KINESPHERE_VIEWER ?? new URL("../dist", import.meta.url).pathname);
const playwright = process.env.PLAYWRIGHT;
const { chromium } = await import(
  playwright === undefined ? "playwright-core" : pathToFileURL(resolve(playwright, "index.mjs")).href);

const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; " +
  "connect-src 'self'; img-src 'self' data:; font-src data:";

let server;
let browser;
let page;
/** Whatever the page complained of, and addresses that it asked for elsewhere. */
const complaints = [];

before(async () => {
  server = createServer(async (request, response) => {
    try {
      const path = normalize(new URL(request.url, "http://localhost").pathname);
      const file = join(folder, path === "/" ? "index.html" : path);
      const bytes = await readFile(file);
      response.writeHead(200, {
        "content-type": kinds[extname(file)] ?? "application/octet-stream",
        "content-security-policy": policy,
      });
      response.end(bytes);
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const address = `http://127.0.0.1:${server.address().port}/`;
  page = await browser.newPage({ viewport: { width: 900, height: 700 } });
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  page.on("request", (request) => {
    if (!request.url().startsWith(address) && !request.url().startsWith("data:")) complaints.push(request.url());
  });
  await page.goto(address);
  await page.waitForFunction(() => window.kinesphereViewer?.firstPicture != null, null, { timeout: 60_000 });
});

after(async () => {
  await browser?.close();
  server?.close();
});

const state = () => page.evaluate(() => {
  const { simulation, settings } = window.kinesphereViewer;
  return { time: simulation.time, hash: simulation.hash, playing: settings.playing, contacts: simulation.tally.contacts,
           violations: simulation.tally.violations, bodies: simulation.bodyCount };
});

test("the scene goes on by itself", async () => {
  const { time } = await state();
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time > time + 1.2, time, { timeout: 60_000 });
  const { contacts } = await state();
  assert.ok(contacts > 0);
});

test("a pause holds it", async () => {
  await page.keyboard.press("Space");
  const first = await state();
  assert.equal(first.playing, false);
  await page.waitForTimeout(300);
  assert.equal((await state()).time, first.time);
});

test("one event at a time", async () => {
  const first = await state();
  await page.keyboard.press(".");
  const second = await state();
  assert.ok(second.time > first.time);
  assert.notEqual(second.hash, first.hash);
});

test("a second back, and forward to the same hash", async () => {
  const first = await state();
  await page.keyboard.press(",");
  const earlier = await state();
  assert.ok(Math.abs(earlier.time - (first.time - 1)) < 1e-9);
  assert.notEqual(earlier.hash, first.hash);
  await page.evaluate((time) => void window.kinesphereViewer.simulation.run(time), first.time);
  assert.deepEqual(await state(), first);
});

test("a sphere is grabbed, follows the pointer, and is thrown", async () => {
  // A sphere that is seen where its middle is, with room around it.
  const grabbed = await page.evaluate(() => {
    const { simulation, stage, hand } = window.kinesphereViewer;
    const positions = simulation.positions();
    const { width, height } = stage.canvas.getBoundingClientRect();
    for (let body = 0; body < simulation.bodyCount; ++body) {
      const place = stage.camera.position.clone().fromArray(positions, 3 * body).project(stage.camera);
      const x = ((place.x + 1) / 2) * width;
      const y = ((1 - place.y) / 2) * height;
      if (document.elementFromPoint(x, y) !== stage.canvas || x < 340 || x > width - 300) continue;
      if (hand.bodyAt(x, y) === body && simulation.radii()[body] > 5) return { body, x, y };
    }
    return null;
  });
  assert.notEqual(grabbed, null);
  const speedOf = (body) => page.evaluate((body) => {
    const { velocity } = window.kinesphereViewer.simulation.view.body(body).reported;
    return Math.hypot(...velocity);
  }, body);
  const before = await speedOf(grabbed.body);
  await page.mouse.move(grabbed.x, grabbed.y);
  await page.mouse.down();
  assert.equal(await page.evaluate(() => window.kinesphereViewer.hand.body), grabbed.body);
  await page.keyboard.press("Space");
  await page.mouse.move(grabbed.x + 60, grabbed.y - 40, { steps: 4 });
  const { time } = await state();
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time > time + 0.1, time, { timeout: 60_000 });
  const fastest = await speedOf(grabbed.body);
  await page.mouse.up();
  assert.equal(await page.evaluate(() => window.kinesphereViewer.hand.body), null);
  assert.notEqual(fastest, before);
  const { playing, violations } = await state();
  assert.equal(playing, true);
  assert.equal(violations, 0);
});

test("nothing overlaps after that", async () => {
  await page.keyboard.press("Space");
  const least = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    const positions = simulation.positions();
    const radii = simulation.radii();
    let least = Infinity;
    for (let a = 0; a < radii.length; ++a)
      for (let b = 0; b < a; ++b)
        least = Math.min(least, Math.hypot(...[0, 1, 2].map((k) => positions[3 * a + k] - positions[3 * b + k])) -
          radii[a] - radii[b]);
    return least;
  });
  assert.ok(least > -1e-5, `two bodies overlap by ${-least}`);
});

test("a broken file is refused with a message, and the scene goes on", async () => {
  await page.keyboard.press("Space");
  await page.evaluate(() => {
    const files = new DataTransfer();
    files.items.add(new File([new Uint8Array([1, 2, 3, 4, 5])], "broken.rec"));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
  });
  await page.waitForSelector("#message:not([hidden])");
  const text = await page.textContent("#message-text");
  assert.match(text, /broken\.rec cannot be shown\. .+/);
  const { time, playing } = await state();
  assert.equal(playing, true);
  await page.waitForFunction((time) => window.kinesphereViewer.simulation.time > time, time, { timeout: 60_000 });
});

test("a recording is shown to its end", async () => {
  const made = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    simulation.view.startRecording();
    const contacts = simulation.run(simulation.time + 0.5).filter(({ event }) => event.kind === "contact_begin").length;
    const files = new DataTransfer();
    files.items.add(new File([simulation.view.stopRecording()], "own.rec"));
    window.dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
    return { contacts, time: simulation.time, bodies: simulation.bodyCount };
  });
  await page.waitForFunction(() => window.kinesphereViewer.simulation.title === "own.rec");
  const shown = await page.evaluate(() => {
    const { simulation } = window.kinesphereViewer;
    simulation.run(Infinity);
    return { contacts: simulation.tally.contacts, time: simulation.time, bodies: simulation.bodyCount };
  });
  assert.deepEqual(shown, made);
});

test("every scene can be chosen", async () => {
  for (const key of ["1", "2", "3", "4", "5", "6", "7"]) {
    await page.keyboard.press(key);
    await page.waitForFunction(() => window.kinesphereViewer.simulation.time > 0.02, null, { timeout: 60_000 });
  }
});

test("the page has complained of nothing, and asked nobody else", () => {
  assert.deepEqual(complaints, []);
});
