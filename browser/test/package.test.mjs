// The package in use, including wrong use.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere } from "./package_under_test.mjs";

const {
  Ballistic, BodyMap, bounce, EventHash, FrameMotion, KinesphereError, load, RandomForces, RecordedTracks, Replay, Scene, SteeredMotion, version,
  World,
} = kinesphere;

test("nothing works before load()", () => {
  assert.throws(() => new World(), /load\(\) must be awaited/);
});

test("load() may be awaited twice, and knows its version", async () => {
  await load();
  await load();
  assert.match(version(), /^\d+\.\d+\.\d+$/);
});

const box = { lower: [0, 0, 0], upper: [100, 100, 100] };

/** Two bodies that meet head on after (distance - 2) / 2. */
function pair(distance = 10) {
  const motion = new Ballistic({ positions: [20, 50, 50, 20 + distance, 50, 50], velocities: [1, 0, 0, -1, 0, 0] });
  const world = new World({ box });
  const [first, second] = world.addMotion(motion, 1);
  return { world, motion, first, second };
}

/** Expects that `action` throws an error with these fields. */
function refuses(action, code, argument, body = null) {
  assert.throws(action, (error) => {
    assert.ok(error instanceof KinesphereError, `${error}`);
    assert.equal(error.code, code, error.message);
    assert.equal(error.argument, argument, error.message);
    if (body !== null) assert.equal(error.body, body);
    assert.ok(error.message.length > 10);
    return true;
  });
}

test("events come from a loop in which bodies turn", () => {
  const { world, motion, first, second } = pair();
  const kinds = [];
  for (const event of world.events(100, motion)) {
    kinds.push(event.kind);
    if (event.kind !== "contact_begin") break;
    assert.ok(Math.abs(event.time - 4) < 1e-5);
    assert.deepEqual([event.first, event.second, event.wall], [first, second, null]);
    assert.deepEqual(Array.from(event.normal), [1, 0, 0]);
    for (const [body, velocity] of [[first, [-1, 0, 0]], [second, [1, 0, 0]]]) {
      motion.setVelocity(body, event.time, velocity);
      world.setVelocity(body, velocity);
    }
  }
  assert.deepEqual(kinds, ["contact_begin", "contact_end"]);
});

test("a function answers for bodies in typed arrays", () => {
  const world = new World();
  const ids = world.addAll({
    positions: Float32Array.of(0, 0, 0, 10, 0, 0),
    velocities: Float32Array.of(1, 0, 0, 0, 0, 0),
    radii: [1, 2],
    accelerationLimits: 0.5,
  });
  assert.equal(ids.length, 2);
  let asked = 0;
  const probe = (some, time, states) => {
    asked += some.length;
    some.forEach((id, k) => states.set(id === ids[0] ? [time, 0, 0, 1, 0, 0] : [10, 0, 0, 0, 0, 0], 6 * k));
  };
  const event = world.advance(100, probe);
  assert.equal(event.kind, "contact_begin");
  assert.ok(Math.abs(event.time - 7) < 1e-5);
  assert.equal(world.counters.probes, asked);
  assert.deepEqual(Array.from(world.touching(ids[0])), [ids[1]]);
  assert.equal(world.advance(7.5, probe), null);
  assert.equal(world.time, 7.5);
});

test("the busiest bodies are named, with the reason", () => {
  const world = new World();
  world.addStatic({ halfSpace: { normal: [0, 0, 1], offset: 0 } });
  const balls = Array.from(world.addAll({ positions: [0, 0, 1, 4, 0, 1, 8, 0, 1], accelerationLimits: 10 }));
  refuses(() => world.busiest(), "not_profiling", "world");
  world.reserve(100);
  world.setProfiling(true);
  const probe = (ids, time, states) => ids.forEach((id, k) => states.set([4 * balls.indexOf(id), 0, 1, 0, 0, 0], 6 * k));
  while (world.advance(0.2, probe) !== null);
  const busiest = world.busiest();
  assert.deepEqual(busiest.map(({ body }) => body).sort(), balls);
  let probes = 0;
  for (const busy of busiest) {
    assert.equal(busy.reason, "touching");
    assert.match(busy.advice, /sleep/);
    assert.equal(busy.probes, busy.touching + busy.near + busy.windows + busy.changes + busy.queries);
    assert.deepEqual([busy.contacts, busy.accelerationLimit, busy.largestAcceleration], [1, 10, 0]);
    probes += busy.probes;
  }
  assert.equal(probes, world.counters.probes);
  assert.equal(world.busiest(1).length, 1);
  const { advances, advance, probes: inProbes } = world.timings;
  assert.ok(advances > 0 && advance > inProbes && inProbes > 0 && advance < 60, `${advances} ${advance} ${inProbes}`);
  world.setProfiling(false);
  refuses(() => world.clone().busiest(), "not_profiling", "world");
});

test("a broken promise is reported with its size", () => {
  const world = new World();
  world.addAll({ positions: [0, 0, 0, 10, 0, 0], velocities: [1, 0, 0, 0, 0, 0] });
  const probe = (ids, time, states) =>
    ids.forEach((id, k) => states.set(id === 0 ? [time, time, 0, 1, 1, 0] : [10, 0, 0, 0, 0, 0], 6 * k));
  const event = world.advance(100, probe);
  assert.equal(event.kind, "bound_violation");
  assert.ok(event.positionExcess > 0);
});

test("what a probe throws comes out, and the world goes on", () => {
  const { world, motion } = pair();
  assert.throws(() => world.advance(100, () => { throw new TypeError("the sensor is broken"); }), /sensor is broken/);
  refuses(() => world.advance(100, () => {}), "not_finite", "position");
  assert.equal(world.advance(100, motion).kind, "contact_begin");
});

