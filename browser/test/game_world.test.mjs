// Worlds that move their own bodies, potentials of steps, and rough balls.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere, refuses } from "./package_under_test.mjs";

const { Ballistic, bounce, BodyMap, GameWorld, load, StepPotential, World } = kinesphere;
await load();

/** A ball of radius 1/2 that falls from a height of 5. */
function falling(respond) {
  const room = { box: { lower: [0, 0, 0], upper: [10, 10, 10] }, contacts: "impacts" };
  const game = new GameWorld(room, { gravity: [0, 0, -10], ...(respond && { respond }) });
  return [game, game.add({ radius: 0.5, position: [5, 5, 5] })];
}

test("a game moves its bodies", () => {
  const [game, ball] = falling({ restitution: 0.5, restingSpeed: 0.1 });
  assert.equal(game.step(0.5).length, 0);
  assert.deepEqual([[...game.ids], [...game.velocities]], [[ball], [0, 0, -5]]);
  assert.ok(Math.abs(game.positions[2] - 3.75) < 1e-12);
  const [one, other] = game.addAll({ positions: [2, 2, 2, 8, 8, 8], radii: [0.5, 1] });
  game.remove(ball);
  assert.deepEqual([...game.ids], [other, one]);
  assert.deepEqual([game.indexOf(one), game.indexOf(ball), game.size], [1, -1, 2]);
  game.setGravity([0, 0, 0]);
  game.setVelocities([0, 1, 0, 0, 0, 0]);
  game.setAcceleration(one, [0, 0, 4]);
  for (const each of [game, game.clone(), GameWorld.restore(game.save())]) {
    assert.ok(each instanceof GameWorld);
    each.step(0.5);
    assert.deepEqual([...each.velocities], [0, 1, 0, 0, 0, 2]);
    assert.deepEqual([...each.gravity], [0, 0, 0]);
    assert.deepEqual(each.overlapping([2, 2, 2.5], 0.1), [{ body: one, certainly: true }]);
  }
  game.free();
  assert.throws(() => game.step(1), /has been freed/);
});

test("all calls of worlds change games", () => {
  const [game, ball] = falling();
  const other = game.add({ radius: 0.5, position: [2, 5, 5] });
  game.teleport(ball, { position: [5, 5, 8], velocity: [0, 0, -3] });
  game.setVelocityAll([ball, other], [1, 0, 0, 0, 1, 0]);
  game.setVelocity(ball, [2, 0, 0]);
  game.disable(other);
  game.enable(other, { position: [3, 5, 5], velocity: [0, 0, 1] });
  game.sleep(other);
  assert.deepEqual([[...game.positions], [...game.velocities]], [[5, 5, 8, 3, 5, 5], [2, 0, 0, 0, 0, 0]]);
  game.wake(other);
  game.addMovingShape({ box: { lower: [-1, -1, 0], upper: [1, 1, 0.5] } }, { position: [8, 8, 1], plannedAcceleration: [0, 0, 10] });
  game.addRigidBody([{ ball: { centre: [0, 0, 0], radius: 0.5 } }], { position: [8, 8, 5] });
  game.addZone({ box: { lower: [0, 0, 0], upper: [10, 10, 3] } });
  const woke = [...game.step(0.6)].filter(({ kind }) => kind === "woke");
  assert.deepEqual([woke.length, game.ids.length, game.size], [1, 4, 5]);
  const speeds = [2, 5, 8, 11].map((k) => game.velocities[k].toFixed(9));
  assert.deepEqual(speeds, ["-6.000000000", "-6.000000000", "0.000000000", "-6.000000000"]);
});

test("a response answers events", () => {
  let calls = 0;
  const [game, ball] = falling((event) => {
    if (++calls === 2) throw new Error("a slip of the pen");
    return calls === 1 ? bounce(event) : { firstAction: "remove" };
  });
  const event = game.advance(2);
  assert.deepEqual([event.kind, event.first, event.wall, game.time], ["wall_begin", ball, "z_lower", event.time]);
  assert.ok(game.velocities[2] > 0);
  assert.deepEqual([[...game.events(2)], game.time], [[], 2]);
  assert.throws(() => game.step(2), /a slip of the pen/);
  assert.deepEqual([game.step(2).length, game.ids.length], [1, 0]);
  game.setRespond({ restitution: 1 });
  game.add({ radius: 1, position: [5, 5, 5] });
  game.step(1);
  assert.equal(calls, 3);
});

