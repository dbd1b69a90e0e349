// Predictions and queries with a probe, at which bodies queries look, and pair filters.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere, refuses } from "./package_under_test.mjs";

const { Ballistic, BodyMap, load, RecordedTracks, Replay, SteeredMotion, World } = kinesphere;
await load();

/** Two ships that may turn, 10 apart, at a time when nobody has asked them for long: each is within 1.62 of its place. */
function ships() {
  const motion = new SteeredMotion({ positions: [0, 0, 0, 10, 0, 0] }, { accelerationLimits: 1 });
  const world = new World({ contactTolerance: 1e-3 });
  const [first, second] = world.addMotion(motion, 1);
  for (const _ of world.events(0, motion));
  world.add({ position: [500, 0, 0], accelerationLimit: 0 });
  const probe = (ids, time, states) =>
    ids.forEach((id, k) => states.set(id < 2 ? motion.states(time, [id]) : [500, 0, 0, 0, 0, 0], 6 * k));
  for (const _ of world.events(1.8, probe));
  return { world, motion, probe, first, second };
}

test("a query with a probe is exact, where one without says possibly", () => {
  const { world, probe } = ships();
  const way = [[0, 1.5, 0], [1, 0, 0], 100];
  const before = world.counters.probes;
  assert.deepEqual(world.rayCast(...way).map(({ certainly }) => certainly).filter(Boolean), []);
  assert.ok(world.rayCast(...way).length > 0, "it may hit a ship that has moved");
  assert.equal(world.counters.probes, before);
  assert.deepEqual(world.clone().rayCast(...way, { probe }), []);
  assert.ok(world.overlapping([0, 0, 2], 1).length > 0);
  assert.deepEqual(world.clone().overlapping([0, 0, 2.1], 1, { probe }), []);
  assert.deepEqual(world.clone().overlapping([0, 0, 1.9], 1, { probe }), [{ body: 0, certainly: true }]);
  assert.deepEqual(world.clone().overlappingBox({ lower: [-1, -1, 1.1], upper: [11, 1, 2] }, { probe }), []);
  assert.deepEqual(world.clone().nearest([9, 0, 0], 1, { probe }).map(({ body, certainly }) => [body, certainly]),
                   [[1, true]]);
  const [hit] = world.sphereCast([0, 5, 0], 0.5, [0, -1, 0], 10, { probe });
  assert.equal(hit.body, 0);
  assert.ok(Math.abs(hit.lower - 3.5) < 1e-6 && hit.upper - hit.lower < 1e-6);
  assert.ok(world.counters.probes > before);
});

test("a query passes through a body and through those that a filter excludes", () => {
  const world = new World();
  const shooter = world.add({ position: [0, 0, 0] });
  const friend = world.add({ position: [5, 0, 0], filter: { category: 2 } });
  const foe = world.add({ position: [10, 0, 0], filter: { category: 4 } });
  const hit = (options) => world.rayCast([0, 0, 0], [1, 0, 0], 100, options)[0].body;
  assert.equal(hit(), shooter);
  assert.equal(hit({ except: shooter }), friend);
  assert.equal(hit({ except: shooter, filter: { mask: 5 } }), foe);
  assert.deepEqual(world.overlapping([5, 0, 0], 9, { filter: { mask: 6 } }).map(({ body }) => body), [friend, foe]);
  assert.equal(world.nearest([0, 0, 0], 1, { except: shooter })[0].body, friend);
  assert.deepEqual(world.overlappingBox({ lower: [4, -1, -1], upper: [6, 1, 1] }, { except: friend }), []);
  assert.equal(world.sphereCast([0, 0, 0], 1, [1, 0, 0], 100, { except: shooter })[0].body, friend);
});

