// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// Enumerations and records of the library, and where they lie in the memory of the module.
import { type ErrorBound, putBound } from "./error_bound.js";
import { type Filter, putFilter } from "./filter.js";
import { type Memory, Place } from "./memory.js";
import { type Keys, shown, whole } from "./options.js";
import { type BodyId, type State, type Vec3, vector } from "./state.js";

/** Identifies a track: a whole number from 0 to 2^53 - 1 of the caller's, such as a transponder address or an MMSI. */
export type TrackId = number;

export const eventKinds = ["bound_violation", "contact_begin", "contact_end", "wall_begin", "wall_end", "zeno_guard",
  "sensor_enter", "sensor_leave", "woke", "timer"] as const;
/** Kinds of events, in the order of their delivery within one instant. */
export type EventKind = (typeof eventKinds)[number];

export const walls = ["x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"] as const;
/** The walls of the box of a world. */
export type Wall = (typeof walls)[number];
/** @internal */ export const wallOf = (number: number): Wall | null => walls[number - 1] ?? null;

export const contactEvents = ["impacts", "begin_and_end", "all"] as const;
/** Which contact events bodies ask for. */
export type ContactEvents = (typeof contactEvents)[number];

export const bodyActions = ["remove", "disable", "sleep"] as const;
/** What a response does to a body, after the body has got its velocity. */
export type BodyAction = (typeof bodyActions)[number];

export const probeReasons = ["touching", "narrow_misses", "loose_limit", "contacts", "travel", "changes",
  "queries"] as const;
/** Main reason for the probes of a body. */
export type ProbeReason = (typeof probeReasons)[number];

export const verdicts = ["apart", "undecided", "within"] as const;
/** What the reports prove about two tracks and a separation. */
export type Verdict = (typeof verdicts)[number];

export const monitorEventKinds = ["verdict", "predicted", "prediction_ended", "contradiction", "resolved", "stale",
  "resumed", "dropped", "reclassified"] as const;
/** Kinds of events of a monitor. */
export type MonitorEventKind = (typeof monitorEventKinds)[number];

/** The reason of a failed call: one of the error codes of the library (kinesphere/result.hpp). */
export type ErrorCode = "not_finite" | "out_of_range" | "time_backwards" | "unknown_body" | "stale_body" |
  "foreign_body" | "disabled_body" | "enabled_body" | "static_body" | "outside_domain" | "overlapping" |
  "probe_in_progress" | "filter_in_progress" | "run_in_progress" | "workers_busy" | "no_threads" | "null_probe" |
  "null_callback" | "callback_threw" | "rank_failed" | "moved_from" | "unsupported" | "bad_snapshot" | "bad_bytes" |
  "recording" | "not_recording" | "not_profiling" | "bad_recording" | "diverged";

/** Properties of one body of an event. */
export interface BodyTraits {
  /** The body never moves. */
  isStatic: boolean;
  /** The body is not solid: it touches no other body. */
  isZone: boolean;
  /** The body sleeps and stays asleep: contacts wake their bodies. */
  isSleeping: boolean;
}
function traitsOf(bits: number): BodyTraits {
  return { isStatic: (bits & 1) !== 0, isZone: (bits & 2) !== 0, isSleeping: (bits & 4) !== 0 };
}

const senses = ["neither", "first", "second", "both"] as const;

function contactsNumber(contacts: ContactEvents | undefined, usual: number, call: string): number {
  if (contacts === undefined) return usual;
  const number = contactEvents.indexOf(contacts) + 1;
  if (number < 1)
    throw new TypeError(`${call}: contacts must be "all", "begin_and_end" or "impacts", but is ${shown(contacts)}`);
  return number;
}
function axesBits(axes: WorldFields["periodic"] = {}): number {
  return (axes.x ? 1 : 0) + (axes.y ? 2 : 0) + (axes.z ? 4 : 0);
}
function axesOf(bits: number): { x: boolean; y: boolean; z: boolean } {
  return { x: (bits & 1) !== 0, y: (bits & 2) !== 0, z: (bits & 4) !== 0 };
}
function idOrNull(id: number): BodyId | null {
  return id < 0 ? null : id;
}

