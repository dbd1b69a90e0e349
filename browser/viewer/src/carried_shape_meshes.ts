// Drawings of what bodies carry in place of a ball.
import type { RigidPart, Vec3 } from "kinesphere";
import {
  Box3, BoxGeometry, BufferGeometry, CapsuleGeometry, type Color, DoubleSide, Float32BufferAttribute, Group, IcosahedronGeometry, type Material,
  Mesh, MeshBasicMaterial, MeshPhongMaterial, Quaternion, SphereGeometry, Vector3,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { CarriedShape, CarriedShapes, Orientations } from "./carried_shapes.ts";

const vectorOf = (point: Vec3) => new Vector3().fromArray(Array.from(point as ArrayLike<number>));

/** Returns the points whose convex hull, with the radius around it, is the part. */
function cornersOf(part: RigidPart): { corners: Vector3[]; radius: number } {
  if ("ball" in part) return { corners: [vectorOf(part.ball.centre)], radius: part.ball.radius };
  if ("capsule" in part) return { corners: [vectorOf(part.capsule.a), vectorOf(part.capsule.b)], radius: part.capsule.radius };
  if ("hull" in part) return { corners: part.hull.points.map(vectorOf), radius: part.hull.radius ?? 0 };
  const [lower, upper] = [vectorOf(part.box.lower), vectorOf(part.box.upper)];
  const corners = Array.from({ length: 8 }, (_, k) =>
    new Vector3((k & 1 ? upper : lower).x, (k & 2 ? upper : lower).y, (k & 4 ? upper : lower).z));
  return { corners, radius: part.box.radius ?? 0 };
}

function hullGeometry(corners: Vector3[], radius: number): BufferGeometry {
  const size = new Box3().setFromPoints(corners).getSize(new Vector3()).length();
  // Seen as if it had a little radius at least, since a flat hull would have no inside.
  const round = new IcosahedronGeometry(Math.max(radius, 0.01 * size), 1).getAttribute("position");
  const offsets = Array.from({ length: round.count }, (_, k) => new Vector3().fromBufferAttribute(round, k));
  return new ConvexGeometry(corners.flatMap((corner) => offsets.map((offset) => offset.clone().add(corner))));
}

function partGeometry(part: RigidPart): BufferGeometry {
  const { corners, radius } = cornersOf(part);
  if (corners.length > 2) return hullGeometry(corners, radius);
  const [a, b] = [corners[0]!, corners.at(-1)!];
  const along = b.clone().sub(a);
  // The geometry stands along y.
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), along.clone().normalize());
  const round = along.length() === 0 ? new SphereGeometry(radius, 32, 24) : new CapsuleGeometry(radius, along.length(), 12, 24);
  return round.applyQuaternion(turn).translate(...a.add(b).divideScalar(2).toArray());
}

/** All parts in one geometry, of triangles with normals alone. */
function partsGeometry(parts: readonly RigidPart[]): BufferGeometry {
  return mergeGeometries(parts.map((part) => {
    const geometry = partGeometry(part);
    geometry.deleteAttribute("uv");
    return geometry.index === null ? geometry : geometry.toNonIndexed();
  }));
}

function geometryOf(shape: CarriedShape): BufferGeometry {
  if ("parts" in shape) return partsGeometry(shape.parts);
  if ("box" in shape) {
    const { lower, upper } = shape.box;
    const part = (of: (axis: number) => number) => [of(0), of(1), of(2)] as const;
    const middle = part((axis) => (lower[axis]! + upper[axis]!) / 2);
    return new BoxGeometry(...part((axis) => upper[axis]! - lower[axis]!)).translate(...middle);
  }
  if ("mesh" in shape) {
    const { vertices, corners } = shape.mesh;
    return new BufferGeometry().setIndex(Array.from(corners))
      .setAttribute("position", new Float32BufferAttribute(Array.from(vertices), 3));
  }
  const corners = "triangle" in shape ? shape.triangle.flatMap((corner: Vec3) => Array.from(corner as ArrayLike<number>)) : [];
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3));
}

/** Rigid bodies look as balls do; moving shapes may be large, and are translucent. */
function materialOf(shape: CarriedShape): Material & { color: Color } {
  return "parts" in shape ? new MeshPhongMaterial({ specular: 0x444444, shininess: 48 })
    : new MeshBasicMaterial({ transparent: true, opacity: 0.45, side: DoubleSide, depthWrite: false });
}

export class CarriedShapeMeshes {
  readonly object = new Group();
  private shapes: CarriedShapes = new Map();
  private meshes = new Map<number, Mesh<BufferGeometry, Material & { color: Color }>>();

  /** Draws the shapes at the positions of their bodies. */
  draw(shapes: CarriedShapes, positions: Float64Array, orientations: Orientations, colourOf: (body: number) => Color): void {
    if (shapes !== this.shapes) this.make(shapes);
    for (const [place, mesh] of this.meshes) {
      mesh.visible = !Number.isNaN(positions[3 * place]);
      mesh.position.fromArray(positions, 3 * place);
      const orientation = orientations.get(place);
      if (orientation !== undefined) mesh.quaternion.set(...orientation);
      mesh.material.color.copy(colourOf(place));
    }
  }

  private make(shapes: CarriedShapes): void {
    for (const { geometry, material } of this.meshes.values()) {
      geometry.dispose();
      material.dispose();
    }
    this.object.clear();
    this.shapes = shapes;
    // Bodies of equal shapes share a geometry.
    const geometries = new Map<string, BufferGeometry>();
    this.meshes = new Map(Array.from(shapes, ([place, shape]) => {
      const key = JSON.stringify(shape);
      const geometry = geometries.get(key) ?? geometryOf(shape);
      geometries.set(key, geometry);
      return [place, new Mesh(geometry, materialOf(shape))];
    }));
    for (const mesh of this.meshes.values()) {
      mesh.renderOrder = mesh.material.transparent ? 1 : 0;
      this.object.add(mesh);
    }
  }
}
