// Rigid bodies: a gas of dumbbells, rotations by a function, and wrong use.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere } from "./package_under_test.mjs";

const { Ballistic, BodyMap, bounce, EventHash, load, World } = kinesphere;
await load();

const half = 0.5, radius = 0.3;
const dumbbell = [
  { ball: { centre: [-half, 0, 0], radius } },
  { ball: { centre: [half, 0, 0], radius } },
];
const inertia = [0, half * half, half * half];  // two masses of 1/2, half apart

/** Dumbbells in a box, all of whose energy is in the flight, with orientations and directions spread by the golden angle. */
function gas(side) {
  const [positions, velocities, orientations] = [[], [], []];
  for (let k = 0; k < side ** 3; ++k) {
    positions.push(...[k % side, Math.floor(k / side) % side, Math.floor(k / side ** 2)].map((x) => 2.5 * (x + 0.5)));
    const z = 1 - (2 * k + 1) / side ** 3, angle = 2.39996 * k, flat = Math.sqrt(1 - z * z);
    velocities.push(flat * Math.cos(angle), flat * Math.sin(angle), z);
    orientations.push([Math.cos(angle), 0, Math.sin(angle) * 0.6, Math.sin(angle) * 0.8]);
  }
  const edge = 2.5 * side;
  const world = new World({ box: { lower: [0, 0, 0], upper: [edge, edge, edge] } });
  const motion = new Ballistic({ positions, velocities });
  const bodies = new BodyMap();
  orientations.forEach((orientation, k) => bodies.addRigidBody(world, motion, k, dumbbell, { orientation, inertia }));
  return { world, motion, bodies };
}

const squared = (v) => v[0] ** 2 + v[1] ** 2 + v[2] ** 2;
function energies({ world, motion }) {
  const states = motion.states(world.time);
  let [flight, rotation] = [0, 0];
  for (const id of world.bodies()) {
    flight += 0.5 * squared(states.subarray(6 * id + 3, 6 * id + 6));
    rotation += 0.5 * half * half * squared(world.rotation(id).angularVelocity);
  }
  return [flight, rotation];
}

const answer = (event) =>
  (event.kind === "contact_begin" || event.kind === "wall_begin") && event.approachSpeed > 0 ? bounce(event) : undefined;
/** What a run can be told: nothing about walls. */
const respond = (event) => {
  const after = answer(event);
  if (after === undefined || event.second !== null) return after;
  const { second: _, ...first } = after;
  return first;
};

test("a gas of dumbbells keeps its energy and shares it", () => {
  const game = gas(3);
  const before = energies(game)[0];
  let share = 0;
  for (let t = 1; t <= 60; ++t) {
    game.world.run(t, { motion: game.bodies, respond: {} });
    const [flight, rotation] = energies(game);
    assert.ok(Math.abs((flight + rotation) / before - 1) < 1e-12);
    if (t > 10) share += flight / before / 50;
  }
  // Equipartition: three directions of flight, two axes of rotation.
  assert.ok(Math.abs(share - 0.6) < 0.04, `${share}`);
});

test("a function and a loop bounce as a run does", () => {
  const [ready, asked, looped] = [gas(2), gas(2), gas(2)];
  const events = ready.world.run(20, { motion: ready.bodies, respond: {} });
  const hash = (of) => new EventHash().add(of).value;
  assert.ok(events.length > 50);
  assert.equal(hash(asked.world.run(20, { motion: asked.bodies, respond })), hash(events));
  const each = new EventHash();
  const parts = new Set();
  for (const event of looped.world.events(20, looped.bodies)) {
    each.add(event);
    parts.add(`${event.firstPart} ${event.secondPart}`);
    const after = answer(event);
    if (after === undefined) continue;
    looped.bodies.setVelocity(looped.world, event.first, after.first);
    if (event.second !== null) looped.bodies.setVelocity(looped.world, event.second, after.second);
    if (after.firstAngularVelocity) looped.world.setAngularVelocity(event.first, after.firstAngularVelocity);
    if (after.secondAngularVelocity) looped.world.setAngularVelocity(event.second, after.secondAngularVelocity);
  }
  assert.equal(each.value, hash(events));
  assert.equal(parts.size, 4);
  // A unit impulse along the normal turns a dumbbell about an axis across it.
  for (const { firstSpinGain: gain, normal } of events)
    assert.ok(Math.abs(gain[0] * normal[0] + gain[1] * normal[1] + gain[2] * normal[2]) < 1e-12);
});

/** A rod of length 4 that turns about one end, towards a ball that stands two away from there. */
function rod(rotationProbe) {
  const world = new World();
  const capsule = { capsule: { a: [0, 0, 0], b: [4, 0, 0], radius: 0.1 } };
  const body = world.addRigidBody([capsule], {
    position: [0, 0, 0], angularVelocity: [0, 0, 1], angularAccelerationLimit: 1, largestAngularSpeed: 2,
  });
  world.add({ position: [0, 2, 0], radius: 0.1 });
  if (rotationProbe) world.setRotationProbe(rotationProbe);
  const probe = (ids, time, states) => {
    ids.forEach((id, k) => states.set(id === body ? [0, 0, 0, 0, 0, 0] : [0, 2, 0, 0, 0, 0], 6 * k));
  };
  return { world, body, capsule, probe };
}
const turning = (ids, time, rotations) => {
  assert.deepEqual([...ids], [0]);
  rotations.set([Math.cos(time / 2), 0, 0, Math.sin(time / 2), 0, 0, 1]);
};
const meets = Math.PI / 2 - Math.asin(0.1);

