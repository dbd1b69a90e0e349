// Worlds whose bodies several motions move, filters, and queries with spheres and boxes.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere, refuses } from "./package_under_test.mjs";

const { Ballistic, BodyMap, EventHash, FrameMotion, load, RecordedTracks, Scene, SteeredMotion, World } = kinesphere;
await load();

const box = { lower: [0, 0, 0], upper: [100, 100, 100] };

test("a map of one motion gives the events that the motion itself gives", () => {
  const scene = new Scene("paper1", { bodies: 150, seconds: 2 });
  const run = (motionOf) => {
    const world = new World(scene.definition);
    const motion = scene.motion();
    const events = world.run(scene.endTime, { motion: motionOf(world, motion), respond: scene });
    return { hash: new EventHash().add(events).value, count: events.length };
  };
  const own = run((world, motion) => {
    world.addMotion(motion, scene.radii);
    return motion;
  });
  const mapped = run((world, motion) => {
    const bodies = new BodyMap();
    bodies.addAll(world, motion, scene.radii);
    return bodies;
  });
  assert.ok(own.count > 50);
  assert.equal(mapped.hash, own.hash);
});

/** Two motions: steered balls, and flights that are added and removed. Ids are not the numbers of the motions. */
function game() {
  const world = new World({ box });
  const ships = new SteeredMotion({ positions: [20, 50, 50, 80, 50, 50] }, { accelerationLimits: 5 });
  const flights = new Ballistic({ positions: [50, 90, 50], velocities: [0, 0, 0] });
  const bodies = new BodyMap();
  const [rock] = bodies.addAll(world, flights, 2);
  const [one, other] = bodies.addAll(world, ships, [1, 3], { userData: 7, mass: 4 });
  return { world, ships, flights, bodies, rock, one, other };
}

test("bodies of two motions meet, turn, come and go", () => {
  const { world, ships, flights, bodies, rock, one, other } = game();
  assert.deepEqual([rock, one, other], [0, 1, 2]);
  assert.deepEqual([world.body(other).radius, world.body(other).userData, world.body(other).mass], [3, 7, 4]);
  const shot = flights.add(0, { position: [25, 50, 50], velocity: [50, 0, 0] });
  const bullet = bodies.add(world, flights, shot, { radius: 0.5, filter: { category: 2 } });
  const found = bodies.find(bullet);
  assert.ok(found.motion === flights && found.number === shot);
  assert.ok(bodies.find(other).motion === ships && bodies.find(other).number === 1);
  assert.equal(bodies.find(99), null);
  const event = world.advance(10, bodies);
  assert.deepEqual([event.kind, event.first, event.second], ["contact_begin", other, bullet]);
  assert.ok(Math.abs(event.time - (80 - 25 - 3.5) / 50) < 1e-6, `${event.time}`);
  assert.deepEqual(Array.from(bodies.states(event.time, [bullet, 99]).subarray(1, 7)).slice(0, 5), [50, 50, 50, 0, 0]);
  bodies.remove(world, bullet);
  assert.equal(flights.contains(shot), false);
  assert.ok(!world.contains(bullet) && bodies.find(bullet) === null);
  bodies.setVelocity(world, one, [0, 40, 0]);
  assert.deepEqual(Array.from(ships.state(0, world.time).velocity), [0, 40, 0]);
  bodies.teleport(world, rock, { position: [20, 60, 50], velocity: [0, 0, 0] });
  const events = world.run(world.time + 1, { motion: bodies, respond: { restitution: 1 } });
  assert.deepEqual([...events].map(({ kind, first, second }) => [kind, first, second]).filter(([kind]) => kind === "contact_begin"),
                   [["contact_begin", rock, one]]);
  assert.equal(world.audit(), null);
});

test("a map keeps its motions, and one of clones goes on alike", () => {
  const { world, ships, flights, bodies } = game();
  bodies.setVelocity(world, 1, [30, 0, 0]);
  const copies = [ships.clone(), flights.clone()];
  const saved = { world: world.clone(), bodies: bodies.withMotions([ships, flights], copies) };
  assert.ok(saved.bodies.find(0).motion === copies[1]);
  ships.free();
  flights.free();
  const run = (map, of) => new EventHash().add(of.run(5, { motion: map, respond: { restitution: 1 } }));
  const hash = run(bodies, world);
  assert.ok(hash.count > 0);
  copies.forEach((copy) => copy.free());
  assert.equal(run(saved.bodies, saved.world).value, hash.value);
});

