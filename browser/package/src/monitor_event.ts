// Events of a monitor.

import type { Place } from "./memory.js";
import { MonitorEventFields, monitorEventAt as at, type TrackId, type Verdict, verdicts } from "./records.js";

/** An event, in a copy that never changes. */
export class MonitorEvent extends MonitorEventFields {
  /** True for a verdict or a prediction, which are about a pair of tracks; the others are about one. */
  get isOfPair(): boolean { return this.word(at.kind) <= 3; }
  /** The track with the higher id of a pair; else null. */
  get second(): TrackId | null { return this.isOfPair ? this.whole(at.second) : null; }
  /** For a verdict: the new and the previous one; else null. */
  get verdict(): Verdict | null { return this.verdictAt(at.verdict); }
  get before(): Verdict | null { return this.verdictAt(at.before); }

  /** Returns the other track of the pair; null if there is none, or `track` has no part in the event. */
  partnerOf(track: TrackId): TrackId | null {
    return track === this.first ? this.second : track === this.second ? this.first : null;
  }

  private verdictAt(place: number): Verdict | null {
    return this.kind === "verdict" ? verdicts[this.word(place)]! : null;
  }
}

/** Many events, in order. */
export class MonitorEvents implements Iterable<MonitorEvent> {
  /** @internal */
  constructor(private readonly records: readonly Place[]) {}
  get length(): number { return this.records.length; }
  /** Returns the event at a place, from 0, or undefined beyond the last. */
  at(place: number): MonitorEvent | undefined {
    const record = this.records.at(place);
    return record && new MonitorEvent(record.numbers, record.words);
  }
  /** Goes through all events in order. */
  *[Symbol.iterator](): Iterator<MonitorEvent> {
    for (let k = 0; k < this.length; ++k) yield this.at(k)!;
  }
}