test("a function turns a body", () => {
  const { world, body, capsule, probe } = rod(turning);
  const copy = world.clone();
  for (const of of [world, copy]) {
    const event = of.advance(3, probe);
    assert.equal(event.kind, "contact_begin");
    assert.ok(Math.abs(event.time - meets) < 1e-5);
    assert.deepEqual([...event.firstAngularVelocity], [0, 0, 1]);
    assert.ok(Math.abs(of.rotation(body).orientation[0] - Math.cos(event.time / 2)) < 1e-12);
  }
  const [part] = world.partsOf(body);
  assert.deepEqual({ capsule: { a: [...part.capsule.a], b: [...part.capsule.b], radius: 0.1 } }, capsule);
  world.setRotation(body, { orientation: [1, 0, 0, 0], angularVelocity: [0, 0, 0.5] });
  assert.deepEqual([...world.rotation(body).orientation], [1, 0, 0, 0]);
});

test("boxes and hulls turn, and meet with their sides", () => {
  const corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]];
  const parts = [
    { hull: { points: corners } }, { box: { lower: [-1, -1, 0], upper: [1, 1, 0] } },
    { box: { lower: [-0.9, -0.9, -0.5], upper: [0.9, 0.9, 0.5], radius: 0.1 } },
  ];
  for (const part of parts) {
    const world = new World();
    const square = world.addRigidBody([part], { position: [0, 0, 0], angularVelocity: [0, 0, 1] });
    const ball = world.add({ position: [2.2, 0, 0], radius: 1 });
    const probe = (ids, time, states) =>
      ids.forEach((id, k) => states.set([id === ball ? 2.2 : 0, 0, 0, 0, 0, 0], 6 * k));
    const event = world.advance(10, probe);
    assert.deepEqual([event.kind, event.first, event.firstPart], ["contact_begin", square, 0]);
    // The ball has the radius 1, and the side is 1 from the middle, by the radius of the part where its edges are round.
    if (!part.box?.radius) assert.ok(Math.abs(event.time - Math.acos(2 / 2.2)) < 1e-5, `${event.time}`);
    else assert.ok(event.time > Math.acos(2 / 2.2));
    const [{ hull }] = world.partsOf(square);
    assert.equal(hull.radius, part.box?.radius ?? 0);
    assert.equal(hull.points.length, part.box?.radius ? 8 : 4);
    if (part.hull) assert.deepEqual(hull.points.map((point) => [...point]), corners);
    // A snapshot has all points.
    const again = World.restore(world.save());
    assert.deepEqual(again.partsOf(square), world.partsOf(square));
  }
  // One and two points are a ball and a capsule.
  const world = new World();
  const mixed = world.addRigidBody(
    [{ hull: { points: [[1, 0, 0]], radius: 0.5 } }, { hull: { points: [[0, 0, 0], [1, 0, 0]], radius: 0.5 } }],
    { position: [0, 0, 0] });
  assert.deepEqual(world.partsOf(mixed).map((part) => Object.keys(part)[0]), ["ball", "capsule"]);
});

test("what a rotation probe throws comes out, and the call can be repeated", () => {
  let failures = 1;
  const { world, probe } = rod((ids, time, rotations) => {
    if (failures-- > 0) throw new Error("no rotation");
    turning(ids, time, rotations);
  });
  assert.throws(() => world.advance(3, probe), /no rotation/);
  assert.ok(Math.abs(world.advance(3, probe).time - meets) < 1e-5);
  const silent = rod(() => {});
  assert.throws(() => silent.world.advance(3, silent.probe), { code: "not_finite" });
  const none = rod(null);
  assert.throws(() => none.world.advance(3, none.probe), { code: "null_probe" });
});

test("wrong use is refused", () => {
  const world = new World();
  const position = [0, 0, 0];
  const refused = (parts, body, expected) =>
    assert.throws(() => world.addRigidBody(parts, { position, ...body }), expected);
  refused([], {}, { code: "out_of_range", argument: "parts" });
  refused([{ cube: {} }], {}, /addRigidBody: part has no key cube/);
  refused([{}], {}, /part must be a ball, a capsule, a hull or a box/);
  refused([{ box: {} }], {}, /lower/);
  refused([{ box: { lower: [0, 0, NaN], upper: [1, 1, 1] } }], {}, { code: "not_finite" });
  refused([{ hull: {} }], {}, /hull must have points/);
  refused([{ hull: { points: [] } }], {}, /hull must have points/);
  refused([{ hull: { points: [[0, 0]] } }], {}, /point/);
  refused([{ hull: { points: Array(65).fill([0, 0, 0]) } }], {}, { code: "out_of_range", argument: "parts" });
  refused([{ capsule: { a: [0, 0, 0], b: [1, 0, 0], radius: -1 } }], {}, { code: "out_of_range" });
  refused(dumbbell, { orientation: [1, 0, 0] }, /orientation must be four numbers/);
  refused(dumbbell, { orientation: [1, 1, 0, 0] }, { code: "out_of_range" });
  refused(dumbbell, { angularAccelerationLimit: 1 }, { argument: "largest_angular_speed" });
  refused(dumbbell, { spin: [0, 0, 1] }, /body has no key spin/);
  assert.equal(world.size, 0);
  const body = world.addRigidBody(dumbbell, { position, largestAngularSpeed: 2 });
  const ball = world.add({ position: [5, 0, 0] });
  assert.deepEqual(world.bodyViews([body, ball]).map(({ isRigid }) => isRigid), [true, false]);
  for (const call of [() => world.rotation(ball), () => world.partsOf(ball), () => world.setAngularVelocity(ball, [0, 0, 1])])
    assert.throws(call, { code: "unsupported" });
  assert.throws(() => world.setAngularVelocity(body, [0, 0, 3]), { code: "out_of_range" });
  assert.throws(() => world.setRotationProbe(3), TypeError);
});