test("wrong use of games is told", () => {
  const [game, ball] = falling();
  refuses(() => game.step(NaN), "not_finite", /GameWorld::step: dt/);
  refuses(() => game.step(0), "out_of_range", /dt must be > 0/);
  assert.throws(() => game.setVelocities([1, 2]), /three numbers for each of 1 bodies, but has 2/);
  refuses(() => game.setVelocities([0, NaN, 0]), "not_finite", /velocity of body 0/);
  assert.throws(() => game.setMotionLimits(ball, {}), /a GameWorld moves its bodies itself/);
  assert.throws(() => game.run(1, {}), /a GameWorld moves its bodies itself/);
  assert.throws(() => new BodyMap().addAll(game, new Ballistic({ positions: [0, 0, 0] }, {})), /must be a World/);
  assert.throws(() => new GameWorld({}, { gravitation: 1 }), /the nearest is gravity/);
  assert.throws(() => new GameWorld({}, { respond: { restitution: 2 } }), /restitution must be from 0 to 1/);
  game.remove(ball);
  refuses(() => game.setVelocity(ball, [0, 0, 0]), "stale_body", /has been removed/);
  refuses(() => World.restore(game.save()), "bad_snapshot", /mark of a world/);
});

/** Two balls of radius 1/2 with a gap of 1/5 that fly towards each other, and a well of depth 1. */
function inWell(world) {
  world.setSensor(0, [0.5]);
  return [{ positions: [-0.6, 0, 0, 0.6, 0, 0], velocities: [0.5, 0, 0, -0.5, 0, 0] },
          new StepPotential(world, { distances: [0.5], energies: [-1] })];
}

test("a well holds two in a run, a loop and a game", () => {
  const turned = (events, well) => [...events].filter((event) => well.respond(event).turnedBack).length;
  const world = new World({ contacts: "impacts" });
  const [start, well] = inWell(world);
  assert.deepEqual([well.energy(0.4), well.energy(0.6)], [-1, 0]);
  const motion = new Ballistic(start, {});
  world.addMotion(motion, 0.5);
  assert.ok(Math.abs(turned(world.run(20, { motion, respond: well }), well) - 20) <= 1);
  assert.ok(Math.abs(turned(world.run(40, { motion, respond: (event) => well.respond(event) }), well) - 20) <= 1);
  assert.equal(world.sensorOverlaps(0).length, 1);

  const game = new GameWorld({ contacts: "impacts" });
  const [pair, own] = inWell(game);
  game.addAll({ ...pair, radii: 0.5 });
  game.setRespond(own);
  own.free();
  assert.ok(Math.abs(turned(game.step(40), well) - 40) <= 1);
  assert.equal(game.sensorOverlaps(game.ids[0]).length, 1);
  refuses(() => new StepPotential(world, { distances: [0.5, 0.4], energies: [0, 1] }), "out_of_range", /distances/);
  assert.throws(() => new StepPotential(world, { distances: [0.5], energies: [] }), /as many as distances/);
});

test("an answer gives a pair its state", () => {
  const game = new GameWorld({ contacts: "impacts" }, { respond: (event) => ({ ...bounce(event), pairState: 7 }) });
  const [one, other] = game.addAll({ positions: [0, 0, 0, 5, 0, 0], velocities: [1, 0, 0, -1, 0, 0], radii: 1 });
  game.step(3);
  assert.equal(game.pairState(one, other), 7);
});

test("rough balls turn each other", () => {
  const roughness = { tangentialRestitution: 1 };
  const game = new GameWorld({}, { respond: { roughness } });
  const ball = [{ ball: { centre: [0, 0, 0], radius: 0.5 } }];
  for (const side of [-1, 1])
    game.addRigidBody(ball, { position: [2 * side, 0.2 * side, 0], velocity: [-side, 0, 0] });
  const event = game.advance(5);
  const [x, y] = game.velocities;
  const { angularVelocity: spin } = game.rotation(game.ids[0]);
  assert.ok(spin[2] !== 0 && Math.abs(x * x + y * y + 0.1 * spin[2] * spin[2] - 1) < 1e-12);
  const after = bounce(event, { roughness });
  assert.deepEqual([...after.first].slice(0, 2), [x, y]);
  assert.deepEqual(after.firstAngularVelocity[2], spin[2]);
  const smooth = { roughness: { tangentialRestitution: -1 } };
  assert.deepEqual([...bounce(event, smooth).first], [...bounce(event).first]);
  assert.throws(() => bounce(event, { roughness: { friction: -1 } }), /roughness.friction must be >= 0/);
  assert.throws(() => game.setRespond({ roughness: { inertia: 0 } }), /roughness.inertia must be > 0/);
});