test("a box turns from frame to frame", () => {
  const aboutZ = (angle) => [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)];
  const frames = new FrameMotion({ positions: [0, 0, 0] }, { interval: 1, rotations: aboutZ(0) });
  const world = new World({ contacts: "impacts" });
  const bodies = new BodyMap();
  const box = [{ box: { lower: [-1.8, -0.1, 0], upper: [1.8, 0.1, 0], radius: 0.1 } }];
  const car = bodies.addRigidBody(world, frames, 0, box, { angularAccelerationLimit: 1, largestAngularSpeed: 9 });
  world.setRotationProbe((ids, time, rotations) => rotations.set(bodies.rotations(time, ids)));
  world.addStatic({ ball: { centre: [0, 1.5, 0], radius: 0.3 } });
  refuses(() => bodies.push(world, frames, [0, 0, 0], 1), "out_of_range", /rotations/);
  bodies.push(world, frames, [0, 0, 0], 1, aboutZ(Math.PI / 2));
  const event = world.advance(1, bodies);
  assert.ok(Math.abs(event.time - (1 - Math.asin(1 / 3) / (Math.PI / 2))) < 1e-4);
  assert.ok(Math.abs(bodies.rotations(0.5, [car])[6] - Math.PI / 2) < 1e-12);
  assert.deepEqual([...frames.latestRotations()], aboutZ(Math.PI / 2));
});

test("a game hands over frames beside a motion of its own", () => {
  const frames = new FrameMotion({ positions: [10, 50, 50, 90, 50, 50] }, { interval: 1 });
  const flights = new Ballistic({ positions: [50, 50, 50] });
  const world = new World({ box });
  const bodies = new BodyMap();
  bodies.addAll(world, flights);
  const [, second] = bodies.addAll(world, frames);
  bodies.push(world, frames, [10, 50, 50, 40, 50, 50]);
  const event = world.advance(frames.latestTime, bodies);
  assert.deepEqual([event.first, event.second], [0, second]);
  assert.ok(Math.abs(event.time - 38 / 50) < 1e-6);
  refuses(() => bodies.push(world, frames, [1, 2, 3]), "out_of_range", /positions/);
  refuses(() => bodies.push(world, flights, [1, 2, 3]), "unsupported", /push: frames must be a FrameMotion/);
});

test("a steered lift lifts a ball", () => {
  const world = new World();
  const lifts = new SteeredMotion({ positions: [0, 0, 0] }, { accelerationLimits: 5 });
  const balls = new Ballistic({ positions: [0.5, 0, 4], velocities: [0, 0, -1] });
  const bodies = new BodyMap();
  const shape = { box: { lower: [-1, -1, -0.5], upper: [1, 1, 0] } };
  const lift = bodies.addMovingShape(world, lifts, 0, shape, { mass: Infinity, userData: 3 });
  const [ball] = bodies.addAll(world, balls, 0.5);
  assert.equal(world.body(lift).userData, 3);
  assert.ok(bodies.find(lift).motion === lifts);
  bodies.setVelocity(world, lift, [0, 0, 2]);
  const event = world.advance(5, bodies);
  assert.deepEqual([event.kind, event.first, event.second], ["contact_begin", lift, ball]);
  assert.ok(Math.abs(event.time - 3.5 / 3) < 1e-5 && Math.abs(event.approachSpeed - 3) < 1e-12);
  assert.equal(world.audit(), null);
  refuses(() => bodies.addMovingShape(world, lifts, 7, shape), "unknown_body", /body/);
  refuses(() => bodies.addMovingShape(world, balls, 0, { ball: { centre: [0, 0, 0], radius: 1 } }), "unsupported", /shape/);
  assert.throws(() => bodies.addMovingShape(world, lifts, 0, shape, { radius: 1 }), /BodyMap.addMovingShape: options has no key radius/);
});