/** @internal Size of a ks_event, and offsets of its fields, in bytes. */
export const eventAt = { size: 400, kind: 4, time: 8, first: 16, second: 28, wall: 40, repeated: 44, jammed: 48,
  alreadyTouching: 52, senses: 56, firstTraits: 60, secondTraits: 64, pairState: 68, firstState: 72, secondState: 120,
  point: 168, normal: 192, gap: 216, approachSpeed: 224, positionExcess: 232, velocityExcess: 240, distance: 248,
  firstUserData: 256, secondUserData: 264, firstMass: 272, secondMass: 280, firstPart: 288, secondPart: 292,
  firstAngularVelocity: 296, secondAngularVelocity: 320, firstSpinGain: 344, secondSpinGain: 368, accelerationLimit:
  392 } as const;

/** The fields of an event, read from memory that never changes. */
export class EventFields extends Place {
  get kind(): EventKind { return eventKinds[this.word(4) - 1]!; }
  get time(): number { return this.number(8); }
  /** The body of the event or, for a pair, the body with the smaller id. A timer has none. */
  get first(): BodyId { return this.id(16); }
  /** The other body of a pair; null for walls, bound violations, timers and bodies that woke. */
  get second(): BodyId | null { return idOrNull(this.id(28)); }
  /** The wall of a wall event. */
  get wall(): Wall | null { return wallOf(this.word(40)); }
  /** One of the two touched another body less than the Zeno interval ago: a response should take no energy here. */
  get repeated(): boolean { return this.word(44) !== 0; }
  /** Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop both. */
  get jammed(): boolean { return this.word(48) !== 0; }
  /**
   * Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count the others.
   */
  get alreadyTouching(): boolean { return this.word(52) !== 0; }
  /** Of sensors: the body or bodies that sense the other one. */
  get senses(): (typeof senses)[number] { return senses[this.word(56)]!; }
  get firstTraits(): BodyTraits { return traitsOf(this.word(60)); }
  /** None for a wall. */
  get secondTraits(): BodyTraits { return traitsOf(this.word(64)); }
  /** The state that the two of a pair were given; 0 for all others. */
  get pairState(): number { return this.word(68); }
  /** At `time`; of a static body one point of its shape. In periodic space the two are nearest images. */
  get firstState(): State { return this.state(72); }
  get secondState(): State { return this.state(120); }
  /** The middle of the gap between the two surfaces. */
  get point(): Float64Array { return this.vector(168); }
  /** Unit vector from `first` towards `second`, or towards the wall. */
  get normal(): Float64Array { return this.vector(192); }
  /** Distance between the surfaces (length); negative when they overlap. */
  get gap(): number { return this.number(216); }
  /** Speed at which the gap closes (length / time); negative when it opens. */
  get approachSpeed(): number { return this.number(224); }
  /** Of a bound violation: how far the reported position lies outside the bound (length). */
  get positionExcess(): number { return this.number(232); }
  /** Of a bound violation: by how much the velocity changed more than promised (length / time). */
  get velocityExcess(): number { return this.number(240); }
  /** Of a sensor: the sensor distance that was crossed (length). */
  get distance(): number { return this.number(248); }
  /** What the definition of the body gave. */
  get firstUserData(): number { return this.whole(256); }
  get secondUserData(): number { return this.whole(264); }
  /** Of the body; infinite for a static body. */
  get firstMass(): number { return this.number(272); }
  /** Of the body; infinite for a static body and for a wall. */
  get secondMass(): number { return this.number(280); }
  /** Of a rigid body: the number of the part at the contact; of a mesh: that of the triangle; 0 for all others. */
  get firstPart(): number { return this.word(288); }
  get secondPart(): number { return this.word(292); }
  /** Of a rigid body (radians / time); zero for all others. */
  get firstAngularVelocity(): Float64Array { return this.vector(296); }
  get secondAngularVelocity(): Float64Array { return this.vector(320); }
  /** Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / (mass length)). */
  get firstSpinGain(): Float64Array { return this.vector(344); }
  get secondSpinGain(): Float64Array { return this.vector(368); }
  /** Of a bound violation: the acceleration limit that the body has from now on (length / time^2). */
  get accelerationLimit(): number { return this.number(392); }
}

