// Monitor: certain statements about the separation of tracks that report irregularly, and predictions.
import { type Argument, type Callback, type Module, Owned, theModule } from "./module.js";
import {
  type FullMonitorDefinition, type MonitorDefinition, monitorDefinitionOf, monitorRecord,
} from "./monitor_definition.js";
import { MonitorEvent, MonitorEvents } from "./monitor_event.js";
import { refusePromise, requireBytes, whole } from "./options.js";
import {
  monitorAt, monitorEventAt, type OpenPair, openPairAt, openPairOf, type PairAnswer, pairAnswerAt, pairAnswerOf,
  type PredictedPair, predictedPairAt, predictedPairOf, reportAt, type ReportRequest, reportRequestAt, reportRequestOf,
  type TrackId,
} from "./records.js";
import { batchRecords, putReport, type ReportBatch, trackId, type TrackReport } from "./report.js";

const counterNames = [
  "reports", "late", "repeated", "contradictions", "polls", "searches", "nearPairs", "rechecks",
] as const;
/** Counts of the work that a monitor has done since it was created. */
export interface MonitorCounters extends Record<(typeof counterNames)[number], number> {}

/** The track certainly lies within `radius` of `centre`. */
export interface TrackPlace {
  centre: Float64Array;
  velocity: Float64Array;
  /** Limits of the distance from the centre in the horizontal plane, along the vertical, and in total. */
  radius: { horizontal: number; vertical: number; total: number };
}

/** What a monitor knows about a track now. There are several places only while reports contradict each other. */
export interface TrackView {
  id: TrackId;
  trackClass: number;
  /** Timestamp of the latest report. */
  timestamp: number;
  stale: boolean;
  places: TrackPlace[];
}

/**
 * Returns the latest reports of these tracks, in their order, with timestamps no later than `time`; null or undefined
 * for one that has no newer report. It may make calls that do not change the monitor. The array is good during the call alone.
 */
export type Poll = (tracks: Float64Array, time: number) => ArrayLike<TrackReport | null | undefined>;

/**
 * Tracks, their reports and the verdicts about their pairs.
 *
 *     const monitor = new Monitor({
 *       classes: [{ accelerationLimit: 3 }],
 *       separations: [{ levels: [{ sphere: { distance: 50, lookAhead: 60 } }] }],
 *     });
 *     monitor.report(7, { timestamp: 12, position: [0, 0, 100], velocity: [20, 0, 0], positionError: 3 });
 *     // ... reports of other tracks, in the order in which they arrive
 *     for (const event of monitor.events(12.5))
 *       if (event.verdict === "undecided") ...  // the pair may be within 50 m from event.time on
 */
export class Monitor extends Owned {
  /** Throws KinesphereError for an invalid definition. */
  constructor(definition: MonitorDefinition);
  /** @internal The object of this handle. */
  constructor(handle: bigint);
  constructor(definition: MonitorDefinition | bigint) {
    super(typeof definition === "bigint" ? definition : create(definition), "ks_monitor_destroy");
  }
  /** Restores a monitor from save(), called here or in any other program; it goes on identically. */
  static restore(snapshot: Uint8Array): Monitor {
    requireBytes(snapshot, "snapshot", "Monitor.restore");
    return new Monitor(theModule().handle("ks_monitor_restore", snapshot, snapshot.length));
  }

  /**
   * Accepts a report that arrives now. The first report of a track adds it, and one of another class than before starts
   * it anew. The next advance() returns the events that follow.
   */
  report(track: TrackId, report: TrackReport): void {
    const module = theModule();
    module.with(() => {
      const tracks = module.room(8), at = module.record(reportAt);
      module.putWhole(tracks, trackId(track, "track", "report"));
      putReport(module, at, report, "report");
      this.check("ks_monitor_report", tracks, at, 1);
    });
  }
  /** Accepts the reports one after the other or, after an error, none. */
  reportAll(reports: ReportBatch): void {
    const module = theModule();
    module.with(() => this.check("ks_monitor_report", ...batchRecords(module, reports, "reportAll")));
  }
  /** Removes a track; the next advance() returns its event "dropped". */
  remove(track: TrackId): void {
    this.check("ks_monitor_remove", BigInt(trackId(track, "track", "remove")));
  }

  /**
   * Advances to the next event and returns it, or to `until`, and returns null. Events of one time come in the order of
   * their kind, ids and level. With `poll`, it requests a report of a track whose pair is about to turn undecided.
   */
  advance(until: number, poll?: Poll): MonitorEvent | null {
    if (poll !== undefined && typeof poll !== "function") throw new TypeError("advance: poll must be a function");
    const asked: Argument[] =
      poll === undefined ? [0, 0] : [theModule().pointer("poll"), (module) => module.hold(polling(module, poll))];
    const { numbers, words } = this.read(monitorEventAt, "ks_monitor_advance", until, ...asked);
    return words[monitorEventAt.kind >> 2] === 0 ? null : new MonitorEvent(numbers, words);
  }
  /** Yields the events up to `until`. After an early exit the monitor stands at the last event. */
  *events(until: number, poll?: Poll): Generator<MonitorEvent, void, undefined> {
    for (let event = this.advance(until, poll); event !== null; event = this.advance(until, poll)) yield event;
  }
  /** Advances to `until` and returns all events: the fastest way. */
  run(until: number): MonitorEvents {
    return new MonitorEvents([...this.events(until)]);
  }