test("wrong use of a map is named", () => {
  const { world, ships, flights, bodies, one } = game();
  refuses(() => bodies.setVelocity(world, 77, [0, 0, 0]), "unknown_body", /was not added through this map/);
  refuses(() => bodies.teleport(world, 77, { position: [1, 1, 1], velocity: [0, 0, 0] }), "unknown_body", /was not added/);
  refuses(() => bodies.remove(world, 77), "unknown_body", /was not added/);
  refuses(() => bodies.add(world, ships, 9), "unknown_body", /body/);
  refuses(() => bodies.add(world, ships, 0.5), "unknown_body", /body/);
  refuses(() => bodies.add(world, ships, 0, { radius: -1 }), "out_of_range", /radius/);
  refuses(() => bodies.addAll(world, ships, [1, -1]), "out_of_range", /radius/);
  assert.equal(world.size, 3);
  refuses(() => bodies.withMotions([ships], [ships]), "out_of_range", /from must have every motion/);
  const stray = world.add({ position: [50, 10, 10], accelerationLimit: 10 });
  refuses(() => world.advance(9, bodies), "unknown_body", /was not added through this map/);
  world.remove(stray);
  assert.equal(world.advance(9, bodies), null);
  const message = (action, text) => assert.throws(action, (error) => error.message.startsWith(text), text);
  message(() => bodies.addAll(world, ships, [1]), "BodyMap.addAll: radii must have a number for each of 2");
  message(() => bodies.add(world, ships, 0, { raduis: 1 }), "BodyMap.add: body has no key raduis; the nearest is radius");
  message(() => bodies.addAll(world, ships, 1, { userdata: 1 }), "BodyMap.addAll: options has no key userdata; the nearest is userData");
  message(() => bodies.teleport(world, one, { position: [0, 0, 0] }), "BodyMap.teleport: velocity must be an array of three numbers, but is undefined");
  message(() => bodies.withMotions([ships], []), "withMotions: to must have as many motions as from");
  message(() => world.advance(1, {}), "advance: probe must be a function, a Motion or a BodyMap");
  bodies.setVelocity(world, one, [30, 0, 0]);
  for (const used of [bodies, world])
    message(() => world.run(20, { motion: bodies, respond: () => used.free() }), "kinesphere: an object cannot be freed");

  // A time at which a motion has no state, and bodies that cannot turn.
  const tracks = new RecordedTracks([{ times: [0, 1], positions: [10, 10, 10, 90, 10, 10] }]);
  const fixed = new BodyMap();
  const other = new World({ box });
  fixed.addAll(other, tracks);
  refuses(() => other.run(5, { motion: fixed, respond: { restitution: 1 } }), "unsupported", /respond/);
  const late = new FrameMotion({ positions: [50, 50, 50] });
  refuses(() => fixed.add(other, late, 0), "out_of_range", /is known from time 0 to 0/);
  const flight = new Ballistic({ positions: [50, 50, 80] }, { startTime: 50 });
  refuses(() => fixed.addAll(other, flight), "out_of_range", /is known from time 50/);
  assert.equal(other.size, 1);
});