/** @internal Size of a ks_monitor_event, and offsets of its fields, in bytes. */
export const monitorEventAt = { size: 96, kind: 4, time: 8, first: 16, second: 24, level: 32, verdict: 36, before: 40,
  since: 48, likelyTime: 56, closestTime: 64, closestDistance: 72, positionExcess: 80, velocityExcess: 88 } as const;

/** The fields of an event, read from memory that never changes. */
export class MonitorEventFields extends Place {
  get kind(): MonitorEventKind { return monitorEventKinds[this.word(4) - 1]!; }
  get time(): number { return this.number(8); }
  /** The track of the event; for a pair, the one with the lower id. */
  get first(): TrackId { return this.whole(16); }
  /** Of a verdict or a prediction: the separation level. */
  get level(): number { return this.word(32); }
  /**
   * Time at which the verdict before began, -Infinity for a pair that was apart at all levels; of a prediction, time
   * at which it began.
   */
  get since(): number { return this.number(48); }
  /** Of a prediction: the time at which the two come within; Infinity if they never do. */
  get likelyTime(): number { return this.number(56); }
  /** Of a prediction: the time of the closest approach. */
  get closestTime(): number { return this.number(64); }
  /** Of a prediction: the distance then (length); for a cylinder that in the plane. */
  get closestDistance(): number { return this.number(72); }
  /** Of a contradiction: how far the position is outside of what was possible (length). */
  get positionExcess(): number { return this.number(80); }
  /** Of a contradiction: how far the velocity is outside (length / time). */
  get velocityExcess(): number { return this.number(88); }
}

/** @internal Size of a ks_pair_answer, and offsets of its fields, in bytes. */
export const pairAnswerAt = { size: 128, verdict: 4, predicted: 8, since: 16, until: 24, lower: 32, upper: 40,
  closestDistance: 48, closestTime: 56, closestHorizontal: 64, closestVertical: 72, relativeSpeed: 80, likelyTime: 88,
  inevitableBy: 96, avoidableUntil: 104, ask: 112, askBy: 120 } as const;

/** The verdict about two tracks, with a forecast. */
export interface PairAnswer {
  verdict: Verdict;
  /** From `predicted` to `prediction_ended`. */
  predicted: boolean;
  /** Time since which the verdict has held; -Infinity for a pair that is apart at all levels. */
  since: number;
  /** A certain verdict is true until this time, whatever is reported. */
  until: number;
  /** Lower limit of the distance now (length); for a cylinder, of that in the plane. */
  lower: number;
  /** Upper limit of it. */
  upper: number;
  /** Estimate, if both go straight on: distance at the closest approach; for a cylinder that in the plane. */
  closestDistance: number;
  /** Estimate: the time of the closest approach. */
  closestTime: number;
  /** Estimate: the horizontal part of the distance at that time. */
  closestHorizontal: number;
  /** Estimate: the vertical part. */
  closestVertical: number;
  /** Estimate: speed of one relative to the other now. */
  relativeSpeed: number;
  /** Estimate: time at which they first are within the separation; Infinity if they never are. */
  likelyTime: number;
  /** The pair certainly is within at some time up to this one, whatever the tracks do within their limits. */
  inevitableBy: number;
  /** Estimate: if both go straight on until this time, no accelerations within their limits keep them out. */
  avoidableUntil: number;
  /** The track whose report would tighten the bounds most. */
  ask: TrackId;
  /** When that report is needed for the verdict to stay certain. */
  askBy: number;
}
/** @internal */
export function pairAnswerOf(from: Place): PairAnswer {
  return {
    verdict: verdicts[from.word(4)]!,
    predicted: from.word(8) !== 0,
    since: from.number(16),
    until: from.number(24),
    lower: from.number(32),
    upper: from.number(40),
    closestDistance: from.number(48),
    closestTime: from.number(56),
    closestHorizontal: from.number(64),
    closestVertical: from.number(72),
    relativeSpeed: from.number(80),
    likelyTime: from.number(88),
    inevitableBy: from.number(96),
    avoidableUntil: from.number(104),
    ask: from.whole(112),
    askBy: from.number(120),
  };
}

/** @internal Size of a ks_open_pair, and offsets of its fields, in bytes. */
export const openPairAt = { size: 32, first: 0, second: 8, level: 16, verdict: 20, since: 24 } as const;