test("what respond throws comes out after the events before it", () => {
  const { world, motion } = pair();
  const respond = (event) => {
    if (event.kind === "wall_begin") throw new RangeError("no walls here");
    return event.kind === "contact_begin" ? { first: [-1, 0, 0], second: [1, 0, 0] } : undefined;
  };
  const seen = [];
  assert.throws(() => world.run(200, { motion, respond }, (events) => seen.push(...events)), /no walls here/);
  assert.deepEqual(seen.map((event) => event.kind), ["contact_begin", "contact_end"]);
});

test("a world may not be used from inside its probe", () => {
  const { world } = pair();
  assert.throws(() => world.advance(100, () => world.free()), /cannot be freed while/);
  assert.throws(() => world.advance(100, () => world.remove(0)), (error) => error.code === "probe_in_progress");
  assert.throws(() => world.advance(100, () => world.advance(100, () => {})), (error) => error.code === "probe_in_progress");
});

test("wrong input is named", () => {
  const { world, motion, first } = pair();
  refuses(() => new World({ contactTolerance: -1 }), "out_of_range", "contact_tolerance");
  refuses(() => new World({ box: { lower: [0, 0, 0], upper: [1, 1, 1e12] } }), "out_of_range", "contact_tolerance");
  refuses(() => new World({ box, dimensions: 2, periodic: { x: true, z: true } }), "out_of_range", "periodic");
  refuses(() => new World({ box: { lower: [1, 0, 0], upper: [0, 1, 1] } }), "out_of_range", "box");
  refuses(() => world.add({ position: [1, 2, NaN] }), "not_finite", "position");
  refuses(() => world.add({ position: [1, 2, 3], radius: -1 }), "out_of_range", "radius");
  assert.throws(() => world.add({ position: [1, 2, 3], radius: -1 }), { message: /^add: radius/ });
  assert.throws(() => world.setRadius(first, -1), { message: /^setRadius: radius/ });
  assert.throws(() => world.setFilter(77, {}), { message: /^setFilter: body 77/ });
  refuses(() => world.setVelocity(77, [0, 0, 0]), "unknown_body", "body");
  refuses(() => world.setVelocity(0.5, [0, 0, 0]), "unknown_body", "body");
  refuses(() => world.setVelocity(-1, [0, 0, 0]), "unknown_body", "body");
  refuses(() => world.setVelocity(first, [Infinity, 0, 0]), "not_finite", "velocity", first);
  refuses(() => world.advance(-1, motion), "time_backwards", "until");
  refuses(() => world.setSensor(1, [-3]), "out_of_range", "sensor");
  refuses(() => motion.setVelocity(9, 0, [0, 0, 0]), "unknown_body", "body");
  refuses(() => new RandomForces({ positions: [0, 0, 0] }, { accelerationLimits: -1 }), "out_of_range", "acceleration_limits");
  refuses(() => World.restore(new Uint8Array(10)), "bad_snapshot", "snapshot");
  refuses(() => new Replay(new Uint8Array(10)), "bad_recording", "recording");
  refuses(() => world.stopRecording(), "not_recording", "world");
  assert.throws(() => world.add({ position: [1, 2] }), /add: position must have three numbers, but has 2/);
  assert.throws(() => world.addAll({ positions: [1, 2] }), /positions must have three numbers for each body/);
  assert.throws(() => world.addAll({ positions: [1, 2, 3], radii: [1, 2] }), /radii must have a number for each of 1/);
  assert.throws(() => world.add({ position: [1, 2, 3], userData: -4 }), /userData must be a whole number/);
  assert.throws(() => world.advance(1, null), /probe must be a function, a Motion or a BodyMap/);
  assert.throws(() => world.run(1, {}), /run: motion must be a Motion/);
  assert.throws(() => world.addStatic({}), /shape must be/);
  assert.throws(() => new Scene("nonsense"), /must be one of paper1/);
  assert.throws(() => new Scene("paper1", { bodies: 1.5 }), /bodies must be a whole number/);
  refuses(() => new Scene("paper1", { bodies: 1e6 }), "out_of_range", "bodies");
  // The second body of a wall event is null, which is not body 0.
  for (const nobody of [null, "0"]) {
    assert.throws(() => world.setVelocity(nobody, [0, 0, 0]), /setVelocity: arguments must be numbers, but one is/);
    assert.throws(() => world.remove(nobody), /remove: arguments must be numbers/);
    assert.throws(() => world.setVelocityAll([nobody], [0, 0, 0]), /setVelocityAll: bodies\[0\] must be a number, but is/);
    assert.throws(() => new BodyMap().remove(world, nobody), /arguments must be numbers/);
  }
  assert.ok(world.contains(first));
});

