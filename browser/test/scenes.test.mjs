// All built-in scenes end with the hash of the native program. KINESPHERE_SIMD chooses the module: 1 or 0.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { inFolder, kinesphere, program } from "./package_under_test.mjs";

const { EventHash, load, Replay, Scene, sceneNames, usesSimd, World } = kinesphere;
const simd = process.env.KINESPHERE_SIMD !== "0";
await load({ simd });

test("the module is the one that was asked for", () => assert.equal(usesSimd(), simd));

function run(scene, respond = scene) {
  const world = new World(scene.definition);
  const motion = scene.motion();
  world.addMotion(motion, scene.radii);
  const hash = new EventHash();
  // Runs in parts, which must make no difference.
  for (let part = 1; part <= 7; ++part) hash.add(world.run((scene.endTime * part) / 7, { motion, respond }));
  return { world, hash: hash.value };
}

for (const name of sceneNames()) {
  test(`${name} ends with the hash of the native program`, () => {
    // The heap takes long.
    const settings = name === "pile" ? { bodies: 300, seconds: 5 } : {};
    const options = Object.entries(settings).flatMap(([key, value]) => [`--${key}`, `${value}`]);
    assert.equal(run(new Scene(name, settings)).hash, program("run", name, "--hash-only", ...options));
  });
}

test("settings of a scene are those of the program", () => {
  const scene = new Scene("paper1", { bodies: 200, seed: 7, seconds: 3, packing: 0.1, radiusMin: 1, radiusMax: 2 });
  const options = ["--bodies", "200", "--seed", "7", "--seconds", "3", "--packing", "0.1", "--radius", "1", "2"];
  assert.equal(run(scene).hash, program("run", "paper1", "--hash-only", ...options));
});

test("what JavaScript answers is what the module would have answered", () => {
  const scene = new Scene("paper1", { bodies: 200, seconds: 3 });
  const { radii } = scene;
  const masses = radii.map((radius) => radius * radius * radius);
  const bounce = (event) => {
    if (!(event.kind === "contact_begin" || event.kind === "wall_begin") || event.approachSpeed <= 0) return undefined;
    const { normal } = event;
    const along = (v) => v[0] * normal[0] + v[1] * normal[1] + v[2] * normal[2];
    const first = event.firstState.velocity;
    const second = event.secondState.velocity;
    const a = event.second === null ? 1 : masses[event.second] / (masses[event.first] + masses[event.second]);
    const closing = 2 * (along(first) - along(second));
    const turned = (v, by) => [0, 1, 2].map((k) => v[k] + by * normal[k]);
    if (event.second === null) return { first: turned(first, -closing) };
    return { first: turned(first, -a * closing), second: turned(second, (1 - a) * closing) };
  };
  const asked = run(scene, bounce).world.counters;
  const inside = run(scene, { masses }).world.counters;
  // Rounded differently, so the run diverges soon; its statistics are similar.
  assert.ok(Math.abs(asked.events.contact_begin / inside.events.contact_begin - 1) < 0.1);
  assert.equal(run(scene, { masses }).hash, run(scene).hash);
});

test("a recording of the native program replays here", () => {
  inFolder((folder) => {
    const file = join(folder, "recording");
    const hash = program("run", "paper1", "--bodies", "200", "--seconds", "2", "--hash-only", "--record", file);
    const replay = new Replay(readFileSync(file));
    const reported = new EventHash();
    while (!replay.finished) {
      const event = replay.advance();
      if (event !== null) reported.add(event);
    }
    assert.equal(reported.value, hash);
    assert.equal(replay.step, replay.stepCount);
    assert.equal(replay.world.size, 200);
  });
});
