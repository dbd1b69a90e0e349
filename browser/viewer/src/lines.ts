// Lines that change from picture to picture.
import { BufferAttribute, BufferGeometry, type Color, DynamicDrawUsage, LineBasicMaterial, LineSegments } from "three";
import { nearestImage, type Shown } from "./shown.ts";

/** Lines that change in number from picture to picture. */
export class Lines {
  readonly object: LineSegments<BufferGeometry, LineBasicMaterial>;
  private points = new Float32Array(0);
  private colours = new Float32Array(0);
  private count = 0;
  /** With `overAll` spheres do not hide them. */
  constructor(opacity: number, overAll = false) {
    this.object = new LineSegments(new BufferGeometry(),
      new LineBasicMaterial({ vertexColors: true, transparent: true, opacity, depthWrite: false, depthTest: !overAll }));
    if (overAll) this.object.renderOrder = 3;
    this.object.frustumCulled = false;
    this.object.visible = false;
  }
  begin(lines: number): void {
    this.count = 0;
    if (6 * lines <= this.points.length) return;
    this.points = new Float32Array(9 * lines);
    this.colours = new Float32Array(9 * lines);
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry()
      .setAttribute("position", new BufferAttribute(this.points, 3).setUsage(DynamicDrawUsage))
      .setAttribute("color", new BufferAttribute(this.colours, 3).setUsage(DynamicDrawUsage));
  }
  point(x: number, y: number, z: number, colour: Color): void {
    const at = 3 * this.count++;
    this.points[at] = x;
    this.points[at + 1] = y;
    this.points[at + 2] = z;
    this.colours[at] = colour.r;
    this.colours[at + 1] = colour.g;
    this.colours[at + 2] = colour.b;
  }
  /** Adds a line from one body to the other or, in periodic space, to its nearest image. */
  between(shown: Shown, positions: Float64Array, first: number, second: number, colour: Color): void {
    const from = positions.subarray(3 * first, 3 * first + 3);
    const to = nearestImage(shown, from, positions.subarray(3 * second, 3 * second + 3));
    this.point(from[0]!, from[1]!, from[2]!, colour);
    this.point(to[0]!, to[1]!, to[2]!, colour);
  }
  /** The twelve edges of a box. */
  box(lower: ArrayLike<number>, upper: ArrayLike<number>, colour: Color): void {
    const corner = (bits: number) => this.point((bits & 1 ? upper : lower)[0]!, (bits & 2 ? upper : lower)[1]!,
                                                (bits & 4 ? upper : lower)[2]!, colour);
    for (let from = 0; from < 8; ++from) {
      for (const bit of [1, 2, 4]) {
        if (from & bit) continue;
        corner(from);
        corner(from | bit);
      }
    }
  }
  end(): void {
    const { geometry } = this.object;
    geometry.setDrawRange(0, this.count);
    for (const name of ["position", "color"]) {
      const attribute = geometry.getAttribute(name);
      if (attribute !== undefined) attribute.needsUpdate = true;
    }
    this.object.visible = this.count > 0;
  }
  hide(): void {
    this.object.visible = false;
  }
}