test("a misspelled key is named, with the nearest known one", async () => {
  const { world, motion, first } = pair();
  const positions = [0, 0, 0];
  const event = world.clone().advance(100, motion);
  const wrong = [
    [() => new World({ contactTolerence: 1e-3 }), "World: definition has no key contactTolerence; the nearest is contactTolerance"],
    [() => new World({ contact_tolerance: 1e-3 }), "World: definition has no key contact_tolerance; the nearest is contactTolerance"],
    [() => new World({ box: { min: [0, 0, 0], upper: [1, 1, 1] } }), "World: box has no key min; the nearest is"],
    [() => new World({ box, periodic: true }), "World: periodic must be an object with the keys x, y, z, but is true"],
    [() => world.add({ position: [1, 2, 3], raduis: 2 }), "add: body has no key raduis; the nearest is radius"],
    [() => world.add({ position: [1, 2, 3], filter: { masks: 2 } }), "add: filter has no key masks; the nearest is mask"],
    [() => world.addAll({ positions, radius: 2 }), "addAll: bodies has no key radius; the nearest is radii"],
    [() => world.addAll({ positions, accelerationLimit: 2 }), "addAll: bodies has no key accelerationLimit; the nearest is accelerationLimits"],
    [() => world.addMotion(motion, 1, { sensor_class: 1 }), "addMotion: options has no key sensor_class; the nearest is sensorClass"],
    [() => world.addStatic({ ball: { center: [0, 0, 0], radius: 1 } }), "addStatic: ball has no key center; the nearest is centre"],
    [() => world.addStatic({ ball: { centre: [0, 0, 0], radius: 1 } }, { solidd: false }), "addStatic: options has no key solidd; the nearest is solid"],
    [() => world.setMotionLimits(first, { acceleration: 1 }), "setMotionLimits: limits has no key acceleration; the nearest is"],
    [() => world.run(1, { motion, response: {} }), "run: options has no key response; the nearest is respond"],
    [() => world.run(1, { motion, respond: { restition: 1 } }), "run: respond has no key restition; the nearest is restitution"],
    [() => world.clone().run(9, { motion: motion.clone(), respond: () => ({ frist: [0, 0, 0] }) }), "respond: answer has no key frist; the nearest is first"],
    [() => bounce(event, { firstMas: 1 }), "bounce: options has no key firstMas; the nearest is firstMass"],
    [() => new Ballistic({ positions, velocites: positions }), "Ballistic: start has no key velocites; the nearest is velocities"],
    [() => new Ballistic({ positions }, { gravitiy: [0, 0, -9] }), "Ballistic: options has no key gravitiy; the nearest is gravity"],
    [() => new RandomForces({ positions }, { accelerationLimit: 1 }), "RandomForces: options has no key accelerationLimit; the nearest is accelerationLimits"],
    [() => new FrameMotion({ positions }, { accelerationLimits: 1, dt: 0.1 }), "FrameMotion: options has no key dt; the nearest is"],
    [() => new Scene("paper1", { body: 5 }), "Scene: settings has no key body; the nearest is bodies"],
    [() => world.teleport(first, { position: [1, 2, 3], velocty: [0, 0, 0] }), "teleport: velocity must be an array of three numbers, but is undefined"],
    [() => world.addStatic({ half_space: { normal: [0, 0, 1], offset: 0 } }), "addStatic: shape has no key half_space; the nearest is halfSpace"],
    [() => world.addZone({ ball: { centre: [0, 0, 0], radius: 1 } }, { filters: {} }), "addZone: options has no key filters; the nearest is filter"],
    [() => world.setFilter(first, { catgory: 1 }), "setFilter: filter has no key catgory; the nearest is category"],
    [() => new RecordedTracks([{ time: [0], positions }]), "RecordedTracks: body 0 must have arrays of times and positions"],
  ];
  for (const [action, message] of wrong)
    assert.throws(action, (error) => error instanceof TypeError && error.message.startsWith(message), message);
  assert.equal(world.size, 2);
  await assert.rejects(load({ smid: true }), { name: "TypeError", message: "load: options has no key smid; the nearest is simd" });
  // An array that is missing is told, too.
  assert.throws(() => world.add({}), /add: position must be an array of three numbers, but is undefined/);
  assert.throws(() => world.addAll({}), /addAll: positions must be an array, but is undefined/);
  assert.throws(() => new SteeredMotion({ positions }, {}), /SteeredMotion: accelerationLimits must be a number or an array, but is undefined/);
});

