// Rigid bodies: balls, capsules, boxes and convex hulls that move and turn together.
import { bodyRecord, movedKeys, type MovedOptions, type ShapeCarrier, shapeCarrierKeys } from "./body.js";
import type { Argument } from "./module.js";
import { checkKeys, type Keys, requireNumbers, shown } from "./options.js";
import { rigidAt, rigidHullAt } from "./records.js";
import { type Vec3, vector } from "./state.js";

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
  | { capsule: { a: Vec3; b: Vec3; radius: number } }
  /** All points within the radius, by default 0, of the convex hull of one to 64 points. Three make a plate. */
  | { hull: { points: readonly Vec3[]; radius?: number } }
  /** All points within the radius, by default 0, of a box. One without height, lower[2] === upper[2], is a rectangle. */
  | { box: { lower: Vec3; upper: Vec3; radius?: number } };

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
  orientation: true, angularVelocity: true, angularAccelerationLimit: "number", largestAngularSpeed: "number", inertia: true,
};
const rigidBodyKeys: Keys<RigidBodyDefinition> = { ...shapeCarrierKeys, ...turningKeys };
const movedRigidBodyKeys: Keys<MovedRigidBodyDefinition> = { ...movedKeys, ...turningKeys };
type AnyPart = { ball?: unknown; capsule?: unknown; hull?: unknown; box?: unknown };
const partKeys: Keys<AnyPart> = { ball: true, capsule: true, hull: true, box: true };
const ballKeys: Keys<{ centre: Vec3; radius: number }> = { centre: true, radius: "number" };
const capsuleKeys: Keys<{ a: Vec3; b: Vec3; radius: number }> = { a: true, b: true, radius: "number" };
const hullKeys: Keys<{ points: readonly Vec3[]; radius?: number }> = { points: true, radius: "number" };
const boxKeys: Keys<{ lower: Vec3; upper: Vec3; radius?: number }> = { lower: true, upper: true, radius: "number" };

/** Size of a rotation in numbers. */
export const rotationNumbers = 7;

export function numbersOfRotation({ orientation, angularVelocity }: Rotation, call: string): number[] {
  if (orientation?.length !== 4) throw new TypeError(`${call}: orientation must be four numbers w, x, y, z`);
  requireNumbers(orientation, "orientation", call);
  return [...Array.from(orientation), ...vector(angularVelocity, "angularVelocity", call)];
}

export function rotationFrom(numbers: Float64Array): Rotation {
  return { orientation: numbers.subarray(0, 4), angularVelocity: numbers.subarray(4, 7) };
}

/** Returns the corners of a box, each once, in the order of box_part() in kinesphere/rigid_body.hpp. */
function cornersOf(lower: number[], upper: number[]): number[][] {
  let corners = [lower];
  for (const axis of [0, 1, 2])
    if (lower[axis] !== upper[axis]) corners = [...corners, ...corners.map((corner) => corner.map((x, k) => (k === axis ? upper[axis]! : x)))];
  return corners;
}

/** Returns the radius and the points of the hull that a part is. */
function hullOf(part: RigidPart, call: string): [radius: number, points: number[][]] {
  checkKeys<AnyPart>(part, partKeys, "part", call);
  if ("ball" in part) {
    checkKeys(part.ball, ballKeys, "ball", call);
    return [part.ball.radius, [vector(part.ball.centre, "centre", call)]];
  }
  if ("capsule" in part) {
    checkKeys(part.capsule, capsuleKeys, "capsule", call);
    const { a, b, radius } = part.capsule;
    return [radius, [vector(a, "a", call), vector(b, "b", call)]];
  }
  if ("hull" in part) {
    checkKeys(part.hull, hullKeys, "hull", call);
    const { points, radius = 0 } = part.hull;
    if (!Array.isArray(points) || points.length === 0)
      throw new TypeError(`${call}: hull must have points, an array of one to 64`);
    return [radius, points.map((point: Vec3) => vector(point, "point", call))];
  }
  if (!("box" in part)) throw new TypeError(`${call}: part must be a ball, a capsule, a hull or a box`);
  checkKeys(part.box, boxKeys, "box", call);
  const { lower, upper, radius = 0 } = part.box;
  return [radius, cornersOf(vector(lower, "lower", call), vector(upper, "upper", call))];
}

/** Reads the answer of world_parts_of(). A box comes as the hull of its corners. */
export function partsFrom(numbers: Float64Array): RigidPart[] {
  const parts: RigidPart[] = [];
  for (let at = 0; at < numbers.length;) {
    const [radius, count] = [numbers[at]!, numbers[at + 1]!];
    const first = at + 2;
    const points = Array.from({ length: count }, (_, k) => numbers.subarray(first + 3 * k, first + 3 * k + 3));
    at = first + 3 * count;
    const [a, b] = [points[0]!, points[1]!];
    const isBall = a.every((x, axis) => x === b[axis]);
    parts.push(count > 2 ? { hull: { points, radius } }
               : isBall ? { ball: { centre: a, radius } } : { capsule: { a, b, radius } });
  }
  return parts;
}

/** Returns a ks_body_definition and a ks_rigid_definition, whose parts are hulls, in their order, as arguments. */
export function rigidRecords(
  parts: readonly RigidPart[], body: RigidBodyDefinition, call: string,
): [body: Argument, rigid: Argument] {
  checkKeys(body, rigidBodyKeys, "body", call);
  if (!Array.isArray(parts)) throw new TypeError(`${call}: parts must be an array, but is ${shown(parts)}`);
  const {
    orientation = [1, 0, 0, 0], angularVelocity = [0, 0, 0], angularAccelerationLimit = 0, largestAngularSpeed = Infinity,
    inertia = [0, 0, 0], ...rest
  } = body;
  return [bodyRecord(rest, call), (module) => {
    const at = module.record(rigidAt);
    module.putVector(at + rigidAt.rotation, numbersOfRotation({ orientation, angularVelocity }, call));
    module.putNumber(at + rigidAt.angularAccelerationLimit, angularAccelerationLimit);
    module.putNumber(at + rigidAt.largestAngularSpeed, largestAngularSpeed);
    module.putVector(at + rigidAt.inertia, vector(inertia, "inertia", call));
    const first = module.room(rigidHullAt.size * parts.length);
    for (const [k, part] of (parts as readonly RigidPart[]).entries()) {
      const [radius, points] = hullOf(part, call);
      const hull = first + rigidHullAt.size * k;
      module.putWord(hull + rigidHullAt.pointCount, points.length);
      module.putWord(hull + rigidHullAt.points, module.numbers(points.flat()));
      module.putNumber(hull + rigidHullAt.radius, radius);
    }
    module.putWord(at + rigidAt.hullCount, parts.length);
    module.putWord(at + rigidAt.hulls, first);
    return at;
  }];
}

/** Does the same for a body whose state and limits come from a motion. */
export function movedRigidRecords(
  parts: readonly RigidPart[], body: MovedRigidBodyDefinition, call: string,
): [body: Argument, rigid: Argument] {
  checkKeys(body, movedRigidBodyKeys, "body", call);
  return rigidRecords(parts, { ...body, position: [0, 0, 0] }, call);
}