  get time(): number {
    return this.number("ks_monitor_time");
  }
  get definition(): FullMonitorDefinition {
    return monitorDefinitionOf(theModule(), this.read(monitorAt, "monitor_definition"));
  }
  get counters(): MonitorCounters {
    const numbers = this.told("monitor_counters");
    return Object.fromEntries(counterNames.map((name, k) => [name, numbers[k]!])) as unknown as MonitorCounters;
  }
  /** Returns the ids of all tracks, in ascending order. */
  tracks(): Float64Array {
    return Float64Array.from(this.rows(8, (row) => row.whole(0), "ks_monitor_tracks"));
  }
  /** Number of tracks. */
  get size(): number {
    return this.told("monitor_counters")[8]!;
  }
  /** True if the monitor knows the track. */
  contains(track: TrackId): boolean {
    return Number.isSafeInteger(track) && track >= 0 &&
           this.word("monitor_contains", BigInt(track)) !== 0;
  }
  /** What is known of a track now. */
  track(track: TrackId): TrackView {
    const numbers = this.told("monitor_track", BigInt(trackId(track, "track", "track")));
    const places = Array.from({ length: (numbers.length - 3) / 9 }, (_, k): TrackPlace => {
      const place = numbers.subarray(3 + 9 * k, 12 + 9 * k);
      return {
        centre: place.subarray(0, 3),
        velocity: place.subarray(3, 6),
        radius: { horizontal: place[6]!, vertical: place[7]!, total: place[8]! },
      };
    });
    return { id: track, trackClass: numbers[0]!, timestamp: numbers[1]!, stale: numbers[2] === 1, places };
  }

  /** Returns the verdict about two tracks at one level, with its forecast. */
  answer(first: TrackId, second: TrackId, level = 0): PairAnswer {
    const call = "answer";
    return pairAnswerOf(this.read(pairAnswerAt, "ks_monitor_answer", BigInt(trackId(first, "first", call)),
                                  BigInt(trackId(second, "second", call)), whole(level, 2 ** 32 - 1, "level", call)));
  }
  /** Returns the pairs that are not certainly apart, in the order of their ids and levels. */
  openPairs(): OpenPair[] {
    return this.rows(openPairAt.size, openPairOf, "ks_monitor_open_pairs");
  }
  /** Returns the pairs that are predicted to come within a separation, in the order of their ids and levels. */
  predictedPairs(): PredictedPair[] {
    return this.rows(predictedPairAt.size, predictedPairOf, "ks_monitor_predicted_pairs");
  }
  /** Number of pairs that are not certainly apart or were not at some time in the current window. */
  get openPairCount(): number {
    return this.told("monitor_counters")[9]!;
  }
  /** Returns tracks whose removal reduces openPairCount to at most `pairs`, those with most open pairs first. */
  crowd(pairs: number): Float64Array {
    return this.told("monitor_crowd", whole(pairs, 2 ** 32 - 1, "pairs", "crowd"));
  }
  /**
   * Returns the reports that are needed by `until` so that no verdict turns undecided before, in the order of their times.
   * Pairs are known only up to the end of the current window.
   */
  needed(until: number): ReportRequest[] {
    return this.rows(reportRequestAt.size, reportRequestOf, "ks_monitor_needed", until);
  }
  /** Returns the whole monitor, for Monitor.restore() in any process, including native ones. */
  save(): Uint8Array {
    return this.filled("ks_monitor_save");
  }
}

function create(definition: MonitorDefinition): bigint {
  return theModule().handle("ks_monitor_create", (module) => monitorRecord(module, definition));
}

/** Returns the callback of a ks_poll. */
function polling(module: Module, poll: Poll): Callback {
  return (tracks, count, time, records, hasReport) => {
    const ids = Float64Array.from({ length: count! }, (_, k) => module.at(tracks!).whole(8 * k));
    // The function may call the module, so its memory may grow.
    const reports = poll(ids, time!);
    refusePromise(reports, "poll");
    if (reports?.length !== count)
      throw new RangeError(`advance: poll must return an array of ${count} reports, but returned ` +
                           (reports?.length === undefined ? `${reports}` : `${reports.length}`));
    for (let k = 0; k < count!; ++k) {
      const report = reports[k];
      if (report === undefined || report === null) continue;
      const at = records! + reportAt.size * k;
      module.bytes.fill(0, at, at + reportAt.size);
      putReport(module, at, report, "poll");
      module.bytes[hasReport! + k] = 1;
    }
  };
}
