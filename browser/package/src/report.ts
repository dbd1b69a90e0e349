// Reports of tracks, and their tables of numbers for the module.
import { boundKeys, boundNumbers, type ErrorBound, type ErrorBounds } from "./error_bound.js";
import { checkKeys, type Keys, requireNumbers, whole } from "./options.js";
import {
  putReportFields, reportAt, type ReportFields, reportFieldKeys, reportSize, type TrackId,
} from "./records.js";
import { countOf, each, type PerBody, type Vec3, vector } from "./state.js";

/**
 * A reported state of a track. The errors are bounds. If a source gives an accuracy that holds only with some
 * probability, the caller declares which multiple of it contains all errors.
 */
export interface TrackReport extends ReportFields {
  position: Vec3;
  /** Without it the velocity is unknown, and the class must have a largest speed. */
  velocity?: Vec3;
  /** Largest difference of the true velocity from the reported one (length / time); by default 0 beside a velocity. */
  velocityError?: ErrorBound;
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

const reportKeys: Keys<TrackReport> = { ...reportFieldKeys, position: true, velocity: true, velocityError: true, plan: true };
const planKeys: Keys<Plan> = { acceleration: true, accelerationLimit: true, validUntil: "number" };
const reportBatchKeys: Keys<ReportBatch> = {
  ids: true, timestamps: true, positions: true, velocities: true, positionErrors: true, velocityErrors: true,
  timestampErrors: true, trackClasses: true, plans: true,
};
const planBatchKeys: Keys<PlanBatch> = { accelerations: true, accelerationLimits: true, validUntil: true };

// The table that report_at() in browser/module/monitor.cpp reads: an id, the fields, and a plan.
const fields = 1;
const plan = fields + reportSize;
/** Size of that table. */
export const reportNumbers = plan + 8;

export function trackId(id: TrackId, what: string, call: string): number {
  return whole(id, Number.MAX_SAFE_INTEGER, what, call);
}

export function putReport(numbers: Float64Array, at: number, report: TrackReport, call: string): void {
  checkKeys(report, reportKeys, "report", call);
  const { velocity } = report;
  const from = at + fields;
  putReportFields(numbers, from, report, call);
  numbers.set(vector(report.position, "position", call), from + reportAt.state);
  numbers.set(vector(velocity ?? [0, 0, 0], "velocity", call), from + reportAt.state + 3);
  numbers.set(boundNumbers(report.velocityError ?? (velocity ? 0 : Infinity), "velocityError", call), from + reportAt.velocityError);
  if (report.plan === undefined) return;
  checkKeys(report.plan, planKeys, "plan", call);
  numbers[at + plan] = 1;
  numbers.set(vector(report.plan.acceleration ?? [0, 0, 0], "plan.acceleration", call), at + plan + 1);
  numbers.set(boundNumbers(report.plan.accelerationLimit ?? 0, "plan.accelerationLimit", call), at + plan + 4);
  numbers[at + plan + 7] = report.plan.validUntil ?? Infinity;
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
    numbers[k * reportNumbers + fields + reportAt.trackClass] = whole(classes[k]!, 2 ** 32 - 1, `trackClasses[${k}]`, call);
  }
  column(batch.timestamps, fields + reportAt.timestamp, "timestamps");
  vectors(batch.positions, fields + reportAt.state, "positions");
  if (batch.velocities !== undefined) vectors(batch.velocities, fields + reportAt.state + 3, "velocities");
  bounds(batch.positionErrors ?? 0, fields + reportAt.positionError, "positionErrors");
  bounds(batch.velocityErrors ?? (batch.velocities ? 0 : Infinity), fields + reportAt.velocityError, "velocityErrors");
  column(batch.timestampErrors ?? 0, fields + reportAt.timestampError, "timestampErrors");
  if (batch.plans === undefined) return numbers;
  checkKeys(batch.plans, planBatchKeys, "plans", call);
  column(1, plan, "plans");
  if (batch.plans.accelerations !== undefined) vectors(batch.plans.accelerations, plan + 1, "plans.accelerations");
  bounds(batch.plans.accelerationLimits ?? 0, plan + 4, "plans.accelerationLimits");
  column(batch.plans.validUntil ?? Infinity, plan + 7, "plans.validUntil");
  return numbers;
}
