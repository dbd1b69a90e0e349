// Generated from include/kinesphere.h by interface/generate.py: change the header, and run that.
// Enumerations and records of the library, and their tables of numbers for the module.
import { boundNumbers, type ErrorBound } from "./error_bound.js";
import { type Filter, filterNumbers } from "./filter.js";
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

/** @internal Places in the table of a record, and its size. */
export const eventAt = { kind: 0, time: 1, first: 2, second: 3, wall: 4, repeated: 5, jammed: 6, alreadyTouching: 7,
  senses: 8, firstTraits: 9, secondTraits: 10, pairState: 11, firstState: 12, secondState: 18, point: 24, normal: 27,
  gap: 30, approachSpeed: 31, positionExcess: 32, velocityExcess: 33, distance: 34, firstUserData: 35, secondUserData:
  36, firstMass: 37, secondMass: 38, firstPart: 39, secondPart: 40, firstAngularVelocity: 41, secondAngularVelocity:
  44, firstSpinGain: 47, secondSpinGain: 50, accelerationLimit: 53 } as const;
/** @internal */ export const eventSize = 54;

/** The fields of an event, read from numbers that never change. */
export class EventFields {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}

  get kind(): EventKind { return eventKinds[this.numbers[0]!]!; }
  get time(): number { return this.numbers[1]!; }
  /** The body of the event or, for a pair, the body with the smaller id. A timer has none. */
  get first(): BodyId { return this.numbers[2]!; }
  /** The other body of a pair; null for walls, bound violations, timers and bodies that woke. */
  get second(): BodyId | null { return this.numbers[3]! < 0 ? null : this.numbers[3]!; }
  /** The wall of a wall event. */
  get wall(): Wall | null { return wallOf(this.numbers[4]!); }
  /** One of the two touched another body less than the Zeno interval ago: a response should take no energy here. */
  get repeated(): boolean { return this.numbers[5] === 1; }
  /** Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop both. */
  get jammed(): boolean { return this.numbers[6] === 1; }
  /**
   * Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count the others.
   */
  get alreadyTouching(): boolean { return this.numbers[7] === 1; }
  /** Of sensors: the body or bodies that sense the other one. */
  get senses(): (typeof senses)[number] { return senses[this.numbers[8]!]!; }
  get firstTraits(): BodyTraits { return traitsOf(this.numbers[9]!); }
  /** None for a wall. */
  get secondTraits(): BodyTraits { return traitsOf(this.numbers[10]!); }
  /** The state that the two of a pair were given; 0 for all others. */
  get pairState(): number { return this.numbers[11]!; }
  /** At `time`; of a static body one point of its shape. In periodic space the two are nearest images. */
  get firstState(): State { return this.state(12); }
  get secondState(): State { return this.state(18); }
  /** The middle of the gap between the two surfaces. */
  get point(): Float64Array { return this.numbers.subarray(24, 27); }
  /** Unit vector from `first` towards `second`, or towards the wall. */
  get normal(): Float64Array { return this.numbers.subarray(27, 30); }
  /** Distance between the surfaces (length); negative when they overlap. */
  get gap(): number { return this.numbers[30]!; }
  /** Speed at which the gap closes (length / time); negative when it opens. */
  get approachSpeed(): number { return this.numbers[31]!; }
  /** Of a bound violation: how far the reported position lies outside the bound (length). */
  get positionExcess(): number { return this.numbers[32]!; }
  /** Of a bound violation: by how much the velocity changed more than promised (length / time). */
  get velocityExcess(): number { return this.numbers[33]!; }
  /** Of a sensor: the sensor distance that was crossed (length). */
  get distance(): number { return this.numbers[34]!; }
  /** What the definition of the body gave. */
  get firstUserData(): number { return this.numbers[35]!; }
  get secondUserData(): number { return this.numbers[36]!; }
  /** Of the body; infinite for a static body. */
  get firstMass(): number { return this.numbers[37]!; }
  /** Of the body; infinite for a static body and for a wall. */
  get secondMass(): number { return this.numbers[38]!; }
  /** Of a rigid body: the number of the part at the contact; of a mesh: that of the triangle; 0 for all others. */
  get firstPart(): number { return this.numbers[39]!; }
  get secondPart(): number { return this.numbers[40]!; }
  /** Of a rigid body (radians / time); zero for all others. */
  get firstAngularVelocity(): Float64Array { return this.numbers.subarray(41, 44); }
  get secondAngularVelocity(): Float64Array { return this.numbers.subarray(44, 47); }
  /** Change of the angular velocity of a rigid body by a unit impulse along the normal (radians / (mass length)). */
  get firstSpinGain(): Float64Array { return this.numbers.subarray(47, 50); }
  get secondSpinGain(): Float64Array { return this.numbers.subarray(50, 53); }
  /** Of a bound violation: the acceleration limit that the body has from now on (length / time^2). */
  get accelerationLimit(): number { return this.numbers[53]!; }

  private state(from: number): State {
    return {
      position: this.numbers.subarray(from, from + 3),
      velocity: this.numbers.subarray(from + 3, from + 6),
    };
  }
}