test("many queries at once find what each finds alone", () => {
  const { world, probe } = ships();
  const points = [0, 0, 0, 10, 0, 0, 499, 3, 0, 70, 0, 0];
  const each = Array.from({ length: 4 }, (_, k) => points.slice(3 * k, 3 * k + 3));
  const way = [1, 0.5, 0], ways = each.flatMap(() => way);
  for (const options of [{}, { probe }]) {
    const alone = (query) => each.map((point, k) => query(world.clone(), point, k));
    assert.deepEqual(world.clone().nearestAll(points, 2, options), alone((one, point) => one.nearest(point, 2, options)));
    assert.deepEqual(world.clone().overlappingAll(points, [1, 2, 3, 4], options),
                     alone((one, point, k) => one.overlapping(point, k + 1, options)));
    assert.deepEqual(world.clone().rayCastAll(points, ways, 40, options), alone((one, point) => one.rayCast(point, way, 40, options)));
    assert.deepEqual(world.clone().rayCastAll(points, ways, 40, options, 3),
                     alone((one, point) => one.sphereCast(point, 3, way, 40, options)));
  }
  const without = { except: [0, 1, 2, 0], filter: { mask: 1 } };
  assert.deepEqual(world.nearestAll(points, 1, without),
                   each.map((point, k) => world.nearest(point, 1, { except: without.except[k], filter: without.filter })));
  assert.deepEqual(world.nearestAll([], 3), []);
  assert.deepEqual(world.nearestAll(points, 1, { filter: { mask: 4 } }), [[], [], [], []]);
  // More hits than there was room for at first.
  const crowd = new World();
  crowd.addAll({ positions: Array.from({ length: 900 }, (_, k) => (k % 3 === 0 ? k : 0)) });
  assert.deepEqual(crowd.overlappingAll([0, 0, 0, 0, 9, 0], 2000).map(({ length }) => length), [300, 300]);
  assert.throws(() => world.nearestAll([1, 2], 1), /nearestAll: points must have 3 numbers for each query, but has 2/);
  assert.throws(() => world.rayCastAll(points, [1, 0, 0], 9), /rayCastAll: directions must have a number for each of 12/);
  assert.throws(() => world.nearestAll(points, 1, { except: [1] }), /nearestAll: except must have a number for each of 4/);
  assert.throws(() => world.nearestAll(points, 1, { excpet: [1] }), /nearestAll: options has no key excpet/);
  refuses(() => world.overlappingAll(points, [1, 1, -1, 1]), "out_of_range", /query 2/);
});

test("predictions reach further with a probe, for a distance, and for a time", () => {
  const { world, motion, first, second } = ships();
  const known = world.safeUntil(first, second);
  const fresh = world.clone().safeUntil(first, second, { probe: motion });
  assert.ok(fresh > known && fresh >= world.time, `${known} ${fresh}`);
  assert.ok(world.safeUntil(first, second, { distance: 5 }) < known);
  const { lower, upper } = world.clone().distanceLimits(first, second, world.time, { probe: motion });
  assert.ok(lower <= 8 && upper >= 8 && upper - lower < 1e-6, `${lower} ${upper}`);
  const later = world.distanceLimits(first, second, world.time + 1);
  assert.ok(later.lower < lower && later.upper > upper);
  const alone = new World();
  const ball = alone.add({ position: [0, 0, 0], accelerationLimit: 1 });
  const other = alone.add({ position: [50, 0, 0] });
  const probe = (ids, _, states) => ids.forEach((id, k) => states.set([id === ball ? 0 : 50, 0, 0, 0, 0, 0], 6 * k));
  for (const _ of alone.events(3, probe));
  const { time, partner } = alone.clone().earliestContact(ball, { probe });
  assert.equal(partner, other);
  assert.ok(time > alone.earliestContact(ball).time);
  assert.ok(alone.clone().earliestApproach(ball, 5, { probe }).time > alone.earliestApproach(ball, 5).time);
  assert.ok(alone.clone().safeUntil({ probe }) > alone.safeUntil());
});

test("what an answer with a probe cannot use is named", () => {
  const { world, first, second, probe } = ships();
  assert.throws(() => world.rayCast([0, 0, 0], [1, 0, 0], 9, { execpt: 1 }), /rayCast: options has no key execpt; the nearest is except/);
  assert.throws(() => world.rayCast([0, 0, 0], [1, 0, 0], 9, { except: null }), /rayCast: except must not be null/);
  assert.throws(() => world.nearest([0, 0, 0], 1, { filter: { masc: 1 } }), /nearest: filter has no key masc/);
  assert.throws(() => world.overlapping([0, 0, 0], 0.5, { probe: 3 }), /overlapping: probe must be a function, a Motion or a BodyMap/);
  assert.throws(() => world.overlapping([0, 0, 0], 0.5, probe), /overlapping: options must be an object/);
  assert.throws(() => world.safeUntil(first, second, { distanse: 1 }), /nearest is distance/);
  refuses(() => world.safeUntil(first, second, { distance: -1 }), "out_of_range", /distance/);
  refuses(() => world.distanceLimits(first, second, 1), "time_backwards", /time/);
  refuses(() => world.overlapping([0, 0, 0], 0.5, { probe: new BodyMap() }), "unknown_body", /not added through this map/);
  const tracks = new RecordedTracks([{ times: [0, 1, 2], positions: [0, 0, 0, 1, 0, 0, 2, 0, 0] }]);
  refuses(() => world.overlapping([10, 0, 0], 0.5, { probe: tracks }), "unknown_body", /body/);
  assert.throws(() => world.overlapping([0, 0, 0], 0.5, { probe() { throw new Error("mine"); } }), { message: "mine" });
  assert.throws(() => world.overlapping([0, 0, 0], 0.5, { probe: () => world.remove(first) }), /probe may not call/);
  refuses(() => world.overlapping([0, 0, 0], 0.5, { probe() {} }), "not_finite", /position/);
  assert.equal(world.clone().overlapping([0, 0, 0], 0.5, { probe }).length, 1, "the world goes on");
  world.startRecording();
  const replay = new Replay(world.stopRecording());
  assert.ok(replay.world.overlapping([0, 0, 0], 0.5).length > 0);
  assert.throws(() => replay.world.overlapping([0, 0, 0], 0.5, { probe }), /overlapping: the world of a replay cannot ask a probe/);
});