/** A pair that is not certainly apart at a level. */
export interface OpenPair {
  first: TrackId;
  second: TrackId;
  level: number;
  verdict: Verdict;
  since: number;
}
/** @internal */
export function openPairOf(from: Place): OpenPair {
  return {
    first: from.whole(0),
    second: from.whole(8),
    level: from.word(16),
    verdict: verdicts[from.word(20)]!,
    since: from.number(24),
  };
}

/** @internal Size of a ks_predicted_pair, and offsets of its fields, in bytes. */
export const predictedPairAt = { size: 56, first: 0, second: 8, level: 16, since: 24, likelyTime: 32, closestTime: 40,
  closestDistance: 48 } as const;

/** A pair that is predicted to come within a separation; times and distance as in its event, from now. */
export interface PredictedPair {
  first: TrackId;
  second: TrackId;
  level: number;
  /** Time of its event `predicted`. */
  since: number;
  likelyTime: number;
  closestTime: number;
  closestDistance: number;
}
/** @internal */
export function predictedPairOf(from: Place): PredictedPair {
  return {
    first: from.whole(0),
    second: from.whole(8),
    level: from.word(16),
    since: from.number(24),
    likelyTime: from.number(32),
    closestTime: from.number(40),
    closestDistance: from.number(48),
  };
}

/** @internal Size of a ks_report_request, and offsets of its fields, in bytes. */
export const reportRequestAt = { size: 24, track: 0, other: 8, by: 16 } as const;

/** A report of `track` is needed by the time `by` for its verdict with `other` to stay certain. */
export interface ReportRequest {
  track: TrackId;
  other: TrackId;
  by: number;
}
/** @internal */
export function reportRequestOf(from: Place): ReportRequest {
  return {
    track: from.whole(0),
    other: from.whole(8),
    by: from.number(16),
  };
}

/** @internal Size of a ks_timings, and offsets of its fields, in bytes. */
export const timingsAt = { size: 24, advances: 0, advance: 8, probes: 16 } as const;

/** Wall-clock time spent (seconds) since profiling was switched on. */
export interface Timings {
  /** Calls that advance the world. */
  advances: number;
  /** In these calls, including probes. */
  advance: number;
  /** In the caller's probes. */
  probes: number;
}
/** @internal */
export function timingsOf(from: Place): Timings {
  return {
    advances: from.whole(0),
    advance: from.number(8),
    probes: from.number(16),
  };
}

/** @internal Size of a ks_busy_body, and offsets of its fields, in bytes. */
export const busyBodyAt = { size: 88, body: 0, reason: 12, probes: 16, touching: 24, nearOthers: 32, windows: 40,
  changes: 48, queries: 56, contacts: 64, accelerationLimit: 72, largestAcceleration: 80 } as const;

/** A body that was probed while profiling was on; `probes` is the sum of the next five fields. */
export interface BusyFields {
  body: BodyId;
  reason: ProbeReason;
  /** Its probed states; the sum of the next five. */
  probes: number;
  /** For a body or wall that it touches. */
  touching: number;
  /** For a body, wall or sensor distance that it may reach or leave. */
  near: number;
  /** As it left its safe regions. */
  windows: number;
  /** After changes by the caller and violated bounds. */
  changes: number;
  /** For queries and predictions with a probe. */
  queries: number;
  /** Its begins of contacts with bodies and walls. */
  contacts: number;
  /** Its limit now (length / time^2). */
  accelerationLimit: number;
  /** Largest deviation from the plan that reports prove (length / time^2). */
  largestAcceleration: number;
}
/** @internal */
export function busyBodyOf(from: Place): BusyFields {
  return {
    body: from.id(0),
    reason: probeReasons[from.word(12)]!,
    probes: from.whole(16),
    touching: from.whole(24),
    near: from.whole(32),
    windows: from.whole(40),
    changes: from.whole(48),
    queries: from.whole(56),
    contacts: from.whole(64),
    accelerationLimit: from.number(72),
    largestAcceleration: from.number(80),
  };
}

