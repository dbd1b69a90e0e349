// The boxes and triangles that moving bodies carry, in place of the balls around them.
import type { BodyView, Shape, Vec3, WorldView } from "kinesphere";
import { BoxGeometry, BufferGeometry, type Color, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshBasicMaterial } from "three";

/** The shapes of the bodies that carry one, by place in the picture. */
export type CarriedShapes = ReadonlyMap<number, Shape>;

export function carriedShapes(world: WorldView, views: readonly BodyView[]): CarriedShapes {
  const found = new Map<number, Shape>();
  for (const [place, { id }] of views.entries()) {
    const shape = world.shapeOf(id);
    if ("box" in shape || "triangle" in shape) found.set(place, shape);
  }
  return found;
}

function geometryOf(shape: Shape): BufferGeometry {
  if ("box" in shape) {
    const { lower, upper } = shape.box;
    const part = (of: (axis: number) => number) => [of(0), of(1), of(2)] as const;
    const middle = part((axis) => (lower[axis]! + upper[axis]!) / 2);
    return new BoxGeometry(...part((axis) => upper[axis]! - lower[axis]!)).translate(...middle);
  }
  const corners = "triangle" in shape ? shape.triangle.flatMap((corner: Vec3) => Array.from(corner as ArrayLike<number>)) : [];
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3));
}

export class CarriedShapeMeshes {
  readonly object = new Group();
  private shapes: CarriedShapes = new Map();
  private meshes = new Map<number, Mesh<BufferGeometry, MeshBasicMaterial>>();

  /** Draws the shapes at the positions of their bodies. */
  draw(shapes: CarriedShapes, positions: Float64Array, colourOf: (body: number) => Color): void {
    if (shapes !== this.shapes) this.make(shapes);
    for (const [place, mesh] of this.meshes) {
      mesh.visible = !Number.isNaN(positions[3 * place]);
      mesh.position.fromArray(positions, 3 * place);
      mesh.material.color.copy(colourOf(place));
    }
  }

  private make(shapes: CarriedShapes): void {
    for (const mesh of this.meshes.values()) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.object.clear();
    this.shapes = shapes;
    this.meshes = new Map(Array.from(shapes, ([place, shape]) => [place, new Mesh(geometryOf(shape),
      new MeshBasicMaterial({ transparent: true, opacity: 0.45, side: DoubleSide, depthWrite: false }))]));
    for (const mesh of this.meshes.values()) {
      mesh.renderOrder = 1;
      this.object.add(mesh);
    }
  }
}
