// What the page can show: a simulation or a recording, as the drawing and the numbers see it.
import type { BodyView, Box, Event, WorldView } from "kinesphere";

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
}

export const emptyTally = (): Tally =>
  ({ contacts: 0, missed: 0, wallContacts: 0, violations: 0, crossings: 0, missedCrossings: 0 });

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
  readonly zone: Box | null;
  readonly tally: Tally;
  /** 16 hexadecimal digits of all events so far. */
  readonly hash: string;
  /** Asked of bodies per second of simulated time, lately. */
  readonly probesPerSecond: number;
  readonly bodyCount: number;
  /** By place in the picture. */
  radii(): Float64Array;
  /** Three numbers for each body, in the box where space repeats. */
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

/** Moves coordinates into the box on axes where space repeats. */
export function wrapInto(positions: Float64Array, box: Box | null, periodic: readonly boolean[]): Float64Array {
  if (box === null) return positions;
  for (let axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    const lower = box.lower[axis]!;
    const size = box.upper[axis]! - lower;
    for (let at = axis; at < positions.length; at += 3)
      positions[at] = positions[at]! - size * Math.floor((positions[at]! - lower) / size);
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
