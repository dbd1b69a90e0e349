// Reports of tracks.
import { boundKeys, type ErrorBound, type ErrorBounds, putBound } from "./error_bound.js";
import type { Module } from "./module.js";
import { checkKeys, type Keys, requireNumbers, whole } from "./options.js";
import { putReportFields, reportAt, type ReportFields, reportFieldKeys, type TrackId } from "./records.js";
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

export function trackId(id: TrackId, what: string, call: string): number {
  return whole(id, Number.MAX_SAFE_INTEGER, what, call);
}

/** Writes a ks_track_report over zeros. */
export function putReport(to: Module, at: number, report: TrackReport, call: string): void {
  checkKeys(report, reportKeys, "report", call);
  const { velocity, plan } = report;
  to.putWord(at, reportAt.size);
  putReportFields(to, at, report, call);
  to.putVector(at + reportAt.state, vector(report.position, "position", call));
  if (velocity !== undefined) to.putVector(at + reportAt.state + 24, vector(velocity, "velocity", call));
  putBound(to, at + reportAt.velocityError, report.velocityError ?? (velocity ? 0 : Infinity), "velocityError", call);
  if (plan === undefined) return;
  checkKeys(plan, planKeys, "plan", call);
  to.putWord(at + reportAt.hasPlan, 1);
  to.putVector(at + reportAt.planAcceleration, vector(plan.acceleration ?? [0, 0, 0], "plan.acceleration", call));
  putBound(to, at + reportAt.planLimit, plan.accelerationLimit ?? 0, "plan.accelerationLimit", call);
  to.putNumber(at + reportAt.planValidUntil, plan.validUntil ?? Infinity);
}

/** Returns the addresses of the ids and reports of a batch, and how many there are, for the duration of a call. */
export function batchRecords(module: Module, batch: ReportBatch, call: string): [tracks: number, reports: number, count: number] {
  checkKeys(batch, reportBatchKeys, "reports", call);
  const count = countOf(batch.positions, call);
  const { size } = reportAt;
  const tracks = module.room(8 * count), reports = module.room(size * count);
  module.bytes.fill(0, reports, reports + size * count);
  const column = (values: PerBody, place: number, what: string) => {
    const all = each(values, count, what, call);
    for (let k = 0; k < count; ++k) module.putNumber(reports + size * k + place, all[k]!);
  };
  const vectors = (values: ArrayLike<number>, place: number, what: string) => {
    if (values.length !== 3 * count)
      throw new RangeError(
        `${call}: ${what} must have three numbers for each of ${count} reports, but has ${values.length}`);
    requireNumbers(values, what, call);
    for (let k = 0; k < count; ++k)
      for (let axis = 0; axis < 3; ++axis) module.putNumber(reports + size * k + place + 8 * axis, values[3 * k + axis]!);
  };
  const words = (value: number, place: number) => {
    for (let k = 0; k < count; ++k) module.putWord(reports + size * k + place, value);
  };
  const bounds = (values: ErrorBounds, place: number, what: string) => {
    if (typeof values === "number" || "length" in values) {
      column(values, place + 8, what);
      return column(values, place + 16, what);
    }
    checkKeys(values, boundKeys, what, call);
    words(1, place);
    column(values.horizontal, place + 8, `${what}.horizontal`);
    column(values.vertical, place + 16, `${what}.vertical`);
  };
  const ids = each(batch.ids, count, "ids", call);
  const classes = each(batch.trackClasses ?? 0, count, "trackClasses", call);
  words(size, 0);
  for (let k = 0; k < count; ++k) {
    module.putWhole(tracks + 8 * k, trackId(ids[k]!, `ids[${k}]`, call));
    module.putWhole(reports + size * k + reportAt.trackClass, whole(classes[k]!, 2 ** 32 - 1, `trackClasses[${k}]`, call));
  }
  column(batch.timestamps, reportAt.timestamp, "timestamps");
  vectors(batch.positions, reportAt.state, "positions");
  if (batch.velocities !== undefined) vectors(batch.velocities, reportAt.state + 24, "velocities");
  bounds(batch.positionErrors ?? 0, reportAt.positionError, "positionErrors");
  bounds(batch.velocityErrors ?? (batch.velocities ? 0 : Infinity), reportAt.velocityError, "velocityErrors");
  column(batch.timestampErrors ?? 0, reportAt.timestampError, "timestampErrors");
  if (batch.plans !== undefined) {
    checkKeys(batch.plans, planBatchKeys, "plans", call);
    words(1, reportAt.hasPlan);
    if (batch.plans.accelerations !== undefined)
      vectors(batch.plans.accelerations, reportAt.planAcceleration, "plans.accelerations");
    bounds(batch.plans.accelerationLimits ?? 0, reportAt.planLimit, "plans.accelerationLimits");
    column(batch.plans.validUntil ?? Infinity, reportAt.planValidUntil, "plans.validUntil");
  }
  return [tracks, reports, count];
}