test("filters say which bodies, fixed ones and zones meet, and may change", () => {
  const world = new World();
  const motion = new Ballistic({ positions: [0, 0, 0, 0, 9, 0], velocities: [10, 0, 0, 10, 0, 0] });
  const [ghost, ball] = world.addMotion(motion, 1);
  world.setFilter(ghost, { category: 2 });
  assert.deepEqual(world.body(ghost).filter, { category: 2, mask: -1, group: 0 });
  const wall = world.addStatic({ halfSpace: { normal: [-1, 0, 0], offset: -20 } }, { filter: { mask: 1 } });
  const zone = world.addZone({ box: { lower: [5, -99, -1], upper: [6, 99, 1] } }, { filter: { mask: 1 }, userData: 5 });
  const seen = (until) => [...world.events(until, motion)].map(({ kind, first, second }) => [kind, first, second]);
  assert.deepEqual(seen(2.5), [["sensor_enter", ball, zone], ["sensor_leave", ball, zone], ["contact_begin", ball, wall]]);
  assert.deepEqual([world.body(zone).userData, world.body(zone).solid, world.body(ball).solid], [5, false, true]);
  // The filter admits the ghost, which is deep inside.
  world.setFilter(wall, {});
  assert.deepEqual(seen(2.5), [["contact_begin", ghost, wall]]);
  world.setFilter(ball, { group: -3 });
  world.setFilter(wall, { group: -3 });
  assert.deepEqual(seen(2.5), [["contact_end", ball, wall]]);
  world.setSolid(ghost, false);
  assert.deepEqual(seen(2.5), [["contact_end", ghost, wall]]);
  world.setUserData(ball, 2 ** 40);
  assert.equal(world.body(ball).userData, 2 ** 40);
  world.setSensorClass(ball, 3);
  world.setSensor(3, [20], 2);
  assert.deepEqual(seen(2.5), [["sensor_enter", ghost, ball]]);
  assert.deepEqual(world.sensorOverlaps(ball), [{ body: ghost, distance: 20 }]);
  assert.throws(() => world.addZone({ ball: { centre: [0, 0, 0], radius: 1 } }, 7), /addZone: options must be an object with the keys filter, userData, but is 7/);
  assert.throws(() => world.setFilter(ball, { masks: 1 }), /setFilter: filter has no key masks; the nearest is mask/);
  assert.throws(() => world.setFilter(ball, { category: -1 }), /setFilter: filter.category must be a whole number/);
  refuses(() => world.setFilter(99, {}), "unknown_body", /body 99/);
});

test("a sphere is cast, and a box finds what it overlaps", () => {
  const world = new World({ box });
  const ids = world.addAll({ positions: [20, 50, 50, 60, 53, 50], radii: 1 });
  const hit = (radius, length = 90) => world.sphereCast([5, 50, 50], radius, [2, 0, 0], length).map(({ body }) => body);
  assert.deepEqual([hit(0.5), hit(0.5, 10), world.sphereCast([30, 50, 50], 1.5, [1, 0, 0], 60).length], [[ids[0]], [], 0]);
  const [first] = world.sphereCast([30, 50, 50], 3, [1, 0, 0], 60);
  const expected = 30 - Math.sqrt(16 - 9);
  assert.ok(first.body === ids[1] && first.certainly && first.lower <= expected + 1e-9 && first.upper >= expected - 1e-9);
  assert.deepEqual(world.overlappingBox({ lower: [18, 40, 40], upper: [19.5, 60, 60] }), [{ body: ids[0], certainly: true }]);
  assert.deepEqual(world.overlappingBox({ lower: [30, 40, 40], upper: [40, 60, 60] }), []);
  refuses(() => world.sphereCast([0, 0, 0], -1, [1, 0, 0], 5), "out_of_range", /radius/);
  refuses(() => world.sphereCast([0, 0, 0], 1, [0, 0, 0], 5), "out_of_range", /direction/);
  refuses(() => world.overlappingBox({ lower: [5, 0, 0], upper: [1, 1, 1] }), "out_of_range", /box/);
  assert.throws(() => world.overlappingBox({ lower: [5, 0, 0], uper: [1, 1, 1] }), /overlappingBox: box has no key uper; the nearest is upper/);
});

/** A bullet flies at a rock, and a tired ball at a post; all are bodies of one motion. */
function shooting() {
  const world = new World({ box: { lower: [0, 0, 0], upper: [20, 20, 20] } });
  const flights = new Ballistic({ positions: [], velocities: [] });
  const bodies = new BodyMap();
  const add = (position, speed, radius = 0.5) =>
    bodies.add(world, flights, flights.add(world.time, { position, velocity: [speed, 0, 0] }), { radius });
  const [bullet, rock, tired, post] = [add([1, 5, 5], 4), add([8, 5, 5], 0), add([1, 9, 9], 1), add([8, 9, 9], 0)];
  const burst = (event) => event.kind === "contact_begin" && event.first === bullet;
  const respond = (event) => {
    if (burst(event)) return { firstAction: "remove", secondAction: "remove", stop: true };
    if (event.kind === "wall_begin") return { firstAction: "disable" };
    return event.kind === "contact_begin" ? { firstAction: "sleep" } : undefined;
  };
  return { world, flights, bodies, add, bullet, rock, tired, post, burst, respond };
}