/** @internal Size of a ks_world_definition, and offsets of its fields, in bytes. */
export const worldAt = { size: 152, dimensions: 4, hasBox: 8, periodic: 12, box: 16, contactTolerance: 64,
  separationDistance: 72, zenoInterval: 80, startTime: 88, contacts: 96, allowOverlap: 100, spreadWindowStarts: 104,
  hasWallFilter: 108, wallFilter: 112, adoptObservedLimits: 136, shearRate: 144 } as const;

/** Fields and ranges: kinesphere/world_definition.hpp. */
export interface WorldFields {
  /** 2 or 3, default 3. With 2, bodies are discs in the plane z = 0. */
  dimensions?: 2 | 3;
  /** These axes repeat, and have no walls. */
  periodic?: { x?: boolean; y?: boolean; z?: boolean };
  /** > 0 (length), default 1e-6: the largest gap of a contact. */
  contactTolerance?: number;
  /** > contactTolerance (length), default NaN, which is four tolerances: the gap at which a contact ends. */
  separationDistance?: number;
  /** >= 0 (time): contacts of a body that follow each other sooner are `repeated`. */
  zenoInterval?: number;
  /** The time at which the world begins. */
  startTime?: number;
  /** Default `all`: what bodies ask for that do not say it themselves. */
  contacts?: ContactEvents;
  /** Default true. If false, bodies that certainly overlap are refused. */
  allowOverlap?: boolean;
  /** Has no effect. */
  spreadWindowStarts?: boolean;
  /**
   * Default true: a report that breaks the promise of its body raises the body's acceleration limit to what explains
   * the report.
   */
  adoptObservedLimits?: boolean;
  /**
   * (1 / time): the images of bodies across y slide along x, so that a flow goes on through the borders. x and y
   * repeat then, and all bodies are balls.
   */
  shearRate?: number;
}
/** @internal */
export const worldFieldKeys: Keys<WorldFields> = { dimensions: "number", periodic: true, contactTolerance: "number",
  separationDistance: "number", zenoInterval: "number", startTime: "number", contacts: true, allowOverlap: "boolean",
  spreadWindowStarts: "boolean", adoptObservedLimits: "boolean", shearRate: "number" };
/** @internal Writes a record of zeros; what is not given has its default. */
export function putWorldFields(to: Memory, at: number, given: WorldFields, call: string): void {
  to.putWord(at + 4, given.dimensions ?? 3);
  to.putWord(at + 12, axesBits(given.periodic));
  to.putNumber(at + 64, given.contactTolerance ?? 1e-6);
  to.putNumber(at + 72, given.separationDistance ?? NaN);
  to.putNumber(at + 80, given.zenoInterval ?? 0);
  to.putNumber(at + 88, given.startTime ?? 0);
  to.putWord(at + 96, contactsNumber(given.contacts, 3, call));
  to.putWord(at + 100, given.allowOverlap === false ? 0 : 1);
  to.putWord(at + 104, given.spreadWindowStarts ? 1 : 0);
  to.putWord(at + 136, given.adoptObservedLimits === false ? 0 : 1);
  to.putNumber(at + 144, given.shearRate ?? 0);
}

/** @internal */
export function worldFieldsOf(from: Place): Required<WorldFields> {
  return {
    dimensions: from.word(4) as 2 | 3,
    periodic: axesOf(from.word(12)),
    contactTolerance: from.number(64),
    separationDistance: from.number(72),
    zenoInterval: from.number(80),
    startTime: from.number(88),
    contacts: contactEvents[from.word(96) - 1]!,
    allowOverlap: from.word(100) !== 0,
    spreadWindowStarts: from.word(104) !== 0,
    adoptObservedLimits: from.word(136) !== 0,
    shearRate: from.number(144),
  };
}

/** @internal Size of a ks_body_definition, and offsets of its fields, in bytes. */
export const bodyAt = { size: 160, solid: 4, contacts: 8, sensorClass: 12, radius: 16, accelerationLimit: 24,
  positionError: 32, velocityError: 40, mass: 48, plannedAcceleration: 56, position: 80, velocity: 104, filter: 128,
  userData: 152 } as const;

