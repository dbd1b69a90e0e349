// Worlds that move their own bodies.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere, refuses } from "./package_under_test.mjs";

const { Ballistic, bounce, BodyMap, GameWorld, load, World } = kinesphere;
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
