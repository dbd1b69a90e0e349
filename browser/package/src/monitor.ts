// Monitor: certain statements about the separation of tracks that report irregularly, and predictions.
import { type Module, Owned, theModule } from "./module.js";
import {
  type FullMonitorDefinition, type MonitorDefinition, monitorDefinitionOf, monitorNumbers,
} from "./monitor_definition.js";
import { MonitorEvent, MonitorEvents } from "./monitor_event.js";
import { refusePromise, requireBytes, whole } from "./options.js";
import {
  type OpenPair, openPairOf, openPairSize, type PairAnswer, pairAnswerOf, type PredictedPair, predictedPairOf, predictedPairSize,
  type ReportRequest, reportRequestOf, reportRequestSize, type TrackId,
} from "./records.js";
import { batchNumbers, putReport, type ReportBatch, reportNumbers, trackId, type TrackReport } from "./report.js";

/** Counts of the work that a monitor has done since it was created. */
export interface MonitorCounters {
  reports: number;
  late: number;
  repeated: number;
  contradictions: number;
  polls: number;
  searches: number;
  nearPairs: number;
  rechecks: number;
}

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

const existing = Symbol("existing");

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
  /** @internal */
  constructor(definition: typeof existing, address: number);
  constructor(definition: MonitorDefinition | typeof existing, address = 0) {
    super(definition === existing ? address : create(definition as MonitorDefinition), "monitor_free");
  }
  /** Restores a monitor from save(), called here or in any other program; it goes on identically. */
  static restore(snapshot: Uint8Array): Monitor {
    requireBytes(snapshot, "snapshot", "Monitor.restore");
    const module = theModule();
    return new Monitor(existing, module.with((scratch) =>
      module.require(module.call("monitor_restore", scratch.bytes(snapshot), snapshot.length))));
  }

  /**
   * Accepts a report that arrives now. The first report of a track adds it, and one of another class than before starts
   * it anew. The next advance() returns the events that follow.
   */
  report(track: TrackId, report: TrackReport): void {
    const numbers = new Float64Array(reportNumbers);
    numbers[0] = trackId(track, "track", "report");
    putReport(numbers, 0, report, "report");
    this.accept(numbers);
  }
  /** Accepts the reports one after the other or, after an error, none. */
  reportAll(reports: ReportBatch): void {
    this.accept(batchNumbers(reports, "reportAll"));
  }
  /** Removes a track; the next advance() returns its event "dropped". */
  remove(track: TrackId): void {
    const module = theModule();
    module.require(module.call("monitor_remove", this.address, trackId(track, "track", "remove")));
  }

  /**
   * Advances to the next event and returns it, or to `until`, and returns null. Events of one time come in the order of
   * their kind, ids and level. With `poll`, it requests a report of a track whose pair is about to turn undecided.
   */
  advance(until: number, poll?: Poll): MonitorEvent | null {
    const module = theModule();
    if (poll !== undefined && typeof poll !== "function") throw new TypeError("advance: poll must be a function");
    const callbacks = poll === undefined ? {} : polling(module, poll);
    const result =
      module.callWith(callbacks, [this.address], "monitor_advance", this.address, until, poll === undefined ? 0 : 1);
    if (result < 0) throw module.error();
    return result === 0 ? null : new MonitorEvent(module.answer());
  }
  /** Yields the events up to `until`. After an early exit the monitor stands at the last event. */
  *events(until: number, poll?: Poll): Generator<MonitorEvent, void, undefined> {
    for (let event = this.advance(until, poll); event !== null; event = this.advance(until, poll)) yield event;
  }
  /** Advances to `until` and returns all events: the fastest way. */
  run(until: number): MonitorEvents {
    const module = theModule();
    module.require(module.call("monitor_run", this.address, until));
    return new MonitorEvents(module.answer());
  }

  get time(): number {
    return theModule().call("monitor_time", this.address);
  }
  get definition(): FullMonitorDefinition {
    return monitorDefinitionOf(this.answered("monitor_definition"));
  }
  get counters(): MonitorCounters {
    const numbers = this.answered("monitor_counters");
    return {
      reports: numbers[0]!,
      late: numbers[1]!,
      repeated: numbers[2]!,
      contradictions: numbers[3]!,
      polls: numbers[4]!,
      searches: numbers[5]!,
      nearPairs: numbers[6]!,
      rechecks: numbers[7]!,
    };
  }
  /** Returns the ids of all tracks, in ascending order. */
  tracks(): Float64Array {
    return this.answered("monitor_tracks");
  }
  /** Number of tracks. */
  get size(): number {
    return theModule().call("monitor_size", this.address);
  }
  /** True if the monitor knows the track. */
  contains(track: TrackId): boolean {
    return Number.isSafeInteger(track) && track >= 0 && theModule().call("monitor_contains", this.address, track) !== 0;
  }
  /** What is known of a track now. */
  track(track: TrackId): TrackView {
    const module = theModule();
    module.require(module.call("monitor_track", this.address, trackId(track, "track", "track")));
    const numbers = module.answer();
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
    const module = theModule();
    const call = "answer";
    module.require(module.call("monitor_answer", this.address, trackId(first, "first", call),
                               trackId(second, "second", call), whole(level, 2 ** 32 - 1, "level", call)));
    return pairAnswerOf(module.answer());
  }
  /** Returns the pairs that are not certainly apart, in the order of their ids and levels. */
  openPairs(): OpenPair[] {
    return this.rows("monitor_open_pairs", openPairSize, openPairOf);
  }
  /** Returns the pairs that are predicted to come within a separation, in the order of their ids and levels. */
  predictedPairs(): PredictedPair[] {
    return this.rows("monitor_predicted_pairs", predictedPairSize, predictedPairOf);
  }
  /** Number of pairs that are not certainly apart or were not at some time in the current window. */
  get openPairCount(): number {
    return theModule().call("monitor_open_pair_count", this.address);
  }
  /** Returns tracks whose removal reduces openPairCount to at most `pairs`, those with most open pairs first. */
  crowd(pairs: number): Float64Array {
    return this.answered("monitor_crowd", whole(pairs, 2 ** 32 - 1, "pairs", "crowd"));
  }
  /**
   * Returns the reports that are needed by `until` so that no verdict turns undecided before, in the order of their times.
   * Pairs are known only up to the end of the current window.
   */
  needed(until: number): ReportRequest[] {
    return this.rows("monitor_needed", reportRequestSize, reportRequestOf, until);
  }
  /** Returns the whole monitor, for Monitor.restore() in any process, including native ones. */
  save(): Uint8Array {
    const module = theModule();
    module.call("monitor_save", this.address);
    return module.bytes();
  }

  private accept(numbers: Float64Array): void {
    const module = theModule();
    module.with((scratch) => module.require(
      module.call("monitor_report", this.address, numbers.length / reportNumbers, scratch.numbers(numbers))));
  }
  private answered(name: string, ...values: number[]): Float64Array {
    const module = theModule();
    module.call(name, this.address, ...values);
    return module.answer();
  }
  private rows<Row>(name: string, size: number, of: (row: Float64Array) => Row, ...values: number[]): Row[] {
    const numbers = this.answered(name, ...values);
    return Array.from({ length: numbers.length / size }, (_, k) => of(numbers.subarray(size * k, size * (k + 1))));
  }
}

function create(definition: MonitorDefinition): number {
  const module = theModule();
  return module.with((scratch) =>
    module.require(module.call("monitor_create", scratch.numbers(monitorNumbers(definition)))));
}

/** Callbacks of an advance that polls. */
function polling(module: Module, poll: Poll) {
  return {
    poll(count: number, ids: number, time: number, replies: number): void {
      // The function may call the module, so its memory may grow.
      const reports = poll(module.numbersAt(ids, count).slice(), time);
      refusePromise(reports, "poll");
      if (reports?.length !== count)
        throw new RangeError(`advance: poll must return an array of ${count} reports, but returned ` +
                             (reports?.length === undefined ? `${reports}` : `${reports.length}`));
      const numbers = new Float64Array(count * reportNumbers);
      for (let k = 0; k < count; ++k) {
        const report = reports[k];
        if (report === undefined || report === null) continue;
        numbers[k * reportNumbers] = 1;
        putReport(numbers, k * reportNumbers, report, "poll");
      }
      module.numbersAt(replies, numbers.length).set(numbers);
    },
  };
}
