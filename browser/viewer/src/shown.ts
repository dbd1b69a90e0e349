// What the page can show: a simulation or a recording, as the drawing and the numbers see it.
import type { BodyId, BodyView, Box, Event, WorldView } from "kinesphere";
import type { AlarmDistances } from "./scenes/live_scene.ts";

/** An event, and whether a loop of 60 Hz would overlook it. */
export interface Told {
  event: Event;
  missed: boolean;
}

/** Counts from the start up to now. */
export interface Tally {
  contacts: number;
  missed: number;
  wallContacts: number;
  violations: number;
  crossings: number;
  missedCrossings: number;
  warnings: number;
  alarms: number;
}

export const emptyTally = (): Tally => ({
  contacts: 0, missed: 0, wallContacts: 0, violations: 0, crossings: 0, missedCrossings: 0, warnings: 0, alarms: 0,
});

/** Two that may be within a distance, from surface to surface. */
export interface NearPair {
  first: BodyId;
  second: BodyId;
  distance: number;
}

export interface Shown {
  readonly title: string;
  readonly about: string;
  readonly time: number;
  /** Infinite where there is no end. */
  readonly endTime: number;
  readonly view: WorldView;
  readonly box: Box | null;
  /** By axis: whether space repeats with the box. */
  readonly periodic: readonly boolean[];
  /** What the camera looks at where there are no walls. */
  readonly region: Box | null;
  readonly zone: Box | null;
  /** Distances at which pairs are told before they touch. */
  readonly alarms: AlarmDistances | null;
  /** Pairs that may be within one of them now. */
  readonly near: Iterable<NearPair>;
  readonly tally: Tally;
  /** 16 hexadecimal digits of all events so far. */
  readonly hash: string;
  /** Asked of bodies per second of simulated time, lately. */
  readonly probesPerSecond: number;
  /** Of those that are there now. */
  readonly bodyCount: number;
  /** By place in the picture. */
  radii(): Float64Array;
  /** Three numbers for each body, in the box where space repeats; NaN for who is not there. */
  positions(): Float64Array;
  /** The moving bodies as the world knows them, in the same order. */
  views(): BodyView[];
  /** Goes on to `until`, or as far as `deadline` allows, a moment of performance.now(). */
  run(until: number, deadline?: number): Told[];
  /** Goes on to the next event, and returns all that happen at its time. */
  nextEvent(): Told[];
  /** Goes back, as far as is known. */
  back(seconds: number): void;
  free(): void;
}

/** What has to be added to a coordinate to bring it into the box where space repeats. */
export function shiftInto(box: Box | null, periodic: readonly boolean[], axis: number, coordinate: number): number {
  if (box === null || !periodic[axis]) return 0;
  const lower = box.lower[axis]!;
  const size = box.upper[axis]! - lower;
  return -size * Math.floor((coordinate - lower) / size);
}

/** Moves coordinates into the box on axes where space repeats. */
export function wrapInto(positions: Float64Array, box: Box | null, periodic: readonly boolean[]): Float64Array {
  for (let axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    for (let at = axis; at < positions.length; at += 3) positions[at]! += shiftInto(box, periodic, axis, positions[at]!);
  }
  return positions;
}

/** How often something that counts up has counted, per second of simulated time, over the last second. */
export class RecentRate {
  private samples: { time: number; count: number }[] = [];
  add(time: number, count: number): void {
    this.samples.push({ time, count });
    while (this.samples.length > 2 && this.samples[1]!.time <= time - 1) this.samples.shift();
  }
  clear(): void {
    this.samples = [];
  }
  get value(): number {
    const first = this.samples[0];
    const last = this.samples.at(-1);
    if (first === undefined || last === undefined || last.time <= first.time) return 0;
    return (last.count - first.count) / (last.time - first.time);
  }
}
