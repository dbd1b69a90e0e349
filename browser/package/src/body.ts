// Definitions of bodies, and shapes.
import { type Box, boxKeys } from "./definition.js";
import type { Filter } from "./filter.js";
import type { Argument, Module } from "./module.js";
import { checkKeys, type Keys, requireNumbers } from "./options.js";
import {
  bodyAt, type BodyFields, bodyFieldKeys, type MotionLimits, motionLimitsFieldKeys, putBodyFields, shapeAt,
} from "./records.js";
import { type PerBody, type States, type Vec3, vector } from "./state.js";

/** The part of a definition that does not depend on the place. */
export interface BodyOptions extends Omit<BodyFields, "position" | "velocity" | "radius"> {}
/** A body, in the order of its state, its shape and what it promises (kinesphere/body.hpp). */
export interface BodyDefinition extends BodyFields {}

/** A body that carries a shape, which stands for its radius. */
export type ShapeCarrier = Omit<BodyDefinition, "radius">;

/** The options beside a motion, which gives state and limits. */
export type MovedOptions = Omit<BodyOptions, keyof MotionLimits>;
/** A body of a motion. */
export interface MovedBodyDefinition extends MovedOptions {
  /** >= 0 (length); by default 1. */
  radius?: number;
}

export interface BodyBatch extends States, Omit<BodyOptions, "accelerationLimit" | "userData" | "mass"> {
  radii?: PerBody;
  accelerationLimits?: PerBody;
  userData?: PerBody;
  masses?: PerBody;
}

/** Shape of a static body, of a zone, or of a body that carries it. */
export type Shape =
  | { ball: { centre: Vec3; radius: number } }
  /** All points p with normal . p <= offset are solid. */
  | { halfSpace: { normal: Vec3; offset: number } }
  | { box: Box }
  | { triangle: readonly [Vec3, Vec3, Vec3] }
  | { mesh: MeshShape }
  /**
   * x and y of points: the surface of segments from each to the next, for worlds of two dimensions. shapeOf() returns it as
   * the mesh that it is, whose triangles are two for each segment.
   */
  | { chain: ArrayLike<number> };

/**
 * A surface of triangles that is one shape: terrain, a level. What slides over its edges meets one surface, and events
 * name the triangle (firstPart, secondPart).
 */
export interface MeshShape {
  /** x, y and z of each vertex. */
  vertices: ArrayLike<number>;
  /** Three numbers of vertices for each triangle. */
  corners: ArrayLike<number>;
}

export const limitKeys: Keys<MotionLimits> = motionLimitsFieldKeys;
export const bodyKeys: Keys<BodyDefinition> = bodyFieldKeys;
const { position: _position, velocity: _velocity, radius: _radius, ...optionKeys } = bodyKeys;
const {
  accelerationLimit: _limit, plannedAcceleration: _planned, positionError: _position_error, velocityError: _velocity_error,
  ...optionKeysOfMoved
} = optionKeys;
export const movedKeys: Keys<MovedOptions> = optionKeysOfMoved;
export const movedBodyKeys: Keys<MovedBodyDefinition> = { ...movedKeys, radius: "number" };
const { radius: ___, ...carrierKeys } = bodyKeys;
export const shapeCarrierKeys: Keys<ShapeCarrier> = carrierKeys;
const { accelerationLimit: _, ...commonLimitKeys } = limitKeys;
const { mass: __, ...commonKeys } = movedKeys;
export const batchKeys: Keys<BodyBatch> = {
  ...commonLimitKeys, ...commonKeys, positions: true, velocities: true, radii: true, accelerationLimits: true,
  userData: true, masses: true,
};
/** What a zone has besides its shape. */
export interface ZoneOptions {
  /** Which bodies it reports. */
  filter?: Filter;
  userData?: number;
}
/** What a static body has besides its shape. */
export interface StaticOptions extends ZoneOptions {
  solid?: boolean;
  sensorClass?: number;
}
export const zoneKeys: Keys<ZoneOptions> = { filter: true, userData: "number" };
export const staticKeys: Keys<StaticOptions> = { ...zoneKeys, solid: "boolean", sensorClass: "number" };
type ShapeName = "ball" | "halfSpace" | "box" | "triangle" | "mesh" | "chain";
const shapeKeys: Readonly<Record<ShapeName, true>> = {
  ball: true, halfSpace: true, box: true, triangle: true, mesh: true, chain: true,
};
const meshKeys: Keys<MeshShape> = { vertices: true, corners: true };
const ballKeys: Keys<{ centre: Vec3; radius: number }> = { centre: true, radius: "number" };
const halfSpaceKeys: Keys<{ normal: Vec3; offset: number }> = { normal: true, offset: "number" };