test("answers remove, disable and put to sleep, and stop the world for more", () => {
  const { world, flights, bodies, add, bullet, rock, tired, burst, respond } = shooting();
  let fragment = null;
  const atStop = (event) => {
    assert.ok(burst(event) && world.time === event.time && !world.contains(bullet) && bodies.find(rock) === null);
    assert.throws(() => world.advance(20, bodies), { code: "run_in_progress" });
    assert.throws(() => world.free(), /cannot be freed/);
    fragment = add([...event.point], 2);
  };
  const events = world.run(10, { motion: bodies, respond, atStop });
  assert.ok(bodies.find(fragment).number < 2, "the number of one that has gone");
  assert.equal(flights.size, 4);
  assert.ok(world.size === 3 && !world.contains(rock) && !world.body(fragment).enabled && world.body(tired).sleeping);
  assert.ok(Math.abs(bodies.states(10, [tired])[0] - 7) < 1e-4);

  // A loop does the same.
  const other = shooting();
  const hash = new EventHash();
  for (const event of other.world.events(10, other.bodies)) {
    hash.add(event);
    const answer = other.respond(event);
    if (answer?.stop) {
      other.bodies.remove(other.world, event.first);
      other.bodies.remove(other.world, event.second);
      other.add([...event.point], 2);
    } else if (answer?.firstAction === "disable") {
      other.world.disable(event.first);
    } else if (answer?.firstAction === "sleep") {
      other.bodies.setVelocity(other.world, event.first, [0, 0, 0]);
      other.world.sleep(event.first);
    }
  }
  assert.equal(hash.value, new EventHash().add(events).value);
});

test("wrong answers are refused, and what atStop throws comes out", () => {
  const { world, bodies, respond, add } = shooting();
  const refused = (answer, expected) =>
    assert.throws(() => world.run(10, { motion: bodies, respond: () => answer, atStop: () => {} }), expected);
  refused({ firstAction: "explode" }, /firstAction must be "remove", "disable" or "sleep", but is "explode"/);
  refused({ firstActon: "remove" }, /nearest is firstAction/);
  assert.throws(() => world.run(10, { motion: bodies, respond }), /stop needs atStop/);
  assert.throws(() => world.run(10, { motion: bodies, respond, atStop: true }), /atStop must be a function/);
  let told = 0, stopped = 0;
  const atStop = (event) => {
    stopped = event.time;
    throw new Error("no fragments");
  };
  const sink = (events) => {
    told += events.length;
  };
  assert.throws(() => world.run(10, { motion: bodies, respond, atStop }, sink), /no fragments/);
  assert.ok(told === 1 && world.time === stopped && stopped < 10, "the world stands at the stop");
  // The run goes on behind the stop.
  add([5, 15, 15], 10);
  world.run(10, { motion: bodies, respond, atStop }, sink);
  assert.ok(told > 3 && world.time === 10);

  // Also where nothing is left that could be asked or tell of anything.
  const flights = new Ballistic({ positions: [0, 0, 0, 5, 0, 0], velocities: [1, 0, 0, 0, 0, 0] });
  const pair = new World();
  const pairs = new BodyMap();
  pairs.addAll(pair, flights, 0.5);
  const both = () => ({ firstAction: "remove", secondAction: "remove", stop: true });
  assert.throws(() => pair.run(100, { motion: pairs, respond: both, atStop }), /no fragments/);
  assert.ok(pair.time === stopped && stopped < 5 && flights.size === 2);

  const box = { lower: [0, 0, 0], upper: [9, 9, 9] };
  const alone = new World({ box });
  const map = new BodyMap();
  const motion = new Ballistic({ positions: [5, 5, 5], velocities: [1, 0, 0] });
  map.addAll(alone, motion);
  const wall = { motion: map, respond: () => ({ secondAction: "remove" }) };
  assert.throws(() => alone.run(10, wall), { code: "unknown_body", argument: "second_action" });
});