/** @internal Places in the table of a record, and its size. */
export const monitorEventAt = { kind: 0, time: 1, first: 2, second: 3, level: 4, verdict: 5, before: 6, since: 7,
  likelyTime: 8, closestTime: 9, closestDistance: 10, positionExcess: 11, velocityExcess: 12 } as const;
/** @internal */ export const monitorEventSize = 13;

/** The fields of an event, read from numbers that never change. */
export class MonitorEventFields {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}

  get kind(): MonitorEventKind { return monitorEventKinds[this.numbers[0]!]!; }
  get time(): number { return this.numbers[1]!; }
  /** The track of the event; for a pair, the one with the lower id. */
  get first(): TrackId { return this.numbers[2]!; }
  /** Of a verdict or a prediction: the separation level. */
  get level(): number { return this.numbers[4]!; }
  /**
   * Time at which the verdict before began, -Infinity for a pair that was apart at all levels; of a prediction, time
   * at which it began.
   */
  get since(): number { return this.numbers[7]!; }
  /** Of a prediction: the time at which the two come within; Infinity if they never do. */
  get likelyTime(): number { return this.numbers[8]!; }
  /** Of a prediction: the time of the closest approach. */
  get closestTime(): number { return this.numbers[9]!; }
  /** Of a prediction: the distance then (length); for a cylinder that in the plane. */
  get closestDistance(): number { return this.numbers[10]!; }
  /** Of a contradiction: how far the position is outside of what was possible (length). */
  get positionExcess(): number { return this.numbers[11]!; }
  /** Of a contradiction: how far the velocity is outside (length / time). */
  get velocityExcess(): number { return this.numbers[12]!; }
}

/** @internal */ export const pairAnswerSize = 16;
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
export function pairAnswerOf(numbers: Float64Array): PairAnswer {
  return {
    verdict: verdicts[numbers[0]!]!,
    predicted: numbers[1] === 1,
    since: numbers[2]!,
    until: numbers[3]!,
    lower: numbers[4]!,
    upper: numbers[5]!,
    closestDistance: numbers[6]!,
    closestTime: numbers[7]!,
    closestHorizontal: numbers[8]!,
    closestVertical: numbers[9]!,
    relativeSpeed: numbers[10]!,
    likelyTime: numbers[11]!,
    inevitableBy: numbers[12]!,
    avoidableUntil: numbers[13]!,
    ask: numbers[14]!,
    askBy: numbers[15]!,
  };
}

/** @internal */ export const openPairSize = 5;
/** A pair that is not certainly apart at a level. */
export interface OpenPair {
  first: TrackId;
  second: TrackId;
  level: number;
  verdict: Verdict;
  since: number;
}
/** @internal */
export function openPairOf(numbers: Float64Array): OpenPair {
  return {
    first: numbers[0]!,
    second: numbers[1]!,
    level: numbers[2]!,
    verdict: verdicts[numbers[3]!]!,
    since: numbers[4]!,
  };
}

