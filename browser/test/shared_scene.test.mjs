// The scene and the game that programs in all languages run (tests/same_hash/shared_scene.cpp) have one hash each.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { kinesphere } from "./package_under_test.mjs";

const { EventHash, GameWorld, load, RandomForces, World } = kinesphere;
await load();

let state = 1;
const random = () => (state = (state * 16807) % 2147483647) / 2147483647;
const expected = readFileSync(new URL("../../tests/same_hash/shared_scene.txt", import.meta.url), "utf8").split("\n");

test("the scene of all languages has one hash", () => {
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
  assert.equal(hash.value, expected[0]);
});

test("the game of all languages has one hash", () => {
  const room = { box: { lower: [0, 0, 0], upper: [10, 10, 10] } };
  const game = new GameWorld(room, { gravity: [0, 0, -9.81], respond: { restitution: 0.9 } });
  game.addStatic({ box: { lower: [4, 4, 0], upper: [6, 6, 1] } });
  for (let k = 0; k < 27; ++k) {
    const radius = 0.3 + 0.5 * random();
    const position = [k % 3, Math.floor(k / 3) % 3, Math.floor(k / 9)].map((cell) => 2 + 3 * cell);
    game.add({ radius, mass: radius, position, velocity: [0, 1, 2].map(() => 10 * (random() - 0.5)) });
  }
  const hash = new EventHash();
  for (let frame = 0; frame < 128; ++frame) {
    if (frame % 16 === 0) {
      const before = game.velocities;
      game.setVelocities(before.map((_, k) => before[k % 3 === 2 ? k - 2 : k + 1]));
    }
    if (frame === 32) game.remove(game.ids[3]);
    if (frame === 64) game.add({ radius: 0.25, position: [5, 5, 9.5] });
    if (frame === 96) game.setAcceleration(game.ids[0], [0, 0, 20]);
    hash.add(game.step(0.015625));
  }
  assert.equal(hash.value, expected[1]);
});
