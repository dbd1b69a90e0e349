// A running scene with single steps and a way back, in which bodies can be pushed. Needs no page.
import {
  type BodyId, type BodyView, type Box, type BusyBody, type Event, EventHash, type Track, type Vec3, type World,
} from "kinesphere";
import { type CarriedShapes, carriedShapes, type Orientations, orientationsAt } from "./carried_shapes.ts";
import { isMissedByLoop, loopLooksWithin } from "./missed.ts";
import type { AlarmDistances, LiveScene, Setup } from "./scenes/live_scene.ts";
import { distanceBetween, emptyTally, type NearPair, RecentRate, type Shown, type Tally, type ReportedEvent, wrapInto } from "./shown.ts";

/** Simulated time between the latest snapshots; the longer ago, the fewer are kept, the first always. */
const snapshotInterval = 0.25;
const snapshotsKept = 120;
/** Simulated time for which the probes of bodies are counted. */
const profilePeriod = 1;
/** Simulated time in which the next event is searched for. */
const eventHorizon = 60;

/** The state that changes with time. */
interface Moment {
  scene: LiveScene;
  hash: EventHash;
  tally: Tally;
  /** Bodies in the zone, and the times at which they entered. */
  inZone: Map<BodyId, number>;
  /** Pairs within a distance of warning or alarm, by both bodies and the distance. */
  near: Map<string, NearPair>;
}

function copyOf(moment: Moment): Moment {
  return {
    scene: moment.scene.clone(),
    hash: moment.hash.clone(),
    tally: { ...moment.tally },
    inZone: new Map(moment.inZone),
    near: new Map(moment.near),
  };
}

export class Simulation implements Shown {
  readonly title: string;
  readonly about: string;
  readonly box: Box | null;
  readonly region: Box | null;
  readonly zone: Box | null;
  readonly trails: readonly number[];
  readonly ways: readonly Track[];
  readonly unit: string | null;
  readonly alarms: AlarmDistances | null;
  readonly endTime: number;
  readonly periodic: readonly boolean[];
  private readonly carried: CarriedShapes;
  private now: Moment;
  /** Snapshots in order of time. */
  private snapshots: Moment[] = [];
  private rate = new RecentRate();
  private pushed = false;
  /** The world whose probes are counted, since when, and what was counted in the period before. */
  private profile: { world: World; since: number; before: BusyBody[] } | null = null;

  /** Takes the scene over. `words` are its title and what is to be seen, if the setup itself does not say it. */
  constructor(private readonly setup: Setup, words: { title: string; about: string }) {
    this.title = this.setup.title ?? words.title;
    this.about = this.setup.about ?? words.about;
    const { scene, zone, trails, ways, unit, alarms, region, endTime } = this.setup;
    const { box, periodic } = scene.world.definition;
    this.box = box ?? null;
    this.region = region ?? null;
    this.zone = zone?.box ?? null;
    this.trails = trails ?? [];
    this.ways = ways ?? [];
    this.unit = unit ?? null;
    this.alarms = alarms ?? null;
    this.endTime = endTime ?? Infinity;
    this.periodic = [periodic.x === true, periodic.y === true, periodic.z === true];
    this.now = { scene, hash: new EventHash(), tally: emptyTally(), inZone: new Map(), near: new Map() };
    this.carried = carriedShapes(scene.world, this.views());
    this.keepSnapshot();
  }

  get scene(): LiveScene { return this.now.scene; }
  get time(): number { return this.now.scene.world.time; }
  get firstTime(): number { return this.snapshots[0]!.scene.world.time; }
  /** True if a body was pushed: then the scene is no longer what its seed alone makes. */
  get wasPushed(): boolean { return this.pushed; }
  get view(): World { return this.now.scene.world; }
  get tally(): Tally { return this.now.tally; }
  get hash(): string { return this.now.hash.value; }
  get probesPerSecond(): number { return this.rate.value; }
  get bodyCount(): number { return this.now.scene.presentCount ?? this.setup.radii.length; }
  get near(): Iterable<NearPair> { return this.now.near.values(); }
  /** True if bodies can be pushed. */
  get canBePushed(): boolean { return this.now.scene.setVelocity !== undefined; }

  busiest(count: number): BusyBody[] {
    const world = this.view;
    // Going back replaces the world by a copy, which is not profiled.
    if (this.profile?.world !== world) {
      world.setProfiling(true);
      this.profile = { world, since: this.time, before: [] };
    } else if (this.time >= this.profile.since + profilePeriod) {
      this.profile = { world, since: this.time, before: world.busiest(count) };
      world.setProfiling(false);
      world.setProfiling(true);
    }
    return this.profile.before.length > 0 ? this.profile.before : world.busiest(count);
  }
  idOf(place: number): BodyId {
    return place;
  }
  placeOf(id: BodyId): number | null {
    return id < this.setup.radii.length ? id : null;
  }
  nameOf(id: BodyId): string {
    return this.setup.names?.[id] ?? `${id}`;
  }
  distanceAt(first: BodyId, second: BodyId, time: number): number | null {
    const { scene } = this.now;
    const [one, other] = [first, second].map((body) => scene.positionAt?.(body, time) ?? null);
    return one === null || other === null ? null : distanceBetween(this, one!, other!);
  }
  radii(): Float64Array {
    return this.setup.radii;
  }
  shapes(): CarriedShapes {
    return this.carried;
  }
  orientations(): Orientations {
    return this.carried.size === 0 ? new Map() : orientationsAt(this.time, this.view, this.views());
  }
  positions(): Float64Array {
    const states = this.now.scene.states();
    const positions = new Float64Array(states.length / 2);
    for (let k = 0; k < positions.length / 3; ++k) positions.set(states.subarray(6 * k, 6 * k + 3), 3 * k);
    return wrapInto(positions, this.box, this.periodic);
  }
  views(): BodyView[] {
    const views = this.view.bodyViews();
    return this.zone === null ? views : views.filter((view) => !view.isStatic);
  }