/** Fields and ranges: kinesphere/body.hpp. */
export interface BodyFields {
  /** Default true. If false, the body only senses and is sensed. */
  solid?: boolean;
  /** Which contact events it asks for; by default those of the world. */
  contacts?: ContactEvents;
  /** From 0 to 255; 255 is that of zones. */
  sensorClass?: number;
  /** >= 0 (length), default 1. */
  radius?: number;
  /** >= 0 (length / time^2): the largest deviation from the planned acceleration. */
  accelerationLimit?: number;
  /** >= 0 (length): every reported position is within this of the true one. */
  positionError?: number;
  /** >= 0 (length / time): every reported velocity is within this of the true one. */
  velocityError?: number;
  /** >= 0, or Infinity, default 1: every event of the body has it, and bounces use it. */
  mass?: number;
  /** Known acceleration, such as gravity (length / time^2). */
  plannedAcceleration?: Vec3;
  position: Vec3;
  velocity?: Vec3;
  /** Selects the bodies that it may touch. */
  filter?: Filter;
  /** Stored for the caller. */
  userData?: number;
}
/** @internal */
export const bodyFieldKeys: Keys<BodyFields> = { solid: "boolean", contacts: true, sensorClass: "number", radius:
  "number", accelerationLimit: "number", positionError: "number", velocityError: "number", mass: "number",
  plannedAcceleration: true, position: true, velocity: true, filter: true, userData: "number" };
/** @internal Writes a record of zeros; what is not given has its default. */
export function putBodyFields(to: Memory, at: number, given: BodyFields, call: string): void {
  to.putWord(at + 4, given.solid === false ? 0 : 1);
  to.putWord(at + 8, contactsNumber(given.contacts, 0, call));
  to.putWord(at + 12, whole(given.sensorClass ?? 0, 255, "sensorClass", call));
  to.putNumber(at + 16, given.radius ?? 1);
  to.putNumber(at + 24, given.accelerationLimit ?? 0);
  to.putNumber(at + 32, given.positionError ?? 0);
  to.putNumber(at + 40, given.velocityError ?? 0);
  to.putNumber(at + 48, given.mass ?? 1);
  to.putVector(at + 56, vector(given.plannedAcceleration ?? [0, 0, 0], "plannedAcceleration", call));
  to.putVector(at + 80, vector(given.position, "position", call));
  to.putVector(at + 104, vector(given.velocity ?? [0, 0, 0], "velocity", call));
  putFilter(to, at + 128, given.filter ?? {}, call);
  to.putWhole(at + 152, whole(given.userData ?? 0, 2 ** 53, "userData", call));
}

/** @internal Size of a ks_motion_limits, and offsets of its fields, in bytes. */
export const motionLimitsAt = { size: 48, accelerationLimit: 0, positionError: 8, velocityError: 16,
  plannedAcceleration: 24 } as const;

/** Limits within which a body moves. */
export interface MotionLimits {
  accelerationLimit?: number;
  positionError?: number;
  velocityError?: number;
  plannedAcceleration?: Vec3;
}
/** @internal */
export const motionLimitsFieldKeys: Keys<MotionLimits> = { accelerationLimit: "number", positionError: "number",
  velocityError: "number", plannedAcceleration: true };
/** @internal Writes a record of zeros; what is not given has its default. */
export function putMotionLimits(to: Memory, at: number, given: MotionLimits, call: string): void {
  to.putNumber(at + 0, given.accelerationLimit ?? 0);
  to.putNumber(at + 8, given.positionError ?? 0);
  to.putNumber(at + 16, given.velocityError ?? 0);
  to.putVector(at + 24, vector(given.plannedAcceleration ?? [0, 0, 0], "plannedAcceleration", call));
}

/** @internal Size of a ks_monitor_definition, and offsets of its fields, in bytes. */
export const monitorAt = { size: 136, dimensions: 4, hasStartTime: 8, startTime: 16, classes: 24, classCount: 28,
  separations: 32, separationCount: 36, tolerance: 40, timeResolution: 48, window: 56, staleAfter: 64, dropAfter: 72,
  predictionHold: 80, predictionConfirmation: 88, predictionMargin: 96, predictionErrorPart: 104, shardOf: 112,
  shardFirst: 120, shardCount: 128 } as const;