test("a value of another kind is named: JavaScript would convert it", async () => {
  const { world, motion, first } = pair();
  const position = [1, 2, 3], positions = position;
  const wrong = [
    [() => world.add({ position, radius: "1" }), 'add: radius must be a number, but is "1"'],
    [() => world.add({ position, radius: 1n }), "add: radius must be a number, but is 1n"],
    [() => world.add({ position, radius: null }), "add: radius must not be null: leave it out instead"],
    [() => world.add({ position, radius: {}.raduis }), "add: radius must not be undefined: leave it out instead"],
    [() => world.run(9, { motion, respond: undefined }), "run: respond must not be undefined: leave it out instead"],
    [() => world.add({ position, solid: 0 }), "add: solid must be a boolean, but is 0"],
    [() => world.add({ position, filter: { mask: "2" } }), 'add: filter.mask must be a number, but is "2"'],
    [() => world.add({ position: ["1", 2, 3] }), 'add: position[0] must be a number, but is "1"'],
    [() => world.add({ position: "123" }), 'add: position[0] must be a number, but is "1"'],
    [() => world.add({ position: [1, , 3] }), "add: position[1] must be a number, but is undefined"],
    [() => world.add({ position: { x: 1, y: 2, z: 3 } }), "add: position must be an array of three numbers, but is an object"],
    [() => world.addAll({ positions: [[1, 2, 3], [4, 5, 6]] }), "addAll: positions[0] must be a number, but is an array: all"],
    [() => world.addAll({ positions: BigInt64Array.of(1n, 2n, 3n) }), "addAll: positions[0] must be a number, but is 1n"],
    [() => world.addAll({ positions, velocities: [0, "1", 0] }), 'addAll: velocities[1] must be a number, but is "1"'],
    [() => world.addAll({ positions, radii: ["1"] }), 'addAll: radii[0] must be a number, but is "1"'],
    [() => world.addStatic({ ball: { centre: position, radius: "1" } }), 'addStatic: ball.radius must be a number, but is "1"'],
    [() => world.setSensor(1, 5), "setSensor: distances must be an array, but is 5"],
    [() => world.enable(first), "enable: state must be an object with position and velocity, but is undefined"],
    [() => World.restore(new ArrayBuffer(8)), "World.restore: snapshot must be a Uint8Array, but is an object of class ArrayBuffer"],
    [() => new Replay(undefined), "Replay: recording must be a Uint8Array, but is undefined"],
    [() => world.setRadius(first, "2"), 'setRadius: arguments must be numbers, but one is "2"'],
    [() => new World({ allowOverlap: 0 }), "World: allowOverlap must be a boolean, but is 0"],
    [() => new World({ contactTolerance: "1e-3" }), 'World: contactTolerance must be a number, but is "1e-3"'],
    [() => new World({ box, periodic: { x: "yes" } }), 'World: periodic.x must be a boolean, but is "yes"'],
    [() => new World([1]), "World: definition must be an object with the keys box, "],
    [() => world.run(9, { motion, respond: { restitution: "1" } }), 'run: respond.restitution must be a number, but is "1"'],
    [() => world.run(9, { motion, respond: { masses: ["1"] } }), 'run: masses[0] must be a number, but is "1"'],
    [() => new EventHash().add([]), "EventHash.add: events must be an Event or Events, but is an array"],
    [() => bounce(null), "bounce: contact must be an Event, but is null"],
    [() => new RecordedTracks([{ times: ["0", 1], positions: [0, 0, 0, 1, 1, 1] }]), "RecordedTracks: times of body 0[0] must be"],
    [() => new RecordedTracks({}), "RecordedTracks: tracks must be an array of objects with times and positions, but is an object"],
    [() => new RandomForces({ positions }), "RandomForces: options must be an object with the keys accelerationLimits, "],
    // An object of another kind would be taken for the world or the motion, at its address.
    [() => new BodyMap().add(motion, world, 0), "BodyMap.add: world must be a World, but is an object of class Ballistic"],
    [() => new BodyMap().addAll(world, world), "BodyMap.addAll: motion must be a Motion, but is an object of class World"],
    [() => new BodyMap().remove({}, 0), "BodyMap.remove: world must be a World, but is an object"],
    [() => new FrameMotion({ positions }).push(motion, positions), "push: world must be a World, but is an object of class Ballistic"],
    [() => new World().addMotion(positions), "addMotion: motion must be a Motion, but is an array"],
    // A function that answers later answers nothing.
    [() => world.clone().run(9, { motion: motion.clone(), respond: async () => ({ first: [0, 0, 0] }) }), "respond must not be an async function"],
    [() => { const other = new World(); other.addAll({ positions: [0, 0, 0, 9, 0, 0], accelerationLimits: 1 }); other.advance(9, async () => {}); },
      "probe must not be an async function"],
  ];
  for (const [action, message] of wrong)
    assert.throws(action, (error) => error instanceof TypeError && error.message.startsWith(message), message);
  const beyond = [
    [() => world.add({ position, userData: 5n }), "add: userData must be a number, but is 5n", TypeError],
    [() => world.setUserData(first, 5n), "setUserData: userData must be a whole number from 0 to 9007199254740992, but is 5n"],
    [() => new World({ dimensions: 2.5 }), "World: dimensions must be 2 or 3, but is 2.5"],
    [() => new RandomForces({ positions }, { accelerationLimits: 1, seed: -1 }), "RandomForces: seed must be a whole number from 0"],
    [() => world.run(9, { motion, respond: { restitution: 5 } }), "run: restitution must be from 0 to 1, but is 5"],
    [() => world.run(9, { motion, respond: { restingSpeed: -1 } }), "run: restingSpeed must be >= 0, but is -1"],
    [() => bounce(world.clone().advance(100, motion), { restitution: NaN }), "bounce: restitution must be from 0 to 1, but is NaN"],
  ];
  for (const [action, message, kind = RangeError] of beyond)
    assert.throws(action, (error) => error instanceof kind && error.message.startsWith(message), message);
  assert.equal(world.size, 2);
});

