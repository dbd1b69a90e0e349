// Rigid bodies: balls and capsules that move and turn together.
import { putBody, bodyNumbers, type MovedOptions, movedKeys, type ShapeCarrier, shapeCarrierKeys } from "./body.js";
import type { Vec3 } from "./event.js";
import type { Scratch } from "./module.js";
import { vector } from "./motion.js";
import { checkKeys, type Keys } from "./options.js";

/** A rotation as a unit quaternion w, x, y, z. */
export type Quaternion = ArrayLike<number>;

/** Orientation and angular velocity of a rigid body at one instant. */
export interface Rotation {
  /** Turns a vector of the body into one of the world. */
  orientation: Quaternion;
  /** In the world's axes (radians / time). */
  angularVelocity: Vec3;
}

/** A part of a rigid body, relative to its position, before it is turned. */
export type RigidPart =
  | { ball: { centre: Vec3; radius: number } }
  /** All points within the radius of the segment from a to b. */
  | { capsule: { a: Vec3; b: Vec3; radius: number } };

/** How a rigid body turns. */
export interface Turning {
  /** By default 1, 0, 0, 0. */
  orientation?: Quaternion;
  /** In the world's axes (radians / time); by default zero. */
  angularVelocity?: Vec3;
  /**
   * >= 0 (radians / time^2). At 0, the default, the body keeps its angular velocity between changes, and the world knows
   * its rotation; any other body needs World.setRotationProbe().
   */
  angularAccelerationLimit?: number;
  /** >= 0 (radians / time), by default infinite: must be finite if the limit above is not 0. */
  largestAngularSpeed?: number;
  /**
   * Moments of inertia about the axes of the body, which must be its principal ones (mass length^2). Contacts do not turn
   * it about an axis with moment 0, the default, or infinity.
   */
  inertia?: Vec3;
}
/** A rigid body; state and limits are those of its position. */
export interface RigidBodyDefinition extends ShapeCarrier, Turning {}
/** A rigid body whose position is a body of a motion. */
export interface MovedRigidBodyDefinition extends MovedOptions, Turning {}

/**
 * Sets rotations[7 k], ... to the orientation w, x, y, z and the angular velocity of ids[k] at `time`. Both arrays are
 * good during the call alone. It may not change the world that asks.
 */
export type RotationProbeFunction = (ids: Float64Array, time: number, rotations: Float64Array) => void;

const turningKeys: Keys<Turning> = {
  orientation: true, angularVelocity: true, angularAccelerationLimit: true, largestAngularSpeed: true, inertia: true,
};
const rigidBodyKeys: Keys<RigidBodyDefinition> = { ...shapeCarrierKeys, ...turningKeys };
const movedRigidBodyKeys: Keys<MovedRigidBodyDefinition> = { ...movedKeys, ...turningKeys };
const partKeys: Keys<{ ball?: unknown; capsule?: unknown }> = { ball: true, capsule: true };
const ballKeys: Keys<{ centre: Vec3; radius: number }> = { centre: true, radius: true };
const capsuleKeys: Keys<{ a: Vec3; b: Vec3; radius: number }> = { a: true, b: true, radius: true };

/** Size of a rotation in numbers. */
export const rotationNumbers = 7;

export function numbersOfRotation({ orientation, angularVelocity }: Rotation, call: string): number[] {
  if (orientation?.length !== 4) throw new TypeError(`${call}: orientation must be four numbers w, x, y, z`);
  return [...Array.from(orientation), ...vector(angularVelocity, "angularVelocity", call)];
}

export function rotationFrom(numbers: Float64Array): Rotation {
  return { orientation: numbers.subarray(0, 4), angularVelocity: numbers.subarray(4, 7) };
}

function partNumbers(part: RigidPart, call: string): number[] {
  checkKeys<{ ball?: unknown; capsule?: unknown }>(part, partKeys, "part", call);
  if ("ball" in part) {
    checkKeys(part.ball, ballKeys, "ball", call);
    const centre = vector(part.ball.centre, "centre", call);
    return [...centre, ...centre, part.ball.radius];
  }
  if (!("capsule" in part)) throw new TypeError(`${call}: part must be a ball or a capsule`);
  checkKeys(part.capsule, capsuleKeys, "capsule", call);
  return [...vector(part.capsule.a, "a", call), ...vector(part.capsule.b, "b", call), part.capsule.radius];
}

export function partsFrom(numbers: Float64Array): RigidPart[] {
  return Array.from({ length: numbers.length / 7 }, (_, k) => {
    const [a, b] = [numbers.subarray(7 * k, 7 * k + 3), numbers.subarray(7 * k + 3, 7 * k + 6)];
    const radius = numbers[7 * k + 6]!;
    return a.every((x, axis) => x === b[axis]) ? { ball: { centre: a, radius } } : { capsule: { a, b, radius } };
  });
}

/** Returns the arguments that rigid_body_at() in browser/module/rigid_bodies.cpp reads. */
export function rigidArguments(
  scratch: Scratch, parts: readonly RigidPart[], body: RigidBodyDefinition, call: string,
): [body: number, rigid: number, count: number, parts: number] {
  checkKeys(body, rigidBodyKeys, "body", call);
  const {
    orientation = [1, 0, 0, 0], angularVelocity = [0, 0, 0], angularAccelerationLimit = 0, largestAngularSpeed = Infinity,
    inertia = [0, 0, 0], ...rest
  } = body;
  const numbers = new Float64Array(bodyNumbers);
  putBody(numbers, 0, rest, call);
  const rigid = [
    ...numbersOfRotation({ orientation, angularVelocity }, call), angularAccelerationLimit, largestAngularSpeed,
    ...vector(inertia, "inertia", call),
  ];
  return [scratch.numbers(numbers), scratch.numbers(rigid), parts.length,
          scratch.numbers(parts.flatMap((part) => partNumbers(part, call)))];
}

/** The same for a body whose state and limits come from a motion. */
export function movedRigidArguments(
  scratch: Scratch, parts: readonly RigidPart[], body: MovedRigidBodyDefinition, call: string,
): [body: number, rigid: number, count: number, parts: number] {
  checkKeys(body, movedRigidBodyKeys, "body", call);
  return rigidArguments(scratch, parts, { ...body, position: [0, 0, 0] }, call);
}