/** Three balls in a row, the first of which comes. */
function row(options = {}) {
  const motion = new Ballistic({ positions: [0, 0, 0, 5, 0, 0, 10, 0, 0], velocities: [1, 0, 0, 0, 0, 0, 0, 0, 0] });
  const world = new World(options);
  const ids = world.addMotion(motion, 1);
  return { world, motion, ids };
}
const pairs = (events) => Array.from(events).filter(({ kind }) => kind === "contact_begin").map(({ first, second }) => [first, second]);

test("a pair filter lets pairs pass, until it is refreshed or removed", () => {
  const { world, motion } = row();
  let friends = true;
  world.setPairFilter((a, b) => !friends || a + b !== 1);
  assert.deepEqual(pairs(world.clone().events(20, motion)), [[0, 2]], "clones have it");
  assert.deepEqual(pairs(world.run(20, { motion: motion.clone() })), [[0, 2]]);
  const again = row();
  again.world.setPairFilter((a, b) => !friends || a + b !== 1);
  for (const _ of again.world.events(4, again.motion));
  friends = false;
  again.world.refreshFilter(again.ids[0]);
  assert.deepEqual(pairs(again.world.events(20, again.motion)), [[0, 1], [0, 2]]);
  const none = row();
  none.world.setPairFilter(() => false);
  assert.deepEqual(pairs(none.world.events(4, none.motion)), []);
  const snapshot = none.world.save();
  refuses(() => World.restore(snapshot), "bad_snapshot", /pair_filter must be given/);
  assert.throws(() => World.restore(snapshot, 3), /pairFilter must be a function or null, but is 3/);
  assert.deepEqual(pairs(World.restore(snapshot, () => false).events(20, none.motion.clone())), []);
  none.world.setPairFilter(null);
  assert.deepEqual(pairs(none.world.events(20, none.motion)), [[0, 1], [0, 2]]);
});

test("what a pair filter may not do is named, and no event is lost", () => {
  const { world, motion, ids } = row();
  assert.throws(() => world.setPairFilter(3), /setPairFilter: filter must be a function or null, but is 3/);
  refuses(() => world.refreshFilter(77), "unknown_body", /refresh_filter: body 77/);
  let seen = null;
  world.setPairFilter((a) => { seen ??= world.body(a).radius; return true; });
  assert.deepEqual(pairs(world.clone().events(20, motion)), [[0, 1], [0, 2]]);
  assert.equal(seen, 1, "it may read the world");
  world.setPairFilter(() => { world.remove(ids[0]); return true; });
  refuses(() => world.advance(20, motion), "filter_in_progress", /remove/);
  const asked = row().world;
  asked.setPairFilter((a) => { asked.remove(a); return true; });
  refuses(() => asked.earliestContact(0), "filter_in_progress", /remove: a pair filter may not call it/);
  const thrower = row();
  const found = [];
  let throws = 0;
  thrower.world.setPairFilter(() => { ++throws; throw new Error("mine"); });
  for (let k = 0; k < 100; ++k) {
    try {
      const event = thrower.world.advance(20, thrower.motion);
      if (event === null) break;
      found.push(event);
    } catch (error) {
      assert.equal(error.message, "mine");
    }
  }
  assert.ok(throws > 0);
  assert.deepEqual(pairs(found), [[0, 1], [0, 2]]);
  assert.equal(thrower.world.time, 20);
  const touching = row();
  for (const { kind } of touching.world.events(20, touching.motion)) if (kind === "contact_begin") break;
  assert.throws(() => touching.world.setPairFilter(() => { throw new Error("of the pair in touch"); }), /in touch/);
  refuses(() => touching.world.advance(20, (ids, time, states) => {
    assert.throws(() => touching.world.setPairFilter(null), /probe may not call/);
    states.fill(NaN);
  }), "not_finite", /position/);
  assert.throws(() => touching.world.run(20, { motion: touching.motion }), /in touch/, "it is still set");
  for (const wrong of [() => 1, () => undefined, async () => true]) {
    const next = row();
    next.world.setPairFilter(wrong);
    assert.throws(() => next.world.run(20, { motion: next.motion }), /pair filter/);
  }
  const strict = new World({ allowOverlap: false });
  strict.add({ position: [0, 0, 0] });
  strict.setPairFilter(() => { throw new Error("mine"); });
  assert.throws(() => strict.add({ position: [1, 0, 0] }), { message: "mine" });
  strict.setPairFilter(() => { strict.free(); return true; });
  assert.throws(() => strict.add({ position: [1, 0, 0] }), /cannot be freed/);
  assert.equal(strict.size, 1, "the two may touch then, so the second is refused");
});
