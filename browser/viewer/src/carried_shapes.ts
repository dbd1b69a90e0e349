// What bodies carry in place of a ball: a shape, or the parts of a rigid body, and how these are turned.
import type { BodyView, RigidPart, Shape, WorldView } from "kinesphere";

export type CarriedShape = Shape | { parts: readonly RigidPart[] };
/** The shapes of the bodies that have one, by place in the picture. */
export type CarriedShapes = ReadonlyMap<number, CarriedShape>;
/** A unit quaternion x, y, z, w. */
export type Orientation = readonly [x: number, y: number, z: number, w: number];
/** How rigid bodies are turned, by place in the picture. */
export type Orientations = ReadonlyMap<number, Orientation>;

export function carriedShapes(world: WorldView, views: readonly BodyView[]): CarriedShapes {
  const found = new Map<number, CarriedShape>();
  for (const [place, { id, isRigid }] of views.entries()) {
    const shape = isRigid ? { parts: world.partsOf(id) } : world.shapeOf(id);
    if (!("ball" in shape || "halfSpace" in shape)) found.set(place, shape);
  }
  return found;
}

/** Returns how rigid bodies are turned at `time`, if each has kept its angular velocity since its last report. */
export function orientationsAt(time: number, world: WorldView, views: readonly BodyView[]): Orientations {
  const found = new Map<number, Orientation>();
  for (const [place, { id, isRigid, reportTime }] of views.entries()) {
    if (!isRigid) continue;
    const { orientation, angularVelocity } = world.rotation(id);
    const [w, x, y, z] = Array.from(orientation) as [number, number, number, number];
    found.set(place, product(turnBy(Array.from(angularVelocity), time - reportTime), [x, y, z, w]));
  }
  return found;
}

/** Returns the turn at this angular velocity (radians / time) for a duration. */
function turnBy(angularVelocity: number[], duration: number): Orientation {
  const [x, y, z] = angularVelocity as [number, number, number];
  const speed = Math.sqrt(x * x + y * y + z * z);
  const half = (speed * duration) / 2;
  const part = speed > 0 ? Math.sin(half) / speed : 0;
  return [part * x, part * y, part * z, Math.cos(half)];
}

/** Returns the turn by the second and then by the first. */
function product([ax, ay, az, aw]: Orientation, [bx, by, bz, bw]: Orientation): Orientation {
  return [aw * bx + ax * bw + ay * bz - az * by, aw * by + ay * bw + az * bx - ax * bz,
          aw * bz + az * bw + ax * by - ay * bx, aw * bw - ax * bx - ay * by - az * bz];
}
