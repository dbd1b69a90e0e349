// What people write first is right: no ball leaves its box or passes through another.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { kinesphere, packageFolder } from "./package_under_test.mjs";

const { Ballistic, load, World } = kinesphere;
await load();

/** Returns a generator of numbers from 0 to 1, the same in each run. */
function random(seed) {
  return () => (seed = (seed * 16807) % 2147483647) / 2147483647;
}

/** Returns the deepest overlap of balls with each other and with the walls of a box from 0 to `size`. */
function deepest(positions, stride, radius, size) {
  let depth = -Infinity;
  for (let a = 0; a < positions.length; a += stride) {
    for (let axis = 0; axis < 3; ++axis) {
      depth = Math.max(depth, radius - positions[a + axis], positions[a + axis] + radius - size);
    }
    for (let b = 0; b < a; b += stride) {
      const distance = Math.hypot(...[0, 1, 2].map((axis) => positions[a + axis] - positions[b + axis]));
      depth = Math.max(depth, 2 * radius - distance);
    }
  }
  return depth;
}

test("the first program of the README", async () => {
  const readme = readFileSync(join(packageFolder, "README.md"), "utf8");
  const program = /```js\n(.*?)```/s.exec(readme)[1].replace(/^import .*$/m, "");
  const contacts = [];
  const AsyncFunction = (async () => {}).constructor;
  const run = new AsyncFunction("load", "RandomForces", "World", "Math", "console", `${program}\nreturn { positions, motion, world };`);
  const { positions, motion, world } = await run(
    kinesphere.load, kinesphere.RandomForces, World, Object.assign(Object.create(Math), { random: random(1) }),
    { log: (...text) => contacts.push(text) });
  assert.equal(world.time, 10);
  assert.ok(contacts.length > 100, `${contacts.length} contacts`);
  assert.ok(deepest(motion.states(10), 6, 2, 100) <= Math.max(0, deepest(positions, 3, 2, 100)) + 1e-6);
});

test("the monitor of the README", async () => {
  const readme = readFileSync(join(packageFolder, "README.md"), "utf8");
  const [, program] = readme.match(/```js\n.*?```/gs);
  const told = [];
  const AsyncFunction = (async () => {}).constructor;
  const code = program.replace(/```(js)?/g, "").replace(/^import .*$/m, "");
  await new AsyncFunction("load", "Monitor", "console", code)(kinesphere.load, kinesphere.Monitor, { log: (...text) => told.push(text) });
  const met = 14000 / 15.4;
  const [first, ...others] = told;
  assert.deepEqual(first.slice(1, 4), ["predicted", 211331640, 244660123]);
  assert.ok(Math.abs(first[0] - (met - 720)) <= 10 && Math.abs(first[4] - met) < 1, `${first}`);
  const within = others.find(([, , , , verdict]) => verdict === "within");
  assert.ok(Math.abs(within[0] - (met - 900 / 15.4)) < 20, `${within}`);
});

for (const contacts of [undefined, "all", "impacts", "begin_and_end"]) {
  test(`a falling gas stays in its box: contacts ${contacts}`, () => {
    const next = random(1);
    const n = 6, radius = 0.4, count = n ** 3;
    const positions = new Float64Array(3 * count), velocities = new Float64Array(3 * count);
    for (let k = 0; k < count; ++k) {
      positions.set([(k % n) + 0.5, (Math.floor(k / n) % n) + 0.5, Math.floor(k / n / n) + 0.5], 3 * k);
      velocities.set([next() - 0.5, next() - 0.5, next() - 0.5], 3 * k);
    }
    const motion = new Ballistic({ positions, velocities }, { gravity: [0, 0, -10] });
    const world = new World({ box: { lower: [0, 0, 0], upper: [n, n, n] }, ...(contacts ? { contacts } : {}) });
    world.addMotion(motion, radius);
    const energy = (states) => {
      let sum = 0;
      for (let k = 0; k < states.length; k += 6) {
        sum += 10 * states[k + 2] + (states[k + 3] ** 2 + states[k + 4] ** 2 + states[k + 5] ** 2) / 2;
      }
      return sum;
    };
    let before = energy(motion.states(0));
    for (let second = 1; second <= 4; ++second) {
      world.run(second, { motion, respond: { restitution: 0.5, restingSpeed: 0.05 } });
      const states = motion.states(second);
      assert.ok(deepest(states, 6, radius, n) < 2e-6, `${deepest(states, 6, radius, n)} after ${second}`);
      assert.ok(energy(states) <= before + 1e-6);
      before = energy(states);
    }
  });
}

test("a stack that hops for ever warns once, and names what lets it settle", (t) => {
  const warn = t.mock.method(console, "warn", () => {});
  for (const resting of [{}, { restingSpeed: 0.1 }]) {
    const positions = [5, 5, 1.2, 5, 5, 3.4, 5, 5, 5.6];
    const motion = new Ballistic({ positions, velocities: new Array(9).fill(0) }, { gravity: [0, 0, -10] });
    const world = new World({ box: { lower: [0, 0, 0], upper: [10, 10, 30] } });
    world.addMotion(motion, 1);
    for (let step = 1; step <= 20; ++step) world.run(step / 2, { motion, respond: { restitution: 0, ...resting } });
  }
  assert.equal(warn.mock.callCount(), 1);
  assert.match(warn.mock.calls[0].arguments[0], /contacts followed another one at once.*restingSpeed/);
});

test("bodies ask for their own events", () => {
  const kinds = (contacts) => {
    const world = new World({ contacts: "impacts" });
    world.add({ position: [0, 0, 0], velocity: [1, 0, 0] });
    world.add({ position: [5, 0, 0], ...(contacts ? { contacts } : {}) });
    const events = world.events(10, (ids, time, states) => {
      ids.forEach((id, k) => states.set(id === 0 ? [time, 0, 0, 1, 0, 0] : [5, 0, 0, 0, 0, 0], 6 * k));
    });
    return [...events].map((event) => event.kind);
  };
  assert.deepEqual(kinds("all"), ["contact_begin", "contact_end"]);
  assert.deepEqual(kinds("begin_and_end"), ["contact_begin", "contact_end"]);
  assert.deepEqual(kinds("impacts"), ["contact_begin"]);
  assert.deepEqual(kinds(undefined), ["contact_begin"]);
  assert.throws(() => kinds("hits"), /add: contacts must be "all"/);
});
