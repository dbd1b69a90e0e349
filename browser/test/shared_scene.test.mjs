// The scene that programs in all languages run (tests/same_hash/shared_scene.cpp) has one hash.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { kinesphere } from "./package_under_test.mjs";

const { EventHash, load, RandomForces, World } = kinesphere;
await load();

test("the scene of all languages has one hash", () => {
  let state = 1;
  const random = () => (state = (state * 16807) % 2147483647) / 2147483647;
  const count = 64;
  const radii = new Float64Array(count);
  const positions = new Float64Array(3 * count);
  const velocities = new Float64Array(3 * count);
  for (let k = 0; k < count; ++k) {
    radii[k] = 0.5 + random();
    positions.set([k % 4, Math.floor(k / 4) % 4, Math.floor(k / 16)].map((cell) => 2.5 + 5 * cell), 3 * k);
    velocities.set([0, 1, 2].map(() => 20 * (random() - 0.5)), 3 * k);
  }
  const motion = new RandomForces({ positions, velocities }, { accelerationLimits: 5, interval: 0.2, seed: 7 });
  const world = new World({ box: { lower: [0, 0, 0], upper: [20, 20, 20] } });
  world.setSensor(0, [0.5]);
  world.addMotion(motion, radii);
  world.addZone({ box: { lower: [5, 5, 5], upper: [15, 15, 15] } });
  const hash = new EventHash();
  hash.add(world.run(5, { motion, respond: { masses: radii, restitution: 0.9 } }));
  const expected = readFileSync(new URL("../../tests/same_hash/shared_scene.txt", import.meta.url), "utf8");
  assert.equal(hash.value, expected.trim());
});