  run(until: number, deadline = Infinity): ReportedEvent[] {
    const reported: ReportedEvent[] = [];
    const last = Math.min(until, this.endTime);
    const slice = Math.max((last - this.time) / 8, 1e-4);
    while (this.time < last) {
      const nextSnapshot = this.snapshots.at(-1)!.scene.world.time + snapshotInterval;
      const end = Math.min(last, nextSnapshot, deadline === Infinity ? Infinity : this.time + slice);
      this.goTo(end, reported);
      if (end >= nextSnapshot) this.keepSnapshot();
      if (performance.now() > deadline) break;
    }
    return reported;
  }

  nextEvent(): ReportedEvent[] {
    const time = this.timeOfNextEvent();
    if (time === null) return [];
    if (time > this.time) return this.run(time);
    const reported: ReportedEvent[] = [];
    this.goTo(time, reported);
    return reported;
  }

  back(seconds: number): void {
    const target = Math.max(this.time - seconds, this.firstTime);
    this.rewind(target);
    this.run(target);
  }

  rewind(time: number): void {
    while (this.snapshots.length > 1 && this.snapshots.at(-1)!.scene.world.time > time) this.snapshots.pop()!.scene.free();
    this.now.scene.free();
    this.now = copyOf(this.snapshots.at(-1)!);
    this.rate.clear();
  }

  /** Sets the velocity until the body is pushed or hits something. */
  setVelocity(body: BodyId, velocity: Vec3): void {
    this.pushed = true;
    this.now.scene.setVelocity?.(body, velocity);
  }

  free(): void {
    for (const moment of [this.now, ...this.snapshots]) moment.scene.free();
    this.snapshots = [];
  }

  private goTo(time: number, reported: ReportedEvent[]): void {
    this.now.scene.run(time, (event) => {
      this.now.hash.add(event);
      reported.push({ event, missed: this.count(event) });
    });
    this.rate.add(this.time, this.view.counters.probes);
  }

  /** Advances a copy to the next event; returns its time. */
  private timeOfNextEvent(): number | null {
    const ahead = this.now.scene.clone();
    try {
      let found: number | null = null;
      for (let by = 1e-3; found === null && by < eventHorizon; by *= 2) {
        ahead.run(Math.min(this.time + by, this.endTime), (event) => {
          // An event may come at the present time of the world.
          if (event.time >= this.time) found ??= event.time;
        });
      }
      return found;
    } finally {
      ahead.free();
    }
  }

  /** Counts the event; returns true if a loop would miss it. */
  private count(event: Event): boolean {
    const { tally, inZone, near } = this.now;
    switch (event.kind) {
      case "contact_begin": {
        tally.contacts += 1;
        // If bodies report with errors, true contacts are unknown.
        if (this.alarms !== null) return false;
        const missed = !this.isOfShape(event) && isMissedByLoop(event, this.setup.radii[event.first]! + this.setup.radii[event.second!]!);
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
        if (this.alarms !== null) {
          tally[event.distance === this.alarms.alarm ? "alarms" : "warnings"] += 1;
          near.set(keyOf(event), { first: event.first, second: event.second!, distance: event.distance });
          return false;
        }
        inZone.set(event.first, event.time);
        return false;
      case "sensor_leave": {
        if (this.alarms !== null) {
          near.delete(keyOf(event));
          return false;
        }
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

  /** True if the event is of a body that carries a shape. What a loop misses is counted for balls alone. */
  private isOfShape({ first, second }: Event): boolean {
    return this.carried.has(first) || (second !== null && this.carried.has(second));
  }

  private keepSnapshot(): void {
    this.snapshots.push(copyOf(this.now));
    if (this.snapshots.length <= snapshotsKept) return;
    // The one that leaves the smallest gap for its age goes, so that the way back from any time is a fixed part of its age.
    const times = this.snapshots.map(({ scene }) => scene.world.time);
    const gapFor = (k: number) => (times[k + 1]! - times[k - 1]!) / (this.time - times[k - 1]!);
    let least = 1;
    for (let k = 2; k < times.length - 1; ++k) if (gapFor(k) < gapFor(least)) least = k;
    this.snapshots.splice(least, 1)[0]!.scene.free();
  }
}

function keyOf({ first, second, distance }: Event): string {
  return `${first} ${second} ${distance}`;
}
