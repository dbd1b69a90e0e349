// The built-in scenes in a browser, with SIMD and without: they end with the hashes of the native program,
// KINESPHERE_PROGRAM.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, test } from "node:test";

import { browserForTests } from "./page.mjs";

const inBrowser = browserForTests();
const settings = { seconds: 1 };
const native = (name) =>
  execFileSync(process.env.KINESPHERE_PROGRAM, ["run", name, "--hash-only", "--seconds", `${settings.seconds}`], { encoding: "utf8" }).trim();

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

after(() => assert.deepEqual(inBrowser.complaints, []));