/** Fields: MonitorDefinition in kinesphere/monitor/monitor.hpp. */
export interface MonitorFields {
  /** 2 or 3, default 3. In two dimensions, z is ignored. */
  dimensions?: 2 | 3;
  /** > 0 (length), default 1e-3: how far outside the separation a pair still is `within`. */
  tolerance?: number;
  /** > 0 (time), default 1e-3: how late a verdict may be that time alone decides. */
  timeResolution?: number;
  /** > 0 (time), default 1: about the time between two reports of a track. */
  window?: number;
  /** > 0 (time), default Infinity: age of the latest report at which a track is stale. */
  staleAfter?: number;
  /** > 0 (time), default Infinity: age of the latest report at which a track is dropped. */
  dropAfter?: number;
  /** >= 0 (time): a prediction ends once it has not held for this long. */
  predictionHold?: number;
  /** >= 0 (time): a prediction begins once it has held for this long. */
  predictionConfirmation?: number;
  /** In [0, 1]: a prediction goes on within the separation enlarged by this part of it. */
  predictionMargin?: number;
  /** In [0, 1]: separations are enlarged for predictions by this part of the position errors of both tracks. */
  predictionErrorPart?: number;
}
/** @internal */
export const monitorFieldKeys: Keys<MonitorFields> = { dimensions: "number", tolerance: "number", timeResolution:
  "number", window: "number", staleAfter: "number", dropAfter: "number", predictionHold: "number",
  predictionConfirmation: "number", predictionMargin: "number", predictionErrorPart: "number" };
/** @internal Writes a record of zeros; what is not given has its default. */
export function putMonitorFields(to: Memory, at: number, given: MonitorFields, _call: string): void {
  to.putWord(at + 4, given.dimensions ?? 3);
  to.putNumber(at + 40, given.tolerance ?? 1e-3);
  to.putNumber(at + 48, given.timeResolution ?? 1e-3);
  to.putNumber(at + 56, given.window ?? 1);
  to.putNumber(at + 64, given.staleAfter ?? Infinity);
  to.putNumber(at + 72, given.dropAfter ?? Infinity);
  to.putNumber(at + 80, given.predictionHold ?? 0);
  to.putNumber(at + 88, given.predictionConfirmation ?? 0);
  to.putNumber(at + 96, given.predictionMargin ?? 0);
  to.putNumber(at + 104, given.predictionErrorPart ?? 0);
}

/** @internal */
export function monitorFieldsOf(from: Place): Required<MonitorFields> {
  return {
    dimensions: from.word(4) as 2 | 3,
    tolerance: from.number(40),
    timeResolution: from.number(48),
    window: from.number(56),
    staleAfter: from.number(64),
    dropAfter: from.number(72),
    predictionHold: from.number(80),
    predictionConfirmation: from.number(88),
    predictionMargin: from.number(96),
    predictionErrorPart: from.number(104),
  };
}

/** @internal Size of a ks_track_report, and offsets of its fields, in bytes. */
export const reportAt = { size: 184, hasPlan: 4, trackClass: 8, timestamp: 16, timestampError: 24, state: 32,
  positionError: 80, velocityError: 104, planAcceleration: 128, planLimit: 152, planValidUntil: 176 } as const;

/** A reported state of a track. */
export interface ReportFields {
  /** Place of its class in those of the monitor. */
  trackClass?: number;
  /** Time of the state on the monitor's clock. */
  timestamp: number;
  /** Largest difference of the timestamp from the true time. */
  timestampError?: number;
  /** Largest distance of the true position from the reported one (length). */
  positionError?: ErrorBound;
}
/** @internal */
export const reportFieldKeys: Keys<ReportFields> = { trackClass: "number", timestamp: "number", timestampError:
  "number", positionError: true };
/** @internal Writes a record of zeros; what is not given has its default. */
export function putReportFields(to: Memory, at: number, given: ReportFields, call: string): void {
  to.putWhole(at + 8, whole(given.trackClass ?? 0, 2 ** 32 - 1, "trackClass", call));
  to.putNumber(at + 16, given.timestamp);
  to.putNumber(at + 24, given.timestampError ?? 0);
  putBound(to, at + 80, given.positionError ?? 0, "positionError", call);
}

/** @internal Size of a ks_shape, and offsets of its fields, in bytes. */
export const shapeAt = { size: 88, kind: 0, points: 8, number: 80 } as const;

