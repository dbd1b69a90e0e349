// Reports of tracks, and their tables of numbers for the module.
import type { TrackId } from "./monitor_event.js";
import { checkKeys, type Keys, numberOf, requireNumbers, shown, whole } from "./options.js";
import { countOf, each, type PerBody, type Vec3, vector } from "./state.js";

/**
 * An upper limit of an error: a number is a ball of that radius; otherwise the limits in the horizontal plane (x, y) and
 * along the vertical (z), which hold at the same time.
 */
export type ErrorBound = number | { horizontal: number; vertical: number };
/** Upper limits of the errors of many reports. */
export type ErrorBounds = PerBody | { horizontal: PerBody; vertical: PerBody };

/**
 * A reported state of a track. The errors are bounds. If a source gives an accuracy that holds only with some
 * probability, the caller declares which multiple of it contains all errors.
 */
export interface TrackReport {
  /** Time of the state on the monitor's clock. Reports may be late, out of order and repeated. */
  timestamp: number;
  position: Vec3;
  /** Without it the velocity is unknown, and the class must have a largest speed. */
  velocity?: Vec3;
  /** Largest distance of the true position from the reported one (length); by default 0. */
  positionError?: ErrorBound;
  /** Largest difference of the true velocity from the reported one (length / time); by default 0 beside a velocity. */
  velocityError?: ErrorBound;
  /** Largest difference of the timestamp from the true time; by default 0. */
  timestampError?: number;
  /**
   * Index into the classes of the definition; by default 0. A report with another class than those before starts the
   * track anew.
   */
  trackClass?: number;
  plan?: Plan;
}

/**
 * A plan in force from the report's timestamp until `validUntil`, whatever reports follow. Its acceleration and limit
 * replace those of the class, whose largest speed holds all the time.
 */
export interface Plan {
  acceleration?: Vec3;
  accelerationLimit?: ErrorBound;
  /** By default Infinity. */
  validUntil?: number;
}

/** Many reports, in the order in which they arrive. */
export interface ReportBatch {
  /** The track of each report; it may have several. */
  ids: ArrayLike<TrackId>;
  timestamps: PerBody;
  /** Three numbers for each report. */
  positions: ArrayLike<number>;
  /** Three numbers for each; without them all velocities are unknown. */
  velocities?: ArrayLike<number>;
  positionErrors?: ErrorBounds;
  velocityErrors?: ErrorBounds;
  timestampErrors?: PerBody;
  trackClasses?: PerBody;
  /** The plans of all reports, if they have plans. */
  plans?: PlanBatch;
}

/** Plans of the reports of a batch. */
export interface PlanBatch {
  /** Three numbers for each report; by default 0. */
  accelerations?: ArrayLike<number>;
  accelerationLimits?: ErrorBounds;
  validUntil?: PerBody;
}

const reportKeys: Keys<TrackReport> = {
  timestamp: "number", position: true, velocity: true, positionError: true, velocityError: true, timestampError: "number",
  trackClass: "number", plan: true,
};
const planKeys: Keys<Plan> = { acceleration: true, accelerationLimit: true, validUntil: "number" };
const reportBatchKeys: Keys<ReportBatch> = {
  ids: true, timestamps: true, positions: true, velocities: true, positionErrors: true, velocityErrors: true,
  timestampErrors: true, trackClasses: true, plans: true,
};
const planBatchKeys: Keys<PlanBatch> = { accelerations: true, accelerationLimits: true, validUntil: true };
const boundKeys: Keys<{ horizontal: PerBody; vertical: PerBody }> = { horizontal: true, vertical: true };

/** Size of the table that report_at() in browser/module/monitor.cpp reads. */
export const reportNumbers = 24;

export function trackId(id: TrackId, what: string, call: string): number {
  return whole(id, Number.MAX_SAFE_INTEGER, what, call);
}

/** Returns three numbers: 0 and a radius, or 1, the horizontal and the vertical limit. */
export function boundNumbers(bound: ErrorBound, what: string, call: string): [number, number, number] {
  if (typeof bound === "number") return [0, bound, bound];
  if (typeof bound !== "object") throw new TypeError(`${call}: ${what} must be a number or an object, but is ${shown(bound)}`);
  checkKeys(bound, boundKeys, what, call);
  return [1, numberOf(bound.horizontal, `${what}.horizontal`, call), numberOf(bound.vertical, `${what}.vertical`, call)];
}