/** @internal */ export const predictedPairSize = 7;
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
export function predictedPairOf(numbers: Float64Array): PredictedPair {
  return {
    first: numbers[0]!,
    second: numbers[1]!,
    level: numbers[2]!,
    since: numbers[3]!,
    likelyTime: numbers[4]!,
    closestTime: numbers[5]!,
    closestDistance: numbers[6]!,
  };
}

/** @internal */ export const reportRequestSize = 3;
/** A report of `track` is needed by the time `by` for its verdict with `other` to stay certain. */
export interface ReportRequest {
  track: TrackId;
  other: TrackId;
  by: number;
}
/** @internal */
export function reportRequestOf(numbers: Float64Array): ReportRequest {
  return {
    track: numbers[0]!,
    other: numbers[1]!,
    by: numbers[2]!,
  };
}

function contactsNumber(contacts: ContactEvents | undefined, usual: number, call: string): number {
  if (contacts === undefined) return usual;
  const number = contactEvents.indexOf(contacts) + 1;
  if (number < 1)
    throw new TypeError(`${call}: contacts must be "all", "begin_and_end" or "impacts", but is ${shown(contacts)}`);
  return number;
}

/** @internal Places in the table of a record, and its size. */
export const worldAt = { dimensions: 0, periodic: 1, contactTolerance: 4, separationDistance: 5, zenoInterval: 6,
  startTime: 7, contacts: 8, allowOverlap: 9, spreadWindowStarts: 10, adoptObservedLimits: 11 } as const;
/** @internal */ export const worldSize = 12;

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
}
/** @internal */
export const worldFieldKeys: Keys<WorldFields> = { dimensions: "number", periodic: true, contactTolerance: "number",
  separationDistance: "number", zenoInterval: "number", startTime: "number", contacts: true, allowOverlap: "boolean",
  spreadWindowStarts: "boolean", adoptObservedLimits: "boolean" };
/** @internal Writes the table that the module reads; what is not given has its default. */
export function putWorldFields(numbers: Float64Array, at: number, given: WorldFields, call: string): void {
  numbers[at + 0] = given.dimensions ?? 3;
  numbers.set([given.periodic?.x ? 1 : 0, given.periodic?.y ? 1 : 0, given.periodic?.z ? 1 : 0], at + 1);
  numbers[at + 4] = given.contactTolerance ?? 1e-6;
  numbers[at + 5] = given.separationDistance ?? NaN;
  numbers[at + 6] = given.zenoInterval ?? 0;
  numbers[at + 7] = given.startTime ?? 0;
  numbers[at + 8] = contactsNumber(given.contacts, 3, call);
  numbers[at + 9] = given.allowOverlap === false ? 0 : 1;
  numbers[at + 10] = given.spreadWindowStarts ? 1 : 0;
  numbers[at + 11] = given.adoptObservedLimits === false ? 0 : 1;
}

/** @internal */
export function worldFieldsOf(numbers: Float64Array): Required<WorldFields> {
  return {
    dimensions: numbers[0]! as 2 | 3,
    periodic: { x: numbers[1] === 1, y: numbers[2] === 1, z: numbers[3] === 1 },
    contactTolerance: numbers[4]!,
    separationDistance: numbers[5]!,
    zenoInterval: numbers[6]!,
    startTime: numbers[7]!,
    contacts: contactEvents[numbers[8]! - 1]!,
    allowOverlap: numbers[9] === 1,
    spreadWindowStarts: numbers[10] === 1,
    adoptObservedLimits: numbers[11] === 1,
  };
}

/** @internal Places in the table of a record, and its size. */
export const bodyAt = { solid: 0, contacts: 1, sensorClass: 2, radius: 3, accelerationLimit: 4, positionError: 5,
  velocityError: 6, mass: 7, plannedAcceleration: 8, position: 11, velocity: 14, filter: 17, userData: 20 } as const;
