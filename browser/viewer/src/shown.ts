// A simulation or a recording on the page, in a form for drawing and numbers.
import type { BodyId, BodyView, Box, BusyBody, Event, Track, WorldView } from "kinesphere";
import type { CarriedShapes, Orientations } from "./carried_shapes.ts";
import type { AlarmDistances } from "./scenes/live_scene.ts";

/** An event, and whether a loop of 60 Hz would miss it. */
export interface ReportedEvent {
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

/** Two bodies that may be within a distance, between surfaces. */
export interface NearPair {
  first: BodyId;
  second: BodyId;
  distance: number;
}

export interface Shown {
  readonly title: string;
  readonly about: string;
  readonly time: number;
  /** How far back() reaches. */
  readonly firstTime: number;
  /** Infinite if there is no end. */
  readonly endTime: number;
  readonly view: WorldView;
  readonly box: Box | null;
  /** By axis: true if space is periodic with the box. */
  readonly periodic: readonly boolean[];
  /** The camera's target if there are no walls. */
  readonly region: Box | null;
  readonly zone: Box | null;
  /** Places in the picture of the fast bodies that leave trails. */
  readonly trails: readonly number[];
  /** The recorded ways of all bodies, by place in the picture; empty if the bodies follow none. */
  readonly ways: readonly Track[];
  /** Unit of lengths, if it is known. */
  readonly unit: string | null;
  /** Distances at which pairs are reported before they touch. */
  readonly alarms: AlarmDistances | null;
  /** Pairs that may be within one of these distances now. */
  readonly near: Iterable<NearPair>;
  readonly tally: Tally;
  /** 16 hexadecimal digits of all events so far. */
  readonly hash: string;
  /** Recent probes of bodies per second of simulated time. */
  readonly probesPerSecond: number;
  /** Number of present bodies. */
  readonly bodyCount: number;
  /**
   * Returns the bodies that cost most probes in the last whole second of simulated time, at most `count`. The first call
   * begins to count.
   */
  busiest(count: number): BusyBody[];
  /** Returns the id of the body at a place in the picture. */
  idOf(place: number): BodyId;
  /** Returns the place of a body in the picture; null if there is no such body. */
  placeOf(id: BodyId): number | null;
  nameOf(id: BodyId): string;
  /** Returns the distance between the centres of two bodies that follow ways; null at times at which one is absent. */
  distanceAt(first: BodyId, second: BodyId, time: number): number | null;
  /** Returns the radii, by place in the picture. */
  radii(): Float64Array;
  /** Returns the shapes that bodies carry; the same object until they change. */
  shapes(): CarriedShapes;
  /** Returns how rigid bodies are turned. */
  orientations(): Orientations;
  /** Returns three numbers for each body, in the box if space is periodic; NaN for absent ones. */
  positions(): Float64Array;
  /** Returns the moving bodies as the world knows them, in the order of positions(). */
  views(): BodyView[];
  /** Advances to `until`, or as far as `deadline`, a time of performance.now(), allows. */
  run(until: number, deadline?: number): ReportedEvent[];
  /** Advances to the next event, and returns all events of its time. */
  nextEvent(): ReportedEvent[];
  /** Goes back, as far as the history reaches. */
  back(seconds: number): void;
  /** Goes back to a kept moment that is not later than `time`, as far as the history reaches. */
  rewind(time: number): void;
  free(): void;
}

/** Whether missed contacts are counted: between balls that report without errors. */
export function countsMissed(shown: Shown): boolean {
  return shown.alarms === null && (shown.shapes().size === 0 || shown.shapes().size < shown.radii().length);
}

/** Returns the shift that brings a coordinate into the box if space is periodic. */
export function shiftInto(box: Box | null, periodic: readonly boolean[], axis: number, coordinate: number): number {
  if (box === null || !periodic[axis]) return 0;
  const lower = box.lower[axis]!;
  const size = box.upper[axis]! - lower;
  return -size * Math.floor((coordinate - lower) / size);
}

/** Returns the image of `to` that is nearest to `from` in periodic space: `to` itself elsewhere. */
export function nearestImage({ box, periodic }: Pick<Shown, "box" | "periodic">, from: ArrayLike<number>, to: ArrayLike<number>): [number, number, number] {
  return [0, 1, 2].map((axis) => {
    if (box === null || !periodic[axis]) return to[axis]!;
    const size = box.upper[axis]! - box.lower[axis]!;
    return to[axis]! - size * Math.round((to[axis]! - from[axis]!) / size);
  }) as [number, number, number];
}

/** Returns the distance of two places, to the nearest image in periodic space. */
export function distanceBetween(shown: Pick<Shown, "box" | "periodic">, from: ArrayLike<number>, to: ArrayLike<number>): number {
  const image = nearestImage(shown, from, to);
  return Math.hypot(image[0] - from[0]!, image[1] - from[1]!, image[2] - from[2]!);
}

/** Moves coordinates into the box on periodic axes. */
export function wrapInto(positions: Float64Array, box: Box | null, periodic: readonly boolean[]): Float64Array {
  for (let axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    for (let at = axis; at < positions.length; at += 3) positions[at]! += shiftInto(box, periodic, axis, positions[at]!);
  }
  return positions;
}

/** Increments of a counter per second of simulated time, over the last second. */
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
