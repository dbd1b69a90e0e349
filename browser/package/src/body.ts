// Definitions of bodies, and their tables of numbers for the module.
import { type Box, boxKeys, type ContactEvents, numberOfContacts } from "./definition.js";
import type { Vec3 } from "./event.js";
import { type PerBody, type States, vector } from "./motion.js";
import { checkKeys, type Keys } from "./options.js";

export interface MotionLimits {
  /** >= 0 (length / time^2): the largest deviation from the planned acceleration. */
  accelerationLimit?: number;
  plannedAcceleration?: Vec3;
  /** >= 0 (length): every reported position is within this of the true one. */
  positionError?: number;
  /** >= 0 (length / time). */
  velocityError?: number;
}

/** The part of a definition that does not depend on the place. */
export interface BodyOptions extends MotionLimits {
  /** Which bodies it may touch: category and mask are bits, up to 2^53; -1 is the mask of all. */
  filter?: { category?: number; mask?: number; group?: number };
  /** A body that is not solid only senses and is sensed. */
  solid?: boolean;
  /** Which contact events it asks for; by default those of the world's definition. */
  contacts?: ContactEvents;
  sensorClass?: number;
  /** A whole number of the caller's, up to 2^53. */
  userData?: number;
  /** >= 0, or infinite; by default 1: every event of the body has it, and `bounce` and `run` use it. */
  mass?: number;
}

export interface BodyDefinition extends BodyOptions {
  position: Vec3;
  velocity?: Vec3;
  /** >= 0 (length); by default 1. */
  radius?: number;
}

export interface BodyBatch extends States, Omit<BodyOptions, "accelerationLimit" | "userData" | "mass"> {
  radii?: PerBody;
  accelerationLimits?: PerBody;
  userData?: PerBody;
  masses?: PerBody;
}

export type Shape =
  | { ball: { centre: Vec3; radius: number } }
  /** All points p with normal . p <= offset are solid. */
  | { halfSpace: { normal: Vec3; offset: number } }
  | { box: Box }
  | { triangle: readonly [Vec3, Vec3, Vec3] };

export const limitKeys: Keys<MotionLimits> = {
  accelerationLimit: true, plannedAcceleration: true, positionError: true, velocityError: true,
};
/** Keys of the options beside a motion, which gives the limits. */
export const movedKeys: Keys<Omit<BodyOptions, keyof MotionLimits>> = {
  filter: true, solid: true, contacts: true, sensorClass: true, userData: true, mass: true,
};
export const bodyKeys: Keys<BodyDefinition> = { ...limitKeys, ...movedKeys, position: true, velocity: true, radius: true };
const { accelerationLimit: _, ...commonLimitKeys } = limitKeys;
const { mass: __, ...commonKeys } = movedKeys;
export const batchKeys: Keys<BodyBatch> = {
  ...commonLimitKeys, ...commonKeys, positions: true, velocities: true, radii: true, accelerationLimits: true,
  masses: true,
};
export interface StaticOptions {
  solid?: boolean;
  sensorClass?: number;
  userData?: number;
}
export const staticKeys: Keys<StaticOptions> = { solid: true, sensorClass: true, userData: true };
const filterKeys: Keys<NonNullable<BodyOptions["filter"]>> = { category: true, mask: true, group: true };
const ballKeys: Keys<{ centre: Vec3; radius: number }> = { centre: true, radius: true };
const halfSpaceKeys: Keys<{ normal: Vec3; offset: number }> = { normal: true, offset: true };

/** Size of the table that body_at() in browser/module/world.cpp reads. */
export const bodyNumbers = 21;

export function putBody(numbers: Float64Array, at: number, body: BodyDefinition, call: string): void {
  numbers.set(vector(body.position, "position", call), at);
  numbers.set(vector(body.velocity ?? [0, 0, 0], "velocity", call), at + 3);
  numbers[at + 6] = body.radius ?? 1;
  putOptions(numbers, at, body, call);
}

export function putOptions(numbers: Float64Array, at: number, body: BodyOptions, call: string): void {
  if (body.filter !== undefined) checkKeys(body.filter, filterKeys, "filter", call);
  numbers[at + 7] = body.accelerationLimit ?? 0;
  numbers.set(vector(body.plannedAcceleration ?? [0, 0, 0], "plannedAcceleration", call), at + 8);
  numbers[at + 11] = body.positionError ?? 0;
  numbers[at + 12] = body.velocityError ?? 0;
  numbers[at + 13] = body.solid === false ? 0 : 1;
  numbers[at + 14] = whole(body.sensorClass ?? 0, 255, "sensorClass", call);
  numbers[at + 15] = whole(body.filter?.category ?? 1, 2 ** 53, "filter.category", call);
  const mask = body.filter?.mask ?? -1;
  numbers[at + 16] = mask === -1 ? -1 : whole(mask, 2 ** 53, "filter.mask", call);
  const group = body.filter?.group ?? 0;
  if (!Number.isInteger(group) || Math.abs(group) >= 2 ** 31)
    throw new RangeError(`${call}: filter.group must be a whole number of 32 bits, but is ${group}`);
  numbers[at + 17] = group;
  numbers[at + 18] = whole(body.userData ?? 0, 2 ** 53, "userData", call);
  numbers[at + 19] = body.mass ?? 1;
  numbers[at + 20] = body.contacts === undefined ? 0 : numberOfContacts(body.contacts, call);
}

export function whole(value: number, most: number, what: string, call: string): number {
  if (!Number.isInteger(value) || value < 0 || value > most)
    throw new RangeError(`${call}: ${what} must be a whole number from 0 to ${most}, but is ${value}`);
  return value;
}

export function shapeNumbers(shape: Shape, call: string): [kind: number, numbers: number[]] {
  const of = (values: Vec3, what: string) => vector(values, what, call);
  if ("ball" in shape) checkKeys(shape.ball, ballKeys, "ball", call);
  if ("halfSpace" in shape) checkKeys(shape.halfSpace, halfSpaceKeys, "halfSpace", call);
  if ("box" in shape) checkKeys(shape.box, boxKeys, "box", call);
  if ("ball" in shape) return [0, [...of(shape.ball.centre, "centre"), shape.ball.radius]];
  if ("halfSpace" in shape) return [1, [...of(shape.halfSpace.normal, "normal"), shape.halfSpace.offset]];
  if ("box" in shape) return [2, [...of(shape.box.lower, "lower"), ...of(shape.box.upper, "upper")]];
  if ("triangle" in shape) return [3, shape.triangle.flatMap((corner) => of(corner, "triangle"))];
  throw new TypeError(`${call}: shape must be a ball, a halfSpace, a box or a triangle`);
}
