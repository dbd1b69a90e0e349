// Monitors against tracks that are computed here: all of them go straight on, so that every time is known.
import assert from "node:assert/strict";
import { test } from "node:test";

import { kinesphere, refuses } from "./package_under_test.mjs";

const { load, Monitor, monitorEventKinds } = kinesphere;
await load();

/** Returns a generator of numbers from 0 to 1, the same in each run. */
function random(seed) {
  return () => (seed = (seed * 16807) % 2147483647) / 2147483647;
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => a.map((value, axis) => value - b[axis]);

/** `count` tracks in a box of this size, with ids 7, 10, 13, ... */
function straightTracks(count, size, speed, seed) {
  const next = random(seed);
  const three = (scale, shift) => [0, 1, 2].map(() => scale * (next() - shift));
  return Array.from({ length: count }, (_, k) => ({ id: 7 + 3 * k, from: three(size, 0.5), velocity: three(speed, 0.5) }));
}
const placeOf = ({ from, velocity }, time) => from.map((value, axis) => value + velocity[axis] * time);

/** Closest approach of two tracks, and the times at which their distance is `distance`. */
function course(one, other, distance) {
  const s = minus(other.from, one.from), v = minus(other.velocity, one.velocity);
  const closestTime = -dot(s, v) / dot(v, v);
  const closest = Math.sqrt(Math.max(0, dot(s, s) - closestTime ** 2 * dot(v, v)));
  const half = closest <= distance ? Math.sqrt((distance ** 2 - closest ** 2) / dot(v, v)) : NaN;
  return { closestTime, closest, speed: Math.sqrt(dot(v, v)), enter: closestTime - half, leave: closestTime + half };
}

function* pairsOf(tracks) {
  for (let a = 0; a < tracks.length; ++a) for (let b = a + 1; b < tracks.length; ++b) yield [tracks[a], tracks[b]];
}

/** Reports of all tracks at this time as a batch, with errors of at most `error` if there is a generator. */
function batch(tracks, time, error = 0, next = () => 0.5) {
  const about = (values) => values.map((value) => value + (error / 2) * (2 * next() - 1));
  return {
    ids: tracks.map(({ id }) => id),
    timestamps: time,
    positions: Float64Array.from(tracks.flatMap((track) => about(placeOf(track, time)))),
    velocities: tracks.flatMap(({ velocity }) => about(velocity)),
    positionErrors: error,
    velocityErrors: error,
  };
}

/** A monitor of one class; straight tracks keep a limit of 0. */
function monitorOf(level, more = {}) {
  return new Monitor({ classes: [{ accelerationLimit: 0 }], separations: [{ levels: [level] }], ...more });
}

const near = (value, expected, within = 1e-6) =>
  assert.ok(value === expected || Math.abs(value - expected) <= within, `${value} instead of ${expected}`);

test("verdicts are those of straight tracks, with exact reports and with errors", () => {
  const distance = 5, until = 20;
  for (const error of [0, 0.2]) {
    const tracks = straightTracks(30, 30, 6, 5);
    const next = random(11);
    const monitor = monitorOf({ sphere: { distance } });
    const now = new Map();
    const key = (one, other) => `${one.id} ${other.id}`;
    let certain = 0, withins = 0, all = 0, events = 0;
    for (let time = 0; time < until; ++time) {
      monitor.reportAll(batch(tracks, time, error, next));
      for (let step = 1; step <= 4; ++step) {
        for (const event of monitor.run(time + step / 4)) {
          ++events;
          assert.equal(event.before, now.get(`${event.first} ${event.second}`) ?? "apart");
          now.set(`${event.first} ${event.second}`, event.verdict);
        }
        for (const [one, other] of pairsOf(tracks)) {
          const verdict = now.get(key(one, other)) ?? "apart";
          const gap = Math.sqrt(dot(...Array(2).fill(minus(placeOf(one, monitor.time), placeOf(other, monitor.time)))));
          if (verdict === "apart") assert.ok(gap > distance - 1e-9, `${key(one, other)} apart at ${gap}`);
          if (verdict === "within") assert.ok(gap <= distance + 1e-3 + 1e-9, `${key(one, other)} within at ${gap}`);
          ++all;
          certain += verdict === "undecided" ? 0 : 1;
          withins += verdict === "within" ? 1 : 0;
        }
      }
    }
    assert.ok(withins > 50 && events > 50, `${withins} within, ${events} events`);
    assert.ok(error === 0 ? certain === all : certain > 0.98 * all, `${certain} of ${all}`);
  }
});

test("an exact report gives the times of begin, end and closest approach, and the forecast", () => {
  const distance = 8, until = 30;
  const tracks = straightTracks(30, 50, 6, 3);
  const monitor = monitorOf({ sphere: { distance } });
  monitor.reportAll(batch(tracks, 0));
  for (const [one, other] of pairsOf(tracks)) {
    const { closestTime, closest, speed, enter } = course(one, other, distance);
    const answer = monitor.answer(one.id, other.id);
    near(answer.relativeSpeed, speed);
    near(answer.closestTime, Math.max(0, closestTime));
    if (closestTime > 0) near(answer.closestDistance, closest);
    if (enter > 0) near(answer.likelyTime, enter);
    if (!(enter > 0) && answer.verdict === "apart") assert.equal(answer.likelyTime, Infinity);
    near(Math.hypot(answer.closestHorizontal, answer.closestVertical), answer.closestDistance);
  }
  const begins = new Map(), ends = new Map();
  for (const event of monitor.events(until)) {
    const pair = `${event.first} ${event.second}`;
    if (event.verdict === "within") begins.set(pair, event.time);
    if (event.before === "within") ends.set(pair, event.time);
  }
  let met = 0;
  for (const [one, other] of pairsOf(tracks)) {
    const { enter, leave, speed } = course(one, other, distance);
    const pair = `${one.id} ${other.id}`;
    // The tolerance counts where tracks pass at about the distance.
    if (!(leave - enter > 0.2) || leave <= 0 || enter >= until) continue;
    ++met;
    near(begins.get(pair), Math.max(0, enter), 0.01 + 1 / speed);
    if (leave < until) near(ends.get(pair), leave, 0.01 + 1 / speed);
  }
  assert.ok(met > 10, `${met} pairs`);
});

test("closest approaches that come in the look-ahead time are predicted, and no others", () => {
  const distance = 8, lookAhead = 4, until = 30;
  const tracks = straightTracks(45, 50, 8, 17);
  const monitor = monitorOf({ sphere: { distance, lookAhead } });
  monitor.reportAll(batch(tracks, 0));
  const begun = new Map(), ended = new Map();
  for (const event of monitor.events(until)) {
    const pair = `${event.first} ${event.second}`;
    if (event.kind === "predicted") {
      begun.set(pair, event);
      const answer = monitor.answer(event.first, event.second);
      near(event.closestTime, answer.closestTime);
      near(event.closestDistance, answer.closestDistance);
      assert.ok(event.isOfPair && event.level === 0 && event.verdict === null);
    }
    if (event.kind === "prediction_ended") ended.set(pair, event.time);
  }
  let predicted = 0;
  for (const [one, other] of pairsOf(tracks)) {
    const { closestTime, closest, enter, leave } = course(one, other, distance);
    const pair = `${one.id} ${other.id}`;
    const begin = Math.max(0, Math.min(closestTime - lookAhead, enter));
    if (closest > distance || leave <= 0 || begin >= until) {
      assert.ok(!begun.has(pair), pair);
      continue;
    }
    ++predicted;
    near(begun.get(pair)?.time, begin, 2e-3);
    if (leave < until) near(ended.get(pair), leave, 2e-3);
  }
  assert.ok(predicted > 10, `${predicted} pairs`);

  // Two vessels head-on at 15 knots each, 12 minutes ahead asked; in metres and seconds.
  const knots = 1852 / 3600, sea = new Monitor({
    classes: [{ accelerationLimit: 0.05, largestSpeed: 15 }],
    separations: [{ levels: [{ sphere: { distance: 926, lookAhead: 720 } }] }],
    dimensions: 2,
  });
  const range = 15 * 1852, met = range / (30 * knots);
  let first = null;
  for (let time = 0; time < met - 600; time += 10) {
    for (const [id, side] of [[244660123, 1], [211331640, -1]])
      sea.report(id, { timestamp: time, position: [side * (15 * knots * time - range / 2), 0, 0],
                       velocity: [side * 15 * knots, 0, 0], positionError: 10, velocityError: 0.1 });
    for (const event of sea.events(time + 10)) first ??= event.kind === "predicted" ? event : null;
  }
  near(first.time, met - 720, 10);
  near(first.closestTime, met, 1);
  assert.equal(sea.answer(244660123, 211331640).predicted, true);
  const [pair, ...others] = sea.predictedPairs();
  assert.deepEqual([pair.first, pair.second, pair.level, pair.since, others.length], [211331640, 244660123, 0, first.time, 0]);
});

test("well clear is lost when its formula says so, and that is predicted in the look-ahead time", () => {
  const [horizontal, vertical, modifiedTau, lookAhead] = [1222.32, 137.16, 35, 55];
  const level = { wellClear: { horizontal, vertical, modifiedTau, lookAhead } };
  // The last two pass each other at a distance that does not count, or too high.
  for (const [offset, height, isLost] of [[0, 0, true], [700, 100, true], [1500, 0, false], [0, 200, false]]) {
    const speed = 60, range = 12000;
    const one = { id: 1, from: [0, 0, 1000], velocity: [speed, 0, 0] };
    const other = { id: 2, from: [range, offset, 1000 + height], velocity: [-speed, 0, 0] };
    const monitor = monitorOf(level, { tolerance: 0.01 });
    monitor.reportAll(batch([one, other], 0));
    const lost = (time) => {
      const s = minus(placeOf(other, time), placeOf(one, time)), v = minus(other.velocity, one.velocity);
      const squared = s[0] ** 2 + s[1] ** 2, closing = s[0] * v[0] + s[1] * v[1];
      const passes = closing < 0 && Math.abs(s[0] * v[1] - s[1] * v[0]) <= horizontal * Math.hypot(v[0], v[1]);
      const soon = passes && (horizontal ** 2 - squared) / closing <= modifiedTau;
      return Math.abs(s[2]) <= vertical && (squared <= horizontal ** 2 || soon);
    };
    let time = 0;
    while (time < 200 && !lost(time)) time += 1 / 64;
    const events = [...monitor.events(200)];
    const within = events.find((event) => event.verdict === "within");
    const predicted = events.find((event) => event.kind === "predicted");
    assert.equal(time < 200, isLost);
    assert.equal(within !== undefined, isLost);
    assert.equal(predicted !== undefined, isLost);
    if (!isLost) continue;
    near(within.time, time, 0.02);
    near(predicted.time, time - lookAhead, 0.02);
    near(predicted.likelyTime, time, 0.02);
  }
});

test("what can no longer be avoided is certain before it happens", () => {
  // Head-on at 40 m/s together, with accelerations of 1 m/s^2 each: from sqrt(50) s before they meet all places that
  // they can reach are within 50 m.
  const monitor = new Monitor({ classes: [{ accelerationLimit: 1 }], separations: [{ levels: [{ sphere: { distance: 50 } }] }] });
  monitor.report(1, { timestamp: 0, position: [0, 0, 0], velocity: [20, 0, 0] });
  monitor.report(2, { timestamp: 0, position: [400, 0, 0], velocity: [-20, 0, 0] });
  near(monitor.answer(1, 2).avoidableUntil, 10 - Math.sqrt(50), 0.01);
  assert.equal(monitor.answer(1, 2).inevitableBy, Infinity);
  monitor.run(4);
  monitor.report(1, { timestamp: 4, position: [80, 0, 0], velocity: [20, 0, 0] });
  monitor.report(2, { timestamp: 4, position: [320, 0, 0], velocity: [-20, 0, 0] });
  const { verdict, inevitableBy, avoidableUntil } = monitor.answer(1, 2);
  assert.ok(verdict !== "within" && inevitableBy > 4 && inevitableBy <= 10, `${verdict} ${inevitableBy}`);
  assert.equal(avoidableUntil, 4);
});

/** Drives a monitor through ten seconds with everything that happens to tracks; returns its events. */
function drive(monitor, stretch) {
  const next = random(100 + stretch);
  const events = [];
  const run = (until) => events.push(...monitor.run(until));
  for (let k = 0; k < 80; ++k) {
    const time = 10 * stretch + k / 8;
    run(time);
    const id = Math.floor(25 * next()), timestamp = time - next() / 2, angle = 0.3 * timestamp + id;
    const position = [30 * Math.cos(angle) + (k % 20 === 19 ? 200 : 0), 30 * Math.sin(angle), id % 7];
    const velocity = [-9 * Math.sin(angle), 9 * Math.cos(angle), 0];
    if (k % 30 === 29) monitor.contains(id) && monitor.remove(id);
    else
      monitor.report(id, { timestamp, position, velocity, positionError: { horizontal: 0.5, vertical: 0.2 },
                           velocityError: 0.5, trackClass: k % 12 === 6 ? 1 : 0 });
  }
  run(10 * stretch + 10);
  return events;
}

test("a restored monitor goes on as the one that was saved", () => {
  const definition = {
    classes: [{ accelerationLimit: 4, largestSpeed: 20 }, { accelerationLimit: { horizontal: 5, vertical: 1 }, plannedAcceleration: [0, 0, -1] }],
    separations: [
      { firstClass: 0, secondClass: 0, levels: [{ sphere: { distance: 5, lookAhead: 3 } }, { cylinder: { horizontal: 3, vertical: 1, lookAhead: 0 } }] },
      { firstClass: 0, secondClass: 1, levels: [{ ellipsoid: { horizontal: 4, vertical: 2, lookAhead: 0 } },
                                                { wellClear: { horizontal: 3, vertical: 1, modifiedTau: 2, lookAhead: 1 } }] },
    ],
    dimensions: 3, startTime: -1, tolerance: 0.01, timeResolution: 0.002, window: 0.5, staleAfter: 4, dropAfter: 9,
    predictionHold: 0.5, predictionConfirmation: 0.1, predictionMargin: 0.2, predictionErrorPart: 0.3,
    shard: { of: 5, first: 1, count: 4 },
  };
  const monitor = new Monitor(definition);
  const kinds = new Set();
  drive(monitor, 0);
  for (let stretch = 1; stretch < 3; ++stretch) {
    const restored = Monitor.restore(monitor.save());
    assert.deepEqual(restored.definition.separations, definition.separations);
    const { plannedAcceleration, ...others } = restored.definition.classes[1];
    assert.deepEqual([...plannedAcceleration, others], [0, 0, -1, { accelerationLimit: { horizontal: 5, vertical: 1 }, largestSpeed: Infinity }]);
    for (const [key, value] of Object.entries(definition))
      if (key !== "classes") assert.deepEqual(restored.definition[key], value, key);
    assert.deepEqual(new Monitor(restored.definition).definition, restored.definition);
    const events = drive(monitor, stretch);
    assert.deepEqual(drive(restored, stretch), events);
    for (const { kind } of events) kinds.add(kind);
    assert.deepEqual(restored.openPairs(), monitor.openPairs());
    assert.deepEqual(restored.counters, monitor.counters);
    assert.ok(Buffer.compare(restored.save(), monitor.save()) === 0);
  }
  // Each kind has been there.
  assert.deepEqual([...kinds].sort(), [...monitorEventKinds].sort());
  assert.ok(monitor.counters.reports > 150 && monitor.counters.late > 0 && monitor.counters.contradictions > 0);
});

test("tracks turn stale, come back, change their class and leave; wrong reports are told", () => {
  const monitor = new Monitor({
    classes: [{ accelerationLimit: 1, largestSpeed: 30 }, { accelerationLimit: 0.05, largestSpeed: 1 }],
    separations: [{ levels: [{ sphere: { distance: 50 } }] }], staleAfter: 5, dropAfter: 12,
  });
  const kinds = (until) => [...monitor.events(until)].map(({ kind, first, second }) => [kind, first, second]);
  monitor.report(1, { timestamp: 0, position: [0, 0, 0], velocity: [1, 0, 0] });
  assert.deepEqual(kinds(6), [["stale", 1, null]]);
  assert.equal(monitor.track(1).stale, true);
  monitor.report(1, { timestamp: 6, position: [6, 0, 0], velocity: [1, 0, 0] });
  assert.deepEqual(kinds(7), [["resumed", 1, null]]);
  // A report from elsewhere makes a second hypothesis, until the next one decides.
  monitor.report(1, { timestamp: 7, position: [500, 0, 0], velocity: [1, 0, 0] });
  const [contradiction] = monitor.run(7);
  assert.deepEqual([contradiction.kind, contradiction.first, contradiction.isOfPair], ["contradiction", 1, false]);
  assert.ok(contradiction.positionExcess > 400);
  assert.equal(monitor.track(1).places.length, 2);
  monitor.report(1, { timestamp: 8, position: [8, 0, 0], velocity: [1, 0, 0] });
  assert.deepEqual(kinds(8), [["resolved", 1, null]]);
  const { id, trackClass, timestamp, places: [{ centre, velocity, radius }] } = monitor.track(1);
  assert.deepEqual([id, trackClass, timestamp, ...centre, ...velocity], [1, 0, 8, 8, 0, 0, 1, 0, 0]);
  near(radius.total, 0, 1e-9);
  monitor.report(1, { timestamp: 8.5, position: [8.5, 0, 0], velocity: [0, 0, 0], trackClass: 1 });
  assert.deepEqual(kinds(9), [["reclassified", 1, null]]);
  monitor.report(3, { timestamp: 9, position: [30, 0, 0] });
  const [alarm] = monitor.run(9);
  assert.equal(alarm, undefined, "no rule names classes 0 and 1");
  monitor.report(4, { timestamp: 9, position: [500, 0, 0], velocity: [0, 0, 0] });
  monitor.remove(4);
  assert.deepEqual(kinds(9.5), [["dropped", 4, null]]);
  assert.deepEqual([Array.from(monitor.tracks()), monitor.size, monitor.contains(4), monitor.contains(-1)], [[1, 3], 2, false, false]);
});

test("pairs are listed, with the reports that they need", () => {
  const monitor = new Monitor({
    classes: [{ accelerationLimit: 2 }], separations: [{ levels: [{ sphere: { distance: 20 } }, { sphere: { distance: 10 } }] }],
  });
  for (const [id, x] of [[1, 0], [2, 26], [5, 500]]) monitor.report(id, { timestamp: 0, position: [x, 0, 0], velocity: [0, 0, 0] });
  const [first] = monitor.run(2.5);
  assert.deepEqual([first.first, first.second, first.level, first.verdict, first.partnerOf(1), first.partnerOf(5)], [1, 2, 0, "undecided", 2, null]);
  near(first.time, Math.sqrt(3), 2e-3);
  assert.deepEqual(monitor.openPairs(), [{ first: 1, second: 2, level: 0, verdict: "undecided", since: first.time }]);
  assert.equal(monitor.openPairCount, 1);
  assert.deepEqual(Array.from(monitor.crowd(0)), [1]);
  const { verdict, ask, askBy, lower, upper, until } = monitor.answer(1, 2);
  assert.deepEqual([verdict, askBy], ["undecided", 2.5]);
  near(lower, 26 - 2 * 2.5 ** 2);
  near(upper, 26 + 2 * 2.5 ** 2);
  assert.ok(until >= 2.5 && (ask === 1 || ask === 2));
  assert.deepEqual(monitor.needed(10)[0], { track: ask, by: 2.5, other: 3 - ask });
});

test("reports are requested in time, and a function that throws or answers wrongly loses nothing", () => {
  const level = { sphere: { distance: 10 } };
  const start = () => {
    const monitor = new Monitor({ classes: [{ accelerationLimit: 2 }], separations: [{ levels: [level] }], tolerance: 1 });
    monitor.report(1, { timestamp: 0, position: [0, 0, 0], velocity: [0, 0, 0] });
    monitor.report(2, { timestamp: 0, position: [26, 0, 0], velocity: [-1, 0, 0] });
    return monitor;
  };
  const states = { 1: () => [0, 0, 0], 2: (time) => [26 - time, 0, 0] };
  const asked = [];
  const poll = (tracks, time) => Array.from(tracks, (id) => {
    asked.push(id);
    return { timestamp: time, position: states[id](time), velocity: [id === 2 ? -1 : 0, 0, 0] };
  });
  const monitor = start();
  const events = [...monitor.events(25, poll)];
  assert.deepEqual(events.map(({ verdict }) => verdict), ["within"]);
  assert.ok(events[0].time > 14 && events[0].time < 16.1, `${events[0].time}`);
  assert.equal(monitor.counters.polls, asked.length);

  const other = start();
  const inside = [];
  assert.throws(() => other.advance(25, () => { throw new RangeError("no radio"); }), /no radio/);
  assert.throws(() => other.advance(25, () => []), /advance: poll must return an array of 1 reports, but returned 0/);
  assert.throws(() => other.advance(25, () => undefined), /poll must return an array of 1 reports, but returned undefined/);
  assert.throws(() => other.advance(25, () => [{ timestmp: 1 }]), /poll: report has no key timestmp; the nearest is timestamp/);
  refuses(() => other.advance(25, () => [{ timestamp: 1, position: [NaN, 0, 0] }]), "not_finite", /position/);
  assert.throws(() => other.advance(25, () => other.free()), /cannot be freed/);
  refuses(() => other.advance(25, (ids) => other.report(ids[0], { timestamp: 1, position: [0, 0, 0], velocity: [0, 0, 0] })),
          "probe_in_progress", /poll/);
  for (const { time, verdict } of other.events(25, (tracks, now) => {
    inside.push(other.answer(1, 2).verdict, other.size);
    return poll(tracks, now);
  })) assert.deepEqual([time, verdict], [events[0].time, "within"]);
  assert.ok(inside.includes(2));
  // Without answers the pair turns undecided.
  assert.deepEqual([...start().events(4, (tracks) => Array(tracks.length).fill(null))].map(({ verdict }) => verdict), ["undecided"]);
});

test("batches are equal to single reports, with bounds and plans of each", () => {
  const made = () => new Monitor({ classes: [{ accelerationLimit: 9 }, { accelerationLimit: 5, largestSpeed: 40 }],
                                   separations: [{ secondClass: 1, levels: [{ sphere: { distance: 5 } }] }] });
  const [single, many] = [made(), made()];
  const reports = straightTracks(20, 50, 10, 23).map(({ id, from, velocity }, k) => ({
    id, timestamp: k / 100, position: from, velocity, positionError: { horizontal: 1 + k, vertical: k / 2 }, velocityError: k / 9,
    timestampError: k / 1000, trackClass: k % 2, plan: { acceleration: [0, 0, -k / 9], accelerationLimit: k / 5, validUntil: 1 + k },
  }));
  for (const { id, ...report } of reports) single.report(id, report);
  const column = (get) => reports.map(get);
  many.reportAll({
    ids: column(({ id }) => id), timestamps: column(({ timestamp }) => timestamp),
    positions: column(({ position }) => position).flat(), velocities: column(({ velocity }) => velocity).flat(),
    positionErrors: { horizontal: column((r) => r.positionError.horizontal), vertical: column((r) => r.positionError.vertical) },
    velocityErrors: column((r) => r.velocityError), timestampErrors: column((r) => r.timestampError),
    trackClasses: column((r) => r.trackClass),
    plans: { accelerations: column((r) => r.plan.acceleration).flat(), accelerationLimits: column((r) => r.plan.accelerationLimit),
             validUntil: column((r) => r.plan.validUntil) },
  });
  assert.ok(Buffer.compare(many.save(), single.save()) === 0);
  assert.deepEqual([...many.run(3)], [...single.run(3)]);
  // A wrong report among good ones, which are not accepted either.
  const before = many.save();
  refuses(() => many.reportAll({ ids: [1, 2], timestamps: 3, positions: [0, 0, 0, 1e300, 0, 0], velocities: Array(6).fill(0) }),
          "out_of_range", /report of track 2/);
  assert.ok(Buffer.compare(many.save(), before) === 0);
});

test("wrong use of a monitor is named", () => {
  const classes = [{ accelerationLimit: 2 }];
  const levels = [{ sphere: { distance: 10 } }];
  const monitor = new Monitor({ classes, separations: [{ levels }] });
  const good = { timestamp: 0, position: [0, 0, 0], velocity: [0, 0, 0] };
  monitor.report(1, good);
  monitor.report(2, { ...good, position: [50, 0, 0] });
  refuses(() => new Monitor({ classes: [] }), "out_of_range", /classes must name at least one/);
  refuses(() => new Monitor({ classes: [{}] }), "out_of_range", /must be finite where largest_speed is not/);
  refuses(() => new Monitor({ classes, tolerance: 0 }), "out_of_range", /tolerance must be > 0/);
  refuses(() => new Monitor({ classes, dimensions: 1 }), "out_of_range", /dimensions must be 2 or 3/);
  refuses(() => new Monitor({ classes, predictionMargin: 2 }), "out_of_range", /prediction_margin must be at most 1/);
  refuses(() => new Monitor({ classes, shard: { of: 2, first: 2 } }), "out_of_range", /shard/);
  refuses(() => new Monitor({ classes, separations: [{ secondClass: 1, levels }] }), "out_of_range", /number of classes/);
  refuses(() => new Monitor({ classes, separations: [{ levels: [{ sphere: { distance: -5 } }] }] }), "out_of_range", /horizontal 0, must be > 0/);
  refuses(() => new Monitor({ classes, separations: [{ levels: [{ cylinder: { horizontal: 5 } }] }] }), "not_finite", /vertical 0, must be finite/);
  refuses(() => monitor.report(3, { ...good, timestamp: NaN }), "not_finite", /report of track 3, timestamp, must be finite/);
  refuses(() => monitor.report(3, { ...good, positionError: -1 }), "out_of_range", /position_error/);
  refuses(() => monitor.report(3, { ...good, trackClass: 1 }), "out_of_range", /track_class/);
  refuses(() => monitor.report(3, { timestamp: 0, position: [0, 0, 0] }), "out_of_range", /velocity_error, must be finite where the class has no largest speed/);
  refuses(() => monitor.reportAll({ ids: [3], timestamps: 0, positions: [0, 0, 0] }), "out_of_range", /velocity_error, must be finite/);
  refuses(() => monitor.remove(9), "unknown_body", /there is no track 9/);
  refuses(() => monitor.track(9), "unknown_body", /there is no track 9/);
  refuses(() => monitor.answer(1, 9), "unknown_body", /there is no track 9/);
  refuses(() => monitor.answer(1, 1), "out_of_range", /another track/);
  refuses(() => monitor.answer(1, 2, 1), "out_of_range", /level must be less than 1/);
  refuses(() => monitor.advance(-1), "time_backwards", /until/);
  refuses(() => monitor.run(NaN), "not_finite", /until/);
  refuses(() => Monitor.restore(new Uint8Array(10)), "bad_snapshot", /./);
  const message = (action, text) => assert.throws(action, (error) => error.message.startsWith(text), text);
  message(() => new Monitor(), "Monitor: definition must be an object with the keys classes, separations");
  message(() => monitor.report(3, { ...good, timestamp: undefined }), "report: timestamp must not be undefined: leave it out instead");
  message(() => new Monitor({ classes: classes[0] }), "Monitor: classes must be an array");
  message(() => new Monitor({ classes, dimensions: 2.5 }), "Monitor: dimensions must be a whole number");
  message(() => new Monitor({ classes, separations: [{ levels: [{}] }] }), "Monitor: separations[0].levels[0] must have exactly one of the keys");
  message(() => monitor.report(-1, good), "report: track must be a whole number from 0 to 9007199254740991, but is -1");
  message(() => monitor.report(1.5, good), "report: track must be a whole number");
  message(() => monitor.report(1, { timestamp: 0 }), "report: position must be an array of three numbers, but is undefined");
  message(() => monitor.report(1, { ...good, position: [0, 0] }), "report: position must have three numbers, but has 2");
  message(() => monitor.reportAll({ ids: [1], timestamps: 0, positions: [0, 0, 0, 1, 1, 1] }), "reportAll: ids must have a number for each of 2");
  message(() => monitor.reportAll({ ids: [1, -2], timestamps: 0, positions: [0, 0, 0, 1, 1, 1] }), "reportAll: ids[1] must be a whole number");
  message(() => monitor.reportAll({ ids: [1], timestamps: 0, positions: [0, 0, 0], velocities: [1] }), "reportAll: velocities must have three numbers for each of 1");
  message(() => monitor.advance(1, 5), "advance: poll must be a function");
  message(() => monitor.crowd(-1), "crowd: pairs must be a whole number");
  monitor.free();
  message(() => monitor.size, "kinesphere: the Monitor has been freed");
});

test("misspelled keys of a monitor are named, with the nearest known one", () => {
  const classes = [{ accelerationLimit: 2 }];
  const rule = (level) => () => new Monitor({ classes, separations: [{ levels: [level] }] });
  const monitor = new Monitor({ classes });
  const good = { timestamp: 0, position: [0, 0, 0], velocity: [0, 0, 0] };
  const wrong = [
    [() => new Monitor({ clases: classes }), "Monitor: definition has no key clases; the nearest is classes"],
    [() => new Monitor({ classes, stale_after: 5 }), "Monitor: definition has no key stale_after; the nearest is staleAfter"],
    [() => new Monitor({ classes: [{ acceleration: 2 }] }), "Monitor: classes[0] has no key acceleration; the nearest is"],
    [() => new Monitor({ classes: [{ accelerationLimit: { horizontal: 1, vertcal: 2 } }] }), "Monitor: classes[0].accelerationLimit has no key vertcal; the nearest is vertical"],
    [() => new Monitor({ classes, shard: { off: 2 } }), "Monitor: shard has no key off; the nearest is of"],
    [() => new Monitor({ classes, separations: [{ level: [] }] }), "Monitor: separations[0] has no key level; the nearest is levels"],
    [rule({ spere: { distance: 1 } }), "Monitor: separations[0].levels[0] has no key spere; the nearest is sphere"],
    [rule({ sphere: { distnace: 1 } }), "Monitor: separations[0].levels[0].sphere has no key distnace; the nearest is distance"],
    [rule({ cylinder: { horizontal: 1, vertical: 1, lookahed: 1 } }), "Monitor: separations[0].levels[0].cylinder has no key lookahed; the nearest is lookAhead"],
    [rule({ wellClear: { horizontal: 1, vertical: 1, tau: 1 } }), "Monitor: separations[0].levels[0].wellClear has no key tau; the nearest is"],
    [() => monitor.report(1, { ...good, position_errror: 1 }), "report: report has no key position_errror; the nearest is positionError"],
    [() => monitor.report(1, { ...good, positionError: { horizontl: 1 } }), "report: positionError has no key horizontl; the nearest is horizontal"],
    [() => monitor.report(1, { ...good, plan: { until: 1 } }), "report: plan has no key until; the nearest is validUntil"],
    [() => monitor.reportAll({ ids: [1], timestamp: 0, positions: [0, 0, 0] }), "reportAll: reports has no key timestamp; the nearest is timestamps"],
    [() => monitor.reportAll({ ids: [1], timestamps: 0, positions: [0, 0, 0], plans: { limits: 1 } }), "reportAll: plans has no key limits; the nearest is"],
  ];
  for (const [action, message] of wrong)
    assert.throws(action, (error) => error instanceof TypeError && error.message.startsWith(message), message);
  assert.equal(monitor.size, 0);
});
