// Events of a monitor.

import { MonitorEventFields, monitorEventAt as at, monitorEventSize, type TrackId, type Verdict, verdicts } from "./records.js";

/** An event. It reads from numbers that never change. */
export class MonitorEvent extends MonitorEventFields {
  /** True for a verdict or a prediction, which are about a pair of tracks; the others are about one. */
  get isOfPair(): boolean { return this.numbers[at.kind]! <= 2; }
  /** The track with the higher id of a pair; else null. */
  get second(): TrackId | null { return this.isOfPair ? this.numbers[at.second]! : null; }
  /** For a verdict: the new and the previous one; else null. */
  get verdict(): Verdict | null { return this.verdictAt(at.verdict); }
  get before(): Verdict | null { return this.verdictAt(at.before); }

  /** Returns the other track of the pair; null if there is none, or `track` has no part in the event. */
  partnerOf(track: TrackId): TrackId | null {
    return track === this.first ? this.second : track === this.second ? this.first : null;
  }

  private verdictAt(place: number): Verdict | null {
    return this.kind === "verdict" ? verdicts[this.numbers[place]!]! : null;
  }
}

/** Many events, in order. */
export class MonitorEvents implements Iterable<MonitorEvent> {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}
  get length(): number { return this.numbers.length / monitorEventSize; }
  /** Returns the event at a place, from 0, or undefined beyond the last. */
  at(place: number): MonitorEvent | undefined {
    const from = place < 0 ? place + this.length : place;
    if (!(from >= 0 && from < this.length)) return undefined;
    return new MonitorEvent(this.numbers.subarray(from * monitorEventSize, (from + 1) * monitorEventSize));
  }
  /** Goes through all events in order. */
  *[Symbol.iterator](): Iterator<MonitorEvent> {
    for (let k = 0; k < this.length; ++k) yield this.at(k)!;
  }
}