/** @internal Size of a ks_static_definition, and offsets of its fields, in bytes. */
export const staticAt = { size: 136, solid: 4, sensorClass: 8, shape: 16, filter: 104, userData: 128 } as const;

/** @internal Size of a ks_body_view, and offsets of its fields, in bytes. */
export const bodyViewAt = { size: 264, enabled: 4, isStatic: 8, sleeping: 12, reportTime: 16, box: 24, boxEnd: 72,
  image: 80, definition: 104 } as const;

/** @internal Size of a ks_rigid_definition, and offsets of its fields, in bytes. */
export const rigidAt = { size: 120, partCount: 4, parts: 8, rotation: 16, angularAccelerationLimit: 72,
  largestAngularSpeed: 80, inertia: 88, hullCount: 112, hulls: 116 } as const;

/** @internal Size of a ks_rigid_hull, and offsets of its fields, in bytes. */
export const rigidHullAt = { size: 16, pointCount: 0, points: 4, radius: 8 } as const;

/** @internal Size of a ks_sensor_overlap, and offsets of its fields, in bytes. */
export const sensorOverlapAt = { size: 24, body: 0, distance: 16 } as const;

/** @internal Size of a ks_prediction, and offsets of its fields, in bytes. */
export const predictionAt = { size: 32, time: 0, partner: 8, wall: 20, happens: 24, probed: 28 } as const;

/** @internal Size of a ks_hit, and offsets of its fields, in bytes. */
export const hitAt = { size: 32, body: 0, certain: 12, lower: 16, upper: 24 } as const;

/** @internal Size of a ks_sphere, and offsets of its fields, in bytes. */
export const sphereAt = { size: 32, centre: 0, radius: 24 } as const;

/** @internal Size of a ks_ray, and offsets of its fields, in bytes. */
export const rayAt = { size: 64, origin: 0, direction: 24, length: 48, radius: 56 } as const;

/** @internal Size of a ks_response, and offsets of its fields, in bytes. */
export const responseAt = { size: 144, stop: 4, turnsFirst: 8, turnsSecond: 12, spinsFirst: 16, spinsSecond: 20,
  firstAction: 24, secondAction: 28, firstVelocity: 32, secondVelocity: 56, firstAngularVelocity: 80,
  secondAngularVelocity: 104, turnedBack: 128, setsPairState: 132, pairState: 136 } as const;

/** @internal Size of a ks_roughness, and offsets of its fields, in bytes. */
export const roughnessAt = { size: 40, restitution: 8, tangentialRestitution: 16, friction: 24, inertia: 32
  } as const;

/** @internal Size of a ks_step_potential_definition, and offsets of its fields, in bytes. */
export const stepPotentialAt = { size: 40, count: 8, distances: 12, energies: 16, outside: 24, restitution: 32
  } as const;

/** @internal Size of a ks_run_definition, and offsets of its fields, in bytes. */
export const runAt = { size: 40, threads: 4, restitution: 8, restingSpeed: 16, respond: 24, respondUser: 28, sink: 32,
  sinkUser: 36 } as const;

/** @internal Size of a ks_game_definition, and offsets of its fields, in bytes. */
export const gameAt = { size: 56, gravity: 8, restitution: 32, restingSpeed: 40, respond: 48, respondUser: 52
  } as const;

/** @internal Size of a ks_event_list, and offsets of its fields, in bytes. */
export const eventListAt = { size: 8, count: 0, events: 4 } as const;

/** @internal Size of a ks_body_list, and offsets of its fields, in bytes. */
export const bodyListAt = { size: 16, count: 0, ids: 4, positions: 8, velocities: 12 } as const;

/** @internal Size of a ks_track_class, and offsets of its fields, in bytes. */
export const classAt = { size: 72, accelerationLimit: 0, largestSpeed: 24, plannedAcceleration: 48 } as const;

/** @internal Size of a ks_separation, and offsets of its fields, in bytes. */
export const separationAt = { size: 40, shape: 0, horizontal: 8, vertical: 16, lookAhead: 24, modifiedTau: 32
  } as const;

/** @internal Size of a ks_separation_rule, and offsets of its fields, in bytes. */
export const separationRuleAt = { size: 16, firstClass: 0, secondClass: 4, levels: 8, levelCount: 12 } as const;
