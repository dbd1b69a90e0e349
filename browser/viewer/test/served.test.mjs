// `kinesphere view FILE` in use: the program, KINESPHERE_PROGRAM, serves the page and its files. Built-in scenes end with the
// program's hashes in a browser, with SIMD and without.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { after, test } from "node:test";

import { browserForTests } from "./page.mjs";

const inBrowser = browserForTests();
const program = process.env.KINESPHERE_PROGRAM;
const folder = mkdtempSync(join(tmpdir(), "kinesphere-"));
after(() => rmSync(folder, { recursive: true }));

/** Opens the page that the program serves, and calls `action` with it. */
async function viewed(options, action) {
  const server = spawn(program, ["view", "--no-browser", "--folder", process.env.KINESPHERE_VIEWER, ...options],
                       { stdio: ["ignore", "pipe", "inherit"] });
  try {
    const address = await new Promise((resolve) => createInterface(server.stdout).once("line", resolve));
    await action(await inBrowser.open(address));
  } finally {
    const gone = new Promise((done) => server.once("exit", done));
    server.kill("SIGTERM");
    assert.equal(await gone, 0);
  }
}

test("without a file it shows the first scene", async () => {
  await viewed([], async (page) => {
    await page.waitForFunction(() => window.kinesphereViewer.simulation.time > 0.1, null, { timeout: 60_000 });
    assert.equal(await page.textContent("#title"), "What 60 Hz misses");
  });
});

test("a table of positions", async () => {
  const file = join(folder, "two.csv");
  const rows = Array.from({ length: 20 }, (_, k) => `anna,${k / 2},${k / 2},0\nberta,${k / 2},${9 - k / 2},0.2`);
  writeFileSync(file, `id,t,x,y\n${rows.join("\n")}\n`);
  await viewed([file], async (page) => {
    await page.waitForFunction(() => document.querySelector("#title").textContent === "two.csv");
    const reported = await page.evaluate(() =>
      window.kinesphereViewer.simulation.run(Infinity).map(({ event }) => event.kind));
    assert.deepEqual(reported, ["contact_begin", "contact_end"]);
  });
});

test("a world's recording", async () => {
  const file = join(folder, "world.rec");
  execFileSync(program, ["run", "gas", "--bodies", "50", "--seconds", "2", "--quiet", "--record", file]);
  const hash = execFileSync(program, ["run", "gas", "--bodies", "50", "--seconds", "2", "--hash-only"], { encoding: "utf8" }).trim();
  await viewed([file], async (page) => {
    await page.waitForFunction(() => document.querySelector("#title").textContent === "world.rec");
    const reported = await page.evaluate(() => {
      const { simulation } = window.kinesphereViewer;
      simulation.run(Infinity);
      return simulation.hash;
    });
    assert.equal(reported, hash);
  });
});

const settings = { seconds: 1 };
const native = (name) =>
  execFileSync(program, ["run", name, "--hash-only", "--seconds", `${settings.seconds}`], { encoding: "utf8" }).trim();

for (const simd of [true, false]) {
  test(`all scenes, ${simd ? "with" : "without"} SIMD`, async () => {
    const page = await inBrowser.open();
    const { names, usesSimd } = await page.evaluate(async (simd) => {
      window.kinesphere = await import("/package/dist/index.js");
      await kinesphere.load({ simd });
      return { names: kinesphere.sceneNames(), usesSimd: kinesphere.usesSimd() };
    }, simd);
    assert.equal(usesSimd, simd);
    assert.ok(names.length >= 6);
    for (const name of names) {
      const hash = await page.evaluate(({ name, settings }) => {
        const scene = new kinesphere.Scene(name, settings);
        const world = new kinesphere.World(scene.definition);
        const motion = scene.motion();
        world.addMotion(motion, scene.radii);
        return new kinesphere.EventHash().add(world.run(scene.endTime, { motion, respond: scene })).value;
      }, { name, settings });
      assert.equal(hash, native(name), name);
    }
  });
}

test("the pages have complained of nothing", () => assert.deepEqual(inBrowser.complaints, []));