/** @internal */ export const bodySize = 21;

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
/** @internal Writes the table that the module reads; what is not given has its default. */
export function putBodyFields(numbers: Float64Array, at: number, given: BodyFields, call: string): void {
  numbers[at + 0] = given.solid === false ? 0 : 1;
  numbers[at + 1] = contactsNumber(given.contacts, 0, call);
  numbers[at + 2] = whole(given.sensorClass ?? 0, 255, "sensorClass", call);
  numbers[at + 3] = given.radius ?? 1;
  numbers[at + 4] = given.accelerationLimit ?? 0;
  numbers[at + 5] = given.positionError ?? 0;
  numbers[at + 6] = given.velocityError ?? 0;
  numbers[at + 7] = given.mass ?? 1;
  numbers.set(vector(given.plannedAcceleration ?? [0, 0, 0], "plannedAcceleration", call), at + 8);
  numbers.set(vector(given.position, "position", call), at + 11);
  numbers.set(vector(given.velocity ?? [0, 0, 0], "velocity", call), at + 14);
  numbers.set(filterNumbers(given.filter ?? {}, call), at + 17);
  numbers[at + 20] = whole(given.userData ?? 0, 2 ** 53, "userData", call);
}

/** @internal Places in the table of a record, and its size. */
export const motionLimitsAt = { accelerationLimit: 0, positionError: 1, velocityError: 2, plannedAcceleration: 3
  } as const;
/** @internal */ export const motionLimitsSize = 6;

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
/** @internal Writes the table that the module reads; what is not given has its default. */
export function putMotionLimits(numbers: Float64Array, at: number, given: MotionLimits, call: string): void {
  numbers[at + 0] = given.accelerationLimit ?? 0;
  numbers[at + 1] = given.positionError ?? 0;
  numbers[at + 2] = given.velocityError ?? 0;
  numbers.set(vector(given.plannedAcceleration ?? [0, 0, 0], "plannedAcceleration", call), at + 3);
}

/** @internal Places in the table of a record, and its size. */
export const monitorAt = { dimensions: 0, tolerance: 1, timeResolution: 2, window: 3, staleAfter: 4, dropAfter: 5,
  predictionHold: 6, predictionConfirmation: 7, predictionMargin: 8, predictionErrorPart: 9 } as const;
/** @internal */ export const monitorSize = 10;

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
/** @internal Writes the table that the module reads; what is not given has its default. */
export function putMonitorFields(numbers: Float64Array, at: number, given: MonitorFields, _call: string): void {
  numbers[at + 0] = given.dimensions ?? 3;
  numbers[at + 1] = given.tolerance ?? 1e-3;
  numbers[at + 2] = given.timeResolution ?? 1e-3;
  numbers[at + 3] = given.window ?? 1;
  numbers[at + 4] = given.staleAfter ?? Infinity;
  numbers[at + 5] = given.dropAfter ?? Infinity;
  numbers[at + 6] = given.predictionHold ?? 0;
  numbers[at + 7] = given.predictionConfirmation ?? 0;
  numbers[at + 8] = given.predictionMargin ?? 0;
  numbers[at + 9] = given.predictionErrorPart ?? 0;
}

/** @internal */
export function monitorFieldsOf(numbers: Float64Array): Required<MonitorFields> {
  return {
    dimensions: numbers[0]! as 2 | 3,
    tolerance: numbers[1]!,
    timeResolution: numbers[2]!,
    window: numbers[3]!,
    staleAfter: numbers[4]!,
    dropAfter: numbers[5]!,
    predictionHold: numbers[6]!,
    predictionConfirmation: numbers[7]!,
    predictionMargin: numbers[8]!,
    predictionErrorPart: numbers[9]!,
  };
}

/** @internal Places in the table of a record, and its size. */
export const reportAt = { trackClass: 0, timestamp: 1, timestampError: 2, state: 3, positionError: 9, velocityError:
  12 } as const;
/** @internal */ export const reportSize = 15;

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
/** @internal Writes the table that the module reads; what is not given has its default. */
export function putReportFields(numbers: Float64Array, at: number, given: ReportFields, call: string): void {
  numbers[at + 0] = whole(given.trackClass ?? 0, 2 ** 32 - 1, "trackClass", call);
  numbers[at + 1] = given.timestamp;
  numbers[at + 2] = given.timestampError ?? 0;
  numbers.set(boundNumbers(given.positionError ?? 0, "positionError", call), at + 9);
}