test("a motion without its bodies, or with other ids than numbers, is refused", () => {
  const motion = new Ballistic({ positions: [0, 0, 5, 4, 0, 5], velocities: [0, 0, -1, 0, 0, -1] });
  const floor = { halfSpace: { normal: [0, 0, 1], offset: 0 } };
  const world = new World();
  refuses(() => world.run(9, { motion }), "unknown_body", "motion");
  const first = world.addStatic(floor);
  refuses(() => world.advance(9, motion), "unknown_body", "motion");
  assert.throws(() => world.addMotion(motion), /addMotion: motion must be added to a world without bodies.*there are 1 \(a BodyMap/);
  const bodies = new BodyMap();
  bodies.addAll(world, motion);
  const hits = [...world.run(4.5, { motion: bodies, respond: { restitution: 1 } })].filter(({ kind }) => kind === "contact_begin");
  assert.deepEqual(hits.map(({ first: one, second }) => one === first || second === first), [true, true]);
  const used = new World();
  used.remove(used.addStatic(floor));
  assert.throws(() => used.addMotion(motion), /must be added to a world that never had bodies/);
  assert.equal(used.size, 0);
  assert.equal(new World().run(1, { motion: new Ballistic({ positions: [] }) }).length, 0);
});

test("a removed body's id is stale, and its place is taken again", () => {
  const { world, first } = pair();
  world.remove(first);
  refuses(() => world.body(first), "stale_body", "body", first);
  const next = world.add({ position: [70, 70, 70] });
  assert.notEqual(next, first);
  assert.equal(next % 2 ** 32, first);
  assert.ok(world.contains(next) && !world.contains(first));
});

test("a freed object says so, and may be freed twice", () => {
  const { world, motion } = pair();
  world.free();
  world.free();
  assert.throws(() => world.time, /has been freed/);
  motion.free();
  assert.throws(() => motion.state(0, 0), /has been freed/);
});

test("walls with a filter let some bodies pass", () => {
  const motion = new Ballistic({ positions: [5, 5, 5], velocities: [1, 0, 0] });
  const walls = { category: 2, mask: -1, group: 0 };
  const world = new World({ box: { lower: [0, 0, 0], upper: [10, 10, 10] }, wallFilter: walls });
  assert.deepEqual(new World(world.definition).definition.wallFilter, walls);
  const [ball] = world.addMotion(motion, 1, { filter: { mask: 1 } });
  assert.equal(world.advance(20, motion), null);
  world.setFilter(ball, {});
  assert.equal(world.advance(21, motion).kind, "wall_begin");
  assert.throws(() => new World({ wallFilter: { masks: 1 } }), /filter has no key masks/);
});

test("snapshots and clones go on alike", () => {
  const scene = new Scene("paper1", { bodies: 150, seconds: 2 });
  const world = new World({ ...scene.definition, spreadWindowStarts: true });
  const motion = scene.motion();
  world.addMotion(motion, scene.radii);
  world.run(1, { motion, respond: scene });
  const copies = [world.clone(), World.restore(world.save())].map((copy) => [copy, motion.clone()]);
  const rest = (one, moved) => new EventHash().add(one.run(2, { motion: moved, respond: scene })).value;
  const hash = rest(world, motion);
  for (const [copy, moved] of copies) assert.equal(rest(copy, moved), hash);
  assert.equal(world.audit(), null);
});

test("a game goes back eight frames in each frame, to the same end", () => {
  const start = () => {
    const positions = Array.from({ length: 64 }, (_, k) => [2.2 * (k % 8), 2.2 * Math.floor(k / 8), 0]).flat();
    const motion = new SteeredMotion({ positions }, { accelerationLimits: 5 });
    const world = new World({ contactTolerance: 1e-3 });
    world.addMotion(motion, 1);
    return { world, motion, hash: new EventHash() };
  };
  const clone = ({ world, motion, hash }) => ({ world: world.clone(), motion: motion.clone(), hash: hash.clone() });
  const play = ({ world, motion, hash }, frame, input) => {
    for (let k = 0; k < 8; ++k) motion.steer((8 * frame + k) % 64, world.time, [3 * Math.sin(input + k), 3 * Math.cos(input), 0]);
    hash.add(world.run((frame + 1) / 30, { motion, respond: { restitution: 1 } }));
  };
  const [frames, delay] = [120, 8];
  const inTime = start();
  for (let frame = 0; frame < frames; ++frame) play(inTime, frame, frame);
  let game = start();
  let past = [];
  for (let frame = 0; frame < frames + delay; ++frame) {
    const known = frame - delay;
    if (known >= 0) [[game], past] = [past, []];
    for (let again = known >= 0 ? known : frame; again <= frame && again < frames; ++again) {
      if (again > known) past.push(clone(game));
      play(game, again, again <= known ? again : 0);
    }
  }
  assert.ok(inTime.hash.count > 10, `${inTime.hash.count}`);
  assert.equal(game.hash.value, inTime.hash.value);
});

test("a recording made here replays", () => {
  const { world, motion } = pair();
  world.startRecording();
  const events = [...world.events(5, motion)];
  const recording = world.stopRecording();
  const [replay, other] = [new Replay(recording), new Replay(recording)];
  assert.equal(replay.hash, other.hash);
  const again = [];
  while (!replay.finished) {
    assert.match(replay.hash, /^[0-9a-f]{16}$/);
    const event = replay.advance();
    if (event !== null) again.push(event);
  }
  assert.deepEqual(again.map((event) => event.time), events.map((event) => event.time));
  assert.equal(replay.world.time, 5);
  assert.equal(replay.world.body(0).radius, 1);
  assert.notEqual(replay.hash, other.hash);
  while (!other.finished) other.advance();
  assert.equal(replay.hash, other.hash);
});

test("zones, fixed shapes and sensors tell", () => {
  const world = new World();
  const motion = new Ballistic({ positions: [0, 0, 0], velocities: [10, 0, 0] });
  const [ball] = world.addMotion(motion, 0.5, { sensorClass: 1 });
  const zone = world.addZone({ box: { lower: [5, -1, -1], upper: [5.001, 1, 1] } });
  const wall = world.addStatic({ halfSpace: { normal: [-1, 0, 0], offset: -20 } });
  world.setSensor(1, [2]);
  const seen = [];
  for (const event of world.events(3, motion)) {
    seen.push([event.kind, event.second]);
    if (event.kind === "contact_begin") break;
  }
  assert.deepEqual(seen.map(([kind]) => kind), ["sensor_enter", "sensor_enter", "sensor_leave", "sensor_leave", "sensor_enter", "contact_begin"]);
  assert.deepEqual(seen.at(-1), ["contact_begin", wall]);
  assert.ok(seen.some(([, other]) => other === zone) && ball === 0);
});

test("timers, states of pairs, and two that are turned back", () => {
  const world = new World();
  const motion = new Ballistic({ positions: [0, 0, 0, 6, 0, 0], velocities: [1, 0, 0, -1, 0, 0] });
  const [first, second] = world.addMotion(motion, 1);
  world.setSensor(0, [2]);
  world.setPairState(first, second, -5);
  assert.equal(world.pairState(second, first), -5);
  world.schedule(0.25, 7, 0.5);
  const seen = [];
  for (const event of world.events(10, motion)) {
    seen.push([event.kind, event.time, event.firstUserData]);
    if (event.kind === "timer" && event.time > 0.5) assert.equal(world.unschedule(7), 1);
    if (event.kind !== "sensor_enter") continue;
    assert.equal(event.pairState, -5);
    for (const [body, velocity] of [[first, [-1, 0, 0]], [second, [1, 0, 0]]]) {
      motion.setVelocity(body, event.time, velocity);
      world.setVelocity(body, velocity);
    }
    world.turnBack(event);
  }
  assert.deepEqual(seen.slice(0, 2), [["timer", 0.25, 7], ["timer", 0.75, 7]]);
  assert.deepEqual(seen.slice(2).map(([kind]) => kind), ["sensor_enter"]);
  refuses(() => world.schedule(1), "time_backwards", "time");
  assert.throws(() => world.setPairState(first, second, 0.5), /state must be a whole number/);
});

test("bodies bounce off what is fixed", () => {
  const world = new World();
  const motion = new Ballistic({ positions: [0, 0, 5], velocities: [0, 0, -1] });
  const [ball] = world.addMotion(motion, 1);
  const floor = world.addStatic({ halfSpace: { normal: [0, 0, 1], offset: 0 } });
  const table = world.addStatic({ box: { lower: [-5, -5, 8], upper: [5, 5, 9] } });
  const events = [...world.run(20, { motion, respond: { restitution: 1 } })].filter(({ kind }) => kind === "contact_begin");
  assert.deepEqual(events.map(({ second }) => second), [floor, table, floor]);
  assert.ok(Math.abs(motion.state(ball, 20).velocity[2] - 1) < 1e-12);
});

test("a run takes bounce itself as its response", () => {
  const start = () => {
    const motion = new Ballistic({ positions: [20, 50, 50, 30, 50, 50, 50, 50, 50], velocities: [3, 0, 0, -1, 0, 0, 0, 0, 0] });
    const world = new World({ box });
    world.addMotion(motion, 1);
    world.setMass(2, Infinity);
    world.addStatic({ ball: { centre: [10, 50, 50], radius: 1 } });
    world.addZone({ box: { lower: [40, 0, 0], upper: [45, 100, 100] } });
    return { motion, world };
  };
  const ends = [{ restitution: 1 }, bounce, (event) => ({ ...bounce(event), stop: false })].map((respond) => {
    const { motion, world } = start();
    world.run(200, { motion, respond });
    return Array.from(motion.states(200));
  });
  assert.deepEqual(ends[1], ends[0]);
  assert.deepEqual(ends[2], ends[0]);
  const { motion, world } = start();
  refuses(() => world.run(200, { motion, respond: ({ kind }) => (kind === "wall_begin" ? { second: [0, 0, 0] } : undefined) }),
          "unknown_body", "second_velocity");
});

test("certificates say until when nothing happens", () => {
  const { world, motion, first, second } = pair(10);
  world.run(1, { motion });
  const until = world.safeUntil(first, second);
  assert.ok(until > 3.9 && until <= 4);
  assert.ok(world.safeUntil() <= until);
  assert.deepEqual(world.earliestContact(first).partner, second);
  assert.ok(world.earliestApproach(first, 2).time < until);
  assert.equal(world.nearest([20, 50, 50], 1)[0].body, first);
  assert.ok(world.overlapping([20, 50, 50], 3).some((found) => found.body === first));
  assert.equal(world.rayCast([0, 50, 50], [1, 0, 0], 100)[0].body, first);
  const view = world.body(first);
  assert.ok(view.boxEnd > 1 && view.box.lower[0] < 21 && view.box.upper[0] > 21);
  assert.ok(world.cells().length % 7 === 0 && world.cells().length > 0);
});

test("ships are steered, and bodies added later", () => {
  const motion = new SteeredMotion({ positions: [0, 0, 0] }, { accelerationLimits: 5 });
  const world = new World();
  world.addMotion(motion);
  motion.steer(0, 0, [5, 0, 0]);
  world.run(1, { motion });
  assert.ok(Math.abs(motion.state(0, 1).position[0] - 2.5) < 1e-9);
  const number = motion.add(1, { position: [50, 0, 0], velocity: [0, 0, 0] }, 5);
  assert.equal(number, 1);
  assert.equal(world.add({ ...motion.definition(1, 1), radius: 1 }), 1);
  assert.equal(world.advance(10, motion).kind, "contact_begin");
  assert.throws(() => motion.steer(0, world.time, [9, 0, 0]), (error) => error.code === "out_of_range");
});

test("a game hands over its frames, and answers contacts between them", () => {
  const dt = 1 / 60;
  const positions = Float64Array.of(50, 50, 30, 50, 50, 33);
  const velocities = Float64Array.of(0, 0, 90, 0, 0, 0);
  const frames = new FrameMotion({ positions, velocities });
  const world = new World({ box, contacts: "impacts" });
  world.addMotion(frames, 1);
  let contacts = 0;
  for (let frame = 1; frame <= 60; ++frame) {
    for (let k = 0; k < 2; ++k) {
      velocities[3 * k + 2] -= 9.81 * dt;
      for (let axis = 0; axis < 3; ++axis) positions[3 * k + axis] += velocities[3 * k + axis] * dt;
    }
    frames.push(world, positions);
    for (const event of world.events(frames.latestTime, frames)) {
      assert.ok(event.time > frames.previousTime - 1e-12 && event.time <= frames.latestTime);
      ++contacts;
      const after = bounce(event);
      for (const [body, velocity] of [[event.first, after.first], [event.second, after.second]]) {
        if (body === null) continue;
        frames.setVelocity(body, event.time, velocity);
        world.setVelocity(body, velocity);
        velocities.set(velocity, 3 * body);
      }
    }
    positions.set(frames.latest());
  }
  assert.ok(contacts >= 2 && positions[5] - positions[2] > 2 - 1e-5);
  assert.equal(world.counters.events.bound_violation, 0);
  // A jump by the game itself: the world has to know.
  positions[0] += 5;
  refuses(() => frames.push(positions), "out_of_range", "positions", 0);
  frames.push(world, positions);
  assert.ok(world.body(0).reported.velocity[0] > 290);
  refuses(() => frames.push(world, positions), "out_of_range", "world");
  refuses(() => frames.push(world, [1, 2, 3]), "out_of_range", "positions");
});

test("frames of unequal length have times", () => {
  const positions = Float64Array.of(0, 0, 0, 4, 0, 0);
  const frames = new FrameMotion({ positions });
  const world = new World({ contacts: "impacts" });
  world.addMotion(frames, 0.5);
  let time = 0;
  const begins = [];
  for (let frame = 0; frame < 60; ++frame) {
    const dt = frame % 2 === 0 ? 0.03 : 0.01;
    time += dt;
    positions[0] += 3 * dt;
    frames.push(world, positions, time);
    assert.equal(frames.latestTime, time);
    for (const event of world.events(time, frames)) begins.push(event);
  }
  assert.ok(Math.abs(begins[0].time - 1) < 1e-5 && Math.abs(begins[0].approachSpeed - 3) < 1e-9);
  refuses(() => frames.push(world, positions, time), "time_backwards", "time");
  refuses(() => frames.push(world, positions, NaN), "not_finite", "time");
});

test("a game states limits, and is told of frames that violate them", () => {
  const positions = Float64Array.of(0, 0, 0, -5, 0, 0);
  const frames = new FrameMotion({ positions }, { accelerationLimits: 1, interval: 1 });
  const world = new World();
  world.addMotion(frames, 1);
  frames.push(positions);
  assert.equal(world.advance(1, frames), null);
  positions[3] = 5;
  refuses(() => frames.push(positions), "out_of_range", "positions", 1);
  frames.push(world, positions);
  for (const one of [frames, frames.clone()]) {
    const [jump] = one.violations();
    assert.ok(jump.body === 1 && jump.excess === 9 && jump.velocity[0] === 10);
  }
  assert.ok(Math.abs(world.advance(2, frames).time - 1.3) < 1e-6);
  // The entry of a removed body moves no other.
  frames.remove(1);
  assert.ok(Number.isNaN(frames.latest()[3]));
  world.remove(1);
  world.run(2, { motion: frames });
  refuses(() => frames.push(world, positions), "stale_body", "positions", 1);
  positions.fill(NaN, 3);
  frames.push(world, positions);
  assert.equal(frames.add(3, { position: [50, 0, 0], velocity: [0, 0, 0] }), 1);
  refuses(() => frames.push(positions), "not_finite", "positions", 1);
});

test("velocities of many are set for all or for none", () => {
  const motion = new Ballistic({ positions: [0, 0, 0, 9, 0, 0] });
  const world = new World();
  const ids = world.addMotion(motion, 1);
  refuses(() => world.setVelocityAll(ids, [1, 0, 0, NaN, 0, 0]), "not_finite", "velocity", 1);
  assert.throws(() => world.setVelocityAll(ids, [1, 0, 0]), /setVelocityAll: velocities must have three numbers for each of 2/);
  for (const k of [0, 1]) {
    assert.equal(world.body(k).reported.velocity[0], 0);
    motion.setVelocity(k, 0, [3 - 5 * k, 0, 0]);
  }
  world.setVelocityAll(ids, [3, 0, 0, -2, 0, 0]);
  assert.ok(Math.abs(world.advance(9, motion).time - 1.4) < 1e-6);
});

test("recorded tracks are gone along", () => {
  const times = [0, 1, 2, 3];
  const tracks = new RecordedTracks([
    { times, positions: [0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0] },
    { times, positions: new Float32Array([3, 0, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0]) },
  ]);
  assert.deepEqual(tracks.span(1), { begin: 0, end: 3 });
  const world = new World({ dimensions: 2 });
  world.addMotion(tracks, 0.25);
  const [begin, end] = world.run(3, { motion: tracks });
  assert.ok(Math.abs(begin.time - 1.25) < 1e-5 && Math.abs(end.time - 1.75) < 1e-5);
  refuses(() => tracks.setVelocity(0, 0, [0, 0, 0]), "unsupported", "body", 0);
  refuses(() => new World({ dimensions: 2 }).add({ ...tracks.definition(7, 0) }), "unknown_body", "body");
  assert.throws(() => new RecordedTracks([{ times, positions: [1, 2] }]), /positions of body 0 must have three numbers for each of 4/);
  assert.throws(() => new RecordedTracks([{ times: [0, 0], positions: [0, 0, 0, 1, 1, 1] }]), (error) => error.code === "out_of_range");
  const other = new World({ dimensions: 2 });
  const again = tracks.clone();
  other.addMotion(again, 0.25);
  refuses(() => other.run(3, { motion: again, respond: { restitution: 1 } }), "unsupported", "respond");
});

test("a motion that does not know the time says so, and the world goes on", () => {
  const { world, motion, first } = pair();
  const later = motion.clone();
  later.setVelocity(first, 50, [1, 0, 0]);
  refuses(() => world.run(20, { motion: later }), "out_of_range", "motion", first);
  refuses(() => world.advance(20, later), "out_of_range", "motion", first);
  const frames = new FrameMotion({ positions: [20, 50, 50, 30, 50, 50], velocities: [1, 0, 0, -1, 0, 0] }, { accelerationLimits: 0 });
  assert.throws(() => world.advance(20, frames), /Motion: body \d is known from time 0 to 0, but is asked for at/);
  assert.equal(world.advance(20, motion).kind, "contact_begin");
});

test("a copy of a motion can do what the motion can", () => {
  const motion = new SteeredMotion({ positions: [0, 0, 0] }, { accelerationLimits: 5 });
  const copy = motion.clone();
  copy.steer(0, 0, [1, 0, 0]);
  assert.equal(copy.state(0, 2).position[0], 2);
  assert.equal(motion.state(0, 2).position[0], 0);
});

test("a hash of nothing is that of no events", () => {
  const hash = new EventHash();
  assert.match(hash.value, /^[0-9a-f]{16}$/);
  const { world, motion } = pair();
  const events = world.run(50, { motion, respond: {} });
  const one = new EventHash().add(events).value;
  const other = new EventHash();
  for (const event of events) other.add(event);
  assert.equal(other.value, one);
  assert.equal(other.count, events.length);
  assert.equal(events.at(-1).time, [...events].at(-1).time);
  assert.equal(events.at(events.length), undefined);
});

test("memory comes back from thousands of worlds", () => {
  const { world, motion } = pair();
  for (let k = 0; k < 3000; ++k) world.clone().free();
  for (let k = 0; k < 3000; ++k) motion.clone().free();
  assert.ok(world.size === 2);
});

test("a static body is infinitely heavy, a zone finds its events, and a zone changes its shape", () => {
  const world = new World({ contacts: "impacts" });
  const motion = new Ballistic({ positions: [0, 0, 0], velocities: [10, 0, 0] });
  world.addMotion(motion, 1, { mass: 2 });
  world.setSensor(0, [0]);
  const zone = world.addZone({ box: { lower: [1.5, -1, -1], upper: [2, 1, 1] } });
  const post = world.addStatic({ ball: { centre: [5, 0, 0], radius: 1 } });
  const kinds = [];
  for (const event of world.events(0.25, motion)) {
    assert.equal(event.isSensedBy(zone), true);
    assert.deepEqual([event.partnerOf(zone), event.partnerOf(post)], [0, null]);
    assert.deepEqual([event.firstMass, event.secondMass], [2, Infinity]);
    assert.deepEqual(event.secondTraits, { isStatic: true, isZone: true, isSleeping: false });
    kinds.push(event.kind);
  }
  world.setShape(zone, { box: { lower: [0, -1, -1], upper: [9, 1, 1] } });
  const hit = [...world.events(0.35, motion)].find((event) => event.kind === "contact_begin");
  assert.deepEqual(kinds, ["sensor_enter"]);
  const after = bounce(hit, { restitution: 0.5 });
  assert.deepEqual([...after.first, ...after.second], [-5, 0, 0, 0, 0, 0]);
  assert.throws(() => world.setMass(post, 1), { code: "static_body" });
});

test("a mesh is one floor", () => {
  const world = new World();
  const floor = world.addMesh([-4, -4, 0, 4, -4, 0, 4, 4, 0, -4, 4, 0], [0, 1, 2, 0, 2, 3], { userData: 9 });
  world.add({ position: [1, 1, 3], velocity: [0, 0, -1], radius: 1 });
  const event = world.advance(5, (bodies, time, states) => states.set([1, 1, 3 - time, 0, 0, -1]));
  assert.equal(event.kind, "contact_begin");
  assert.deepEqual([event.first, event.firstPart, Array.from(event.normal)], [floor, 0, [0, 0, 1]]);
  assert.throws(() => world.addMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 3]), /triangle 0: corners must be less/);
  assert.throws(() => world.addMesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 1.5]), /triangle 0: corners must be less/);
  assert.throws(() => world.addMesh([0, 0, 0, 1], [0, 1, 2]), /addStatic: vertices must have three numbers each/);
  assert.throws(() => world.addMesh([], []), /corners must have at least one triangle/);
  const plane = new World({ dimensions: 2 });
  const ground = plane.addStatic({ chain: [0, 0, 2, 0, 4, 0] });
  plane.add({ position: [1, 3, 0], velocity: [0, -1, 0], radius: 1 });
  const landing = plane.advance(5, (bodies, time, states) => states.set([1, 3 - time, 0, 0, -1, 0]));
  // A zero may have either sign.
  assert.deepEqual([landing.first, Array.from(landing.normal, (x) => x + 0)], [ground, [0, 1, 0]]);
  assert.equal(plane.shapeOf(ground).mesh.corners.length, 12);
  assert.throws(() => plane.addStatic({ chain: [0, 0] }), /points must be at least two/);
  assert.throws(() => plane.addStatic({ chain: [0, 0, 1] }), /addStatic: chain must have two numbers for each point/);
});