/** Reads a shape from its kind and its numbers. */
export function shapeFrom([kind, ...parts]: number[]): Shape {
  const at = (first: number): Vec3 => [parts[first]!, parts[first + 1]!, parts[first + 2]!];
  if (kind === 0) return { ball: { centre: at(0), radius: parts[3]! } };
  if (kind === 1) return { halfSpace: { normal: at(0), offset: parts[3]! } };
  if (kind === 2) return { box: { lower: at(0), upper: at(3) } };
  if (kind === 3) return { triangle: [at(0), at(3), at(6)] };
  const end = 2 + 3 * parts[0]!;
  return {
    mesh: { vertices: Float64Array.from(parts.slice(2, end)), corners: Uint32Array.from(parts.slice(end, end + 3 * parts[1]!)) },
  };
}

/** Returns a ks_shape as an argument. */
export function shapeRecord(shape: Shape, call: string): (module: Module) => number {
  checkKeys<Partial<Record<ShapeName, unknown>>>(shape, shapeKeys, "shape", call);
  return (module) => {
    const at = module.room(shapeAt.size);
    const put = (kind: number, what: string, points: readonly Vec3[], number = 0) => {
      module.putWord(at, kind);
      for (const [k, point] of points.entries())
        module.putVector(at + shapeAt.points + 24 * k, vector(point, what, call));
      module.putNumber(at + shapeAt.number, number);
      return at;
    };
    if ("ball" in shape) {
      checkKeys(shape.ball, ballKeys, "ball", call);
      return put(0, "centre", [shape.ball.centre], shape.ball.radius);
    }
    if ("halfSpace" in shape) {
      checkKeys(shape.halfSpace, halfSpaceKeys, "halfSpace", call);
      return put(1, "normal", [shape.halfSpace.normal], shape.halfSpace.offset);
    }
    if ("box" in shape) {
      checkKeys(shape.box, boxKeys, "box", call);
      return put(2, "upper", [vector(shape.box.lower, "lower", call), shape.box.upper]);
    }
    if ("triangle" in shape) return put(3, "triangle", shape.triangle);
    if (!("mesh" in shape || "chain" in shape))
      throw new TypeError(`${call}: shape must be a ball, a halfSpace, a box, a triangle, a mesh or a chain`);
    const mesh = "mesh" in shape ? meshOf(module, shape.mesh, call) : chainOf(module, shape.chain, call);
    module.finally(() => module.check("ks_mesh_destroy", mesh));
    module.u64[(at + shapeAt.number) >> 3] = mesh;
    module.putWord(at, 4);
    return at;
  };
}

function chainOf(module: Module, chain: ArrayLike<number>, call: string): bigint {
  requireNumbers(chain, "chain", call);
  if (chain.length % 2 !== 0) throw new TypeError(`${call}: chain must have two numbers for each point, but there are ${chain.length}`);
  const points = new Float64Array(1.5 * chain.length);
  for (let k = 0; k < chain.length; ++k) points[k + (k >> 1)] = chain[k]!;
  return module.handle("ks_mesh_create_chain", points, chain.length / 2);
}

function meshOf(module: Module, mesh: MeshShape, call: string): bigint {
  checkKeys(mesh, meshKeys, "mesh", call);
  for (const name of ["vertices", "corners"] as const) {
    requireNumbers(mesh[name], name, call);
    if (mesh[name].length % 3 !== 0)
      throw new TypeError(`${call}: ${name} must have three numbers each, but there are ${mesh[name].length}`);
  }
  // No vertex has the largest number.
  const corners = Array.from(mesh.corners, (corner) =>
    (Number.isInteger(corner) && corner >= 0 && corner < 2 ** 32 ? corner : -1));
  return module.handle("ks_mesh_create", Float64Array.from(mesh.vertices), mesh.vertices.length / 3,
                       (to) => to.words(corners), corners.length / 3);
}

/** Returns a ks_body_definition as an argument. */
export function bodyRecord(body: BodyFields, call: string): (module: Module) => number {
  return (module) => {
    const at = module.record(bodyAt);
    putBodyFields(module, at, body, call);
    return at;
  };
}
/** Does the same for a body whose state and limits come from a motion. */
export function movedRecord(body: MovedBodyDefinition, call: string): Argument {
  return bodyRecord({ ...body, position: [0, 0, 0] }, call);
}
