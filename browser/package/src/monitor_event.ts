// Events of a monitor.

/** Identifies a track: a whole number from 0 to 2^53 - 1 of the caller's, such as a transponder address or an MMSI. */
export type TrackId = number;

const verdicts = ["apart", "undecided", "within"] as const;
/** "apart" and "within" are certain; "undecided" if the reports leave it open. */
export type Verdict = (typeof verdicts)[number];
export function verdictOf(number: number): Verdict {
  return verdicts[number]!;
}

const kinds = [
  "verdict", "predicted", "prediction_ended", "contradiction", "resolved", "stale", "resumed", "dropped", "reclassified",
] as const;
/** kinesphere/monitor/monitor_event.hpp documents each kind. */
export type MonitorEventKind = (typeof kinds)[number];
export const monitorEventKinds: readonly MonitorEventKind[] = kinds;

/** Size of an event in numbers; see answer_event_of() in browser/module/monitor.cpp. */
const monitorEventNumbers = 13;

/** An event. It reads from numbers that never change. */
export class MonitorEvent {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}

  get time(): number { return this.numbers[0]!; }
  get kind(): MonitorEventKind { return kinds[this.numbers[1]!]!; }
  /** True for a verdict or a prediction, which are about a pair of tracks; the others are about one. */
  get isOfPair(): boolean { return this.numbers[1]! <= 2; }
  /** The track or, of a pair, the one with the lower id. */
  get first(): TrackId { return this.numbers[2]!; }
  /** The track with the higher id of a pair; else null. */
  get second(): TrackId | null { return this.isOfPair ? this.numbers[3]! : null; }
  /** For a pair: the separation level, an index into the levels of its rule. */
  get level(): number { return this.numbers[4]!; }
  /** For a verdict: the new and the previous one; else null. */
  get verdict(): Verdict | null { return this.numbers[1] === 0 ? verdictOf(this.numbers[5]!) : null; }
  get before(): Verdict | null { return this.numbers[1] === 0 ? verdictOf(this.numbers[6]!) : null; }
  /**
   * Time at which the previous verdict began, -Infinity if the pair was apart at all levels; for a prediction, time at
   * which it began.
   */
  get since(): number { return this.numbers[7]!; }
  /**
   * For a prediction, if both tracks go straight on from now: the time at which they come within the separation; now if
   * they are, Infinity if they never are.
   */
  get likelyTime(): number { return this.numbers[8]!; }
  /** For a prediction: time and distance (length) of the closest approach; for a cylinder the distance in the plane. */
  get closestTime(): number { return this.numbers[9]!; }
  get closestDistance(): number { return this.numbers[10]!; }
  /** For a contradiction: how far the report lies outside of what was possible (length, length / time). */
  get positionExcess(): number { return this.numbers[11]!; }
  get velocityExcess(): number { return this.numbers[12]!; }

  /** Returns the other track of the pair; null if there is none, or `track` has no part in the event. */
  partnerOf(track: TrackId): TrackId | null {
    return track === this.first ? this.second : track === this.second ? this.first : null;
  }
}

/** Many events, in order. */
export class MonitorEvents implements Iterable<MonitorEvent> {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}
  get length(): number { return this.numbers.length / monitorEventNumbers; }
  /** Returns the event at a place, from 0, or undefined beyond the last. */
  at(place: number): MonitorEvent | undefined {
    const from = place < 0 ? place + this.length : place;
    if (!(from >= 0 && from < this.length)) return undefined;
    return new MonitorEvent(this.numbers.subarray(from * monitorEventNumbers, (from + 1) * monitorEventNumbers));
  }
  /** Goes through all events in order. */
  *[Symbol.iterator](): Iterator<MonitorEvent> {
    for (let k = 0; k < this.length; ++k) yield this.at(k)!;
  }
}