test("a moving shape is met with its velocity", () => {
  const world = new World();
  const lift = world.addMovingShape(
    { box: { lower: [-1, -1, -0.5], upper: [1, 1, 0] } },
    { position: [0, 0, 0], velocity: [0, 0, 2], mass: Infinity });
  const ball = world.add({ position: [0.5, 0, 4], velocity: [0, 0, -1], radius: 0.5 });
  const probe = (bodies, time, states) => {
    for (let k = 0; k < bodies.length; ++k)
      states.set(bodies[k] === lift ? [0, 0, 2 * time, 0, 0, 2] : [0.5, 0, 4 - time, 0, 0, -1], 6 * k);
  };
  const event = world.advance(5, probe);
  assert.equal(event.kind, "contact_begin");
  assert.ok(Math.abs(event.time - 3.5 / 3) < 1e-5);
  assert.ok(Math.abs(event.approachSpeed - 3) < 1e-12);
  assert.deepEqual([event.first, event.second], [lift, ball]);
  assert.deepEqual(world.shapeOf(lift), { box: { lower: [-1, -1, -0.5], upper: [1, 1, 0] } });
  assert.equal(world.shapeOf(ball).ball.radius, 0.5);
  for (const shape of [{ ball: { centre: [1, 2, 3], radius: 4 } }, { halfSpace: { normal: [0, 0, 1], offset: -5 } },
                       { triangle: [[0, 0, 9], [1, 0, 9], [0, 1, 9]] },
                       { mesh: { vertices: Float64Array.of(0, 0, 9, 1, 0, 9, 0, 1, 9, 1, 1, 9), corners: Uint32Array.of(0, 1, 2, 1, 3, 2) } }])
    assert.deepEqual(world.shapeOf(world.addStatic(shape)), shape);
  assert.throws(() => world.shapeOf(99), /body/);
  assert.throws(() => world.addMovingShape({ halfSpace: { normal: [0, 0, 1], offset: 0 } }, { position: [0, 0, 0] }),
                /addMovingShape|add_moving_shape: shape must be a box, a triangle or a mesh/);
  assert.throws(() => world.addMovingShape({ box: { lower: [0, 0, 0], upper: [1, 1, 1] } }, { position: [0, 0, 0], radius: 1 }),
                /addMovingShape: body has no key radius/);
});