export function putReport(numbers: Float64Array, at: number, report: TrackReport, call: string): void {
  checkKeys(report, reportKeys, "report", call);
  const { velocity, plan } = report;
  numbers[at + 1] = report.timestamp;
  numbers.set(vector(report.position, "position", call), at + 2);
  numbers.set(vector(velocity ?? [0, 0, 0], "velocity", call), at + 5);
  numbers.set(boundNumbers(report.positionError ?? 0, "positionError", call), at + 8);
  numbers.set(boundNumbers(report.velocityError ?? (velocity ? 0 : Infinity), "velocityError", call), at + 11);
  numbers[at + 14] = report.timestampError ?? 0;
  numbers[at + 15] = whole(report.trackClass ?? 0, 2 ** 32 - 1, "trackClass", call);
  if (plan === undefined) return;
  checkKeys(plan, planKeys, "plan", call);
  numbers[at + 16] = 1;
  numbers.set(vector(plan.acceleration ?? [0, 0, 0], "plan.acceleration", call), at + 17);
  numbers.set(boundNumbers(plan.accelerationLimit ?? 0, "plan.accelerationLimit", call), at + 20);
  numbers[at + 23] = plan.validUntil ?? Infinity;
}

/** Returns the tables of all reports of a batch. */
export function batchNumbers(batch: ReportBatch, call: string): Float64Array {
  checkKeys(batch, reportBatchKeys, "reports", call);
  const count = countOf(batch.positions, call);
  const numbers = new Float64Array(count * reportNumbers);
  const column = (values: PerBody, place: number, what: string) => {
    const all = each(values, count, what, call);
    for (let k = 0; k < count; ++k) numbers[k * reportNumbers + place] = all[k]!;
  };
  const vectors = (values: ArrayLike<number>, place: number, what: string) => {
    if (values.length !== 3 * count)
      throw new RangeError(
        `${call}: ${what} must have three numbers for each of ${count} reports, but has ${values.length}`);
    requireNumbers(values, what, call);
    for (let k = 0; k < count; ++k)
      for (let axis = 0; axis < 3; ++axis) numbers[k * reportNumbers + place + axis] = values[3 * k + axis]!;
  };
  const bounds = (values: ErrorBounds, place: number, what: string) => {
    if (typeof values === "number" || "length" in values) return column(values, place + 1, what);
    checkKeys(values, boundKeys, what, call);
    column(1, place, what);
    column(values.horizontal, place + 1, `${what}.horizontal`);
    column(values.vertical, place + 2, `${what}.vertical`);
  };
  const ids = each(batch.ids, count, "ids", call);
  const classes = each(batch.trackClasses ?? 0, count, "trackClasses", call);
  for (let k = 0; k < count; ++k) {
    numbers[k * reportNumbers] = trackId(ids[k]!, `ids[${k}]`, call);
    numbers[k * reportNumbers + 15] = whole(classes[k]!, 2 ** 32 - 1, `trackClasses[${k}]`, call);
  }
  column(batch.timestamps, 1, "timestamps");
  vectors(batch.positions, 2, "positions");
  if (batch.velocities !== undefined) vectors(batch.velocities, 5, "velocities");
  bounds(batch.positionErrors ?? 0, 8, "positionErrors");
  bounds(batch.velocityErrors ?? (batch.velocities ? 0 : Infinity), 11, "velocityErrors");
  column(batch.timestampErrors ?? 0, 14, "timestampErrors");
  if (batch.plans === undefined) return numbers;
  checkKeys(batch.plans, planBatchKeys, "plans", call);
  column(1, 16, "plans");
  if (batch.plans.accelerations !== undefined) vectors(batch.plans.accelerations, 17, "plans.accelerations");
  bounds(batch.plans.accelerationLimits ?? 0, 20, "plans.accelerationLimits");
  column(batch.plans.validUntil ?? Infinity, 23, "plans.validUntil");
  return numbers;
}
