// A scene that runs, can be stepped and gone back in, and lets its bodies be pushed. Needs no page.
import { type BodyId, type BodyView, type Box, type Event, EventHash, type Events, type Motion, type Vec3, type World } from "kinesphere";
import { isMissedByLoop, loopLooksWithin } from "./missed.ts";
import { type SceneChoice, sceneAbout, type Setup, setUp } from "./scenes.ts";
import { emptyTally, RecentRate, type Shown, type Tally, type Told, wrapInto } from "./shown.ts";

/** Simulated time between two snapshots. */
const snapshotInterval = 0.25;
const snapshotsKept = 120;
/** Simulated time in which the next event is looked for. */
const eventHorizon = 60;

/** All that changes as time goes on. */
interface Moment {
  world: World;
  motion: Motion;
  hash: EventHash;
  tally: Tally;
  /** Bodies in the zone, and since when. */
  inZone: Map<BodyId, number>;
}

function copyOf(moment: Moment): Moment {
  return {
    world: moment.world.clone(),
    motion: moment.motion.clone(),
    hash: moment.hash.clone(),
    tally: { ...moment.tally },
    inZone: new Map(moment.inZone),
  };
}

function release(moment: Moment): void {
  moment.world.free();
  moment.motion.free();
}

export class Simulation implements Shown {
  readonly title: string;
  readonly about: string;
  readonly box: Box | null;
  readonly zone: Box | null;
  readonly endTime = Infinity;
  private readonly setup: Setup;
  readonly periodic: readonly boolean[];
  private now: Moment;
  /** In order of time. */
  private snapshots: Moment[] = [];
  private rate = new RecentRate();

  constructor(readonly choice: SceneChoice) {
    const about = sceneAbout(choice.name);
    this.title = about.title;
    this.about = about.about;
    this.setup = setUp(choice);
    const { box, periodic } = this.setup.world.definition;
    this.box = box ?? null;
    this.zone = this.setup.zone?.box ?? null;
    this.periodic = [periodic.x === true, periodic.y === true, periodic.z === true];
    this.now = {
      world: this.setup.world,
      motion: this.setup.motion,
      hash: new EventHash(),
      tally: emptyTally(),
      inZone: new Map(),
    };
    this.keepSnapshot();
  }

  get time(): number { return this.now.world.time; }
  get view(): World { return this.now.world; }
  get tally(): Tally { return this.now.tally; }
  get hash(): string { return this.now.hash.value; }
  get probesPerSecond(): number { return this.rate.value; }
  get bodyCount(): number { return this.setup.radii.length; }

  radii(): Float64Array {
    return this.setup.radii;
  }
  positions(): Float64Array {
    const states = this.now.motion.states(this.time);
    const positions = new Float64Array(states.length / 2);
    for (let k = 0; k < positions.length / 3; ++k) positions.set(states.subarray(6 * k, 6 * k + 3), 3 * k);
    return wrapInto(positions, this.box, this.periodic);
  }
  views(): BodyView[] {
    const views = this.now.world.bodyViews();
    return this.zone === null ? views : views.filter((view) => !view.fixed);
  }

  run(until: number, deadline = Infinity): Told[] {
    const told: Told[] = [];
    const slice = Math.max((until - this.time) / 8, 1e-4);
    while (this.time < until) {
      const nextSnapshot = this.snapshots.at(-1)!.world.time + snapshotInterval;
      const end = Math.min(until, nextSnapshot, deadline === Infinity ? Infinity : this.time + slice);
      this.goTo(end, told);
      if (end >= nextSnapshot) this.keepSnapshot();
      if (performance.now() > deadline) break;
    }
    return told;
  }

  nextEvent(): Told[] {
    const time = this.timeOfNextEvent();
    if (time === null) return [];
    if (time > this.time) return this.run(time);
    const told: Told[] = [];
    this.goTo(time, told);
    return told;
  }

  back(seconds: number): void {
    const target = Math.max(this.time - seconds, this.snapshots[0]!.world.time);
    while (this.snapshots.length > 1 && this.snapshots.at(-1)!.world.time > target) release(this.snapshots.pop()!);
    release(this.now);
    this.now = copyOf(this.snapshots.at(-1)!);
    this.rate.clear();
    this.run(target);
  }

  /** From now on the body has this velocity, until it is pushed or meets something. */
  setVelocity(body: BodyId, velocity: Vec3): void {
    this.now.motion.setVelocity(body, this.time, velocity);
    this.now.world.setVelocity(body, velocity);
  }

  free(): void {
    for (const moment of [this.now, ...this.snapshots]) release(moment);
    this.snapshots = [];
  }

  private goTo(time: number, told: Told[]): void {
    const { world, motion } = this.now;
    world.run(time, { motion, respond: this.setup.respond }, (events: Events) => {
      this.now.hash.add(events);
      for (const event of events) told.push({ event, missed: this.count(event) });
    });
    this.rate.add(world.time, world.counters.probes);
  }

  /** A copy goes ahead until something happens. */
  private timeOfNextEvent(): number | null {
    const world = this.now.world.clone();
    const motion = this.now.motion.clone();
    try {
      for (let ahead = 1e-3; ahead < eventHorizon; ahead *= 2) {
        const events = world.run(this.time + ahead, { motion, respond: this.setup.respond });
        // An event may come at the very time at which the world stands.
        for (const event of events) if (event.time >= this.time) return event.time;
      }
      return null;
    } finally {
      world.free();
      motion.free();
    }
  }

  /** Returns whether a loop would overlook it. */
  private count(event: Event): boolean {
    const { tally, inZone } = this.now;
    switch (event.kind) {
      case "contact_begin": {
        tally.contacts += 1;
        const missed = isMissedByLoop(event, this.setup.radii[event.first]! + this.setup.radii[event.second!]!);
        if (missed) tally.missed += 1;
        return missed;
      }
      case "wall_begin":
        tally.wallContacts += 1;
        return false;
      case "bound_violation":
        tally.violations += 1;
        return false;
      case "sensor_enter":
        inZone.set(event.first, event.time);
        return false;
      case "sensor_leave": {
        const entered = inZone.get(event.first);
        inZone.delete(event.first);
        if (entered === undefined) return false;
        tally.crossings += 1;
        const missed = !loopLooksWithin(entered, event.time);
        if (missed) tally.missedCrossings += 1;
        return missed;
      }
      default:
        return false;
    }
  }

  private keepSnapshot(): void {
    this.snapshots.push(copyOf(this.now));
    if (this.snapshots.length > snapshotsKept) release(this.snapshots.shift()!);
  }
}
