// The picture: camera, light, fog, the box and the spheres.
import type { Box } from "kinesphere";
import {
  BackSide, BoxGeometry, BufferGeometry, Color, DirectionalLight, EdgesGeometry, Float32BufferAttribute, Fog, Group,
  HemisphereLight, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CarriedShapeMeshes } from "./carried_shape_meshes.ts";
import type { CarriedShapes, Orientations } from "./carried_shapes.ts";
import type { Palette } from "./colours.ts";
import type { Shown } from "./shown.ts";
import { Spheres, sunDirection } from "./spheres.ts";

export interface Margins {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(38, 1, 0.1, 1000);
  readonly controls: OrbitControls;
  /** The smallest sphere around everything shown. */
  readonly extent = new Sphere(new Vector3(), 1);
  private readonly renderer: WebGLRenderer;
  private readonly fog = new Fog(0, 1, 2);
  private readonly surroundings = new Group();
  private readonly lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.7 });
  private readonly wallMaterial = new MeshBasicMaterial({ transparent: true, opacity: 0.07, side: BackSide, depthWrite: false, fog: false });
  private readonly bodies = new Spheres();
  /** Bodies out of focus. */
  private readonly ghosts = new Spheres(0.08);
  private readonly shapes = new CarriedShapeMeshes();
  private lightStrength = 1;
  /** What the shader of spheres computes, for shapes: light from above, and a sun that moves with the eye. */
  private readonly sky = new HemisphereLight(new Color().setRGB(0.52, 0.52, 0.52), new Color().setRGB(0.13, 0.15, 0.24));
  private readonly sun = new DirectionalLight();
  /** Pixels at the edges that something else covers. */
  private covered: Margins = { left: 0, top: 0, right: 0, bottom: 0 };

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.scene.fog = this.fog;
    this.sky.position.copy(this.camera.up);
    this.scene.add(this.surroundings, this.bodies.object, this.ghosts.object, this.shapes.object, this.sky, this.sun);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  paint(palette: Palette): void {
    this.scene.background = palette.background;
    this.fog.color = palette.background;
    this.lineMaterial.color = palette.line;
    this.wallMaterial.color = palette.wall;
    this.lightStrength = palette.light;
  }

  /** Prepares for another scene or recording, and looks at it from the front. */
  show(shown: Shown): void {
    for (const child of this.surroundings.children) (child as Mesh).geometry.dispose();
    this.surroundings.clear();
    const { box } = shown;
    if (box !== null) {
      const size = [0, 1, 2].map((axis) => Math.max(box.upper[axis]! - box.lower[axis]!, 1e-9));
      const middle = [0, 1, 2].map((axis) => (box.upper[axis]! + box.lower[axis]!) / 2) as [number, number, number];
      const cuboid = new BoxGeometry(size[0], size[1], size[2]);
      const walls = new Mesh(cuboid, this.wallMaterial);
      const edges = new LineSegments(new EdgesGeometry(cuboid), this.lineMaterial);
      for (const part of [walls, edges]) part.position.set(...middle);
      walls.renderOrder = -1;
      this.surroundings.add(walls, edges);
      this.extent.set(new Vector3(...middle), Math.hypot(...size) / 2);
    } else if (shown.region !== null) {
      const { lower, upper } = shown.region;
      this.surroundings.add(new LineSegments(floorGrid(shown.region), this.lineMaterial));
      const middle = [0, 1, 2].map((axis) => (lower[axis]! + upper[axis]!) / 2) as [number, number, number];
      this.extent.set(new Vector3(...middle), Math.hypot(...[0, 1, 2].map((axis) => upper[axis]! - lower[axis]!)) / 2);
    } else {
      const positions = shown.positions();
      const points: Vector3[] = [];
      for (let at = 0; at < positions.length; at += 3)
        points.push(new Vector3(positions[at], positions[at + 1], positions[at + 2]));
      if (points.length > 0) this.extent.setFromPoints(points);
      this.extent.radius = Math.max(this.extent.radius * 1.2, 1);
    }
    this.lookFromFront();
  }

  lookFromFront(): void {
    const { center, radius } = this.extent;
    const half = (this.camera.fov * Math.PI) / 360;
    const { clientWidth, clientHeight } = this.canvas;
    const { left, top, right, bottom } = this.covered;
    const free = Math.min(clientWidth - left - right, clientHeight - top - bottom) / Math.max(clientHeight, 1);
    const narrow = Math.atan(Math.tan(half) * Math.max(free, 0.2));
    const distance = radius / Math.sin(narrow);
    this.camera.position.set(0.55, -1, 0.42).setLength(distance).add(center);
    this.camera.near = radius / 100;
    this.camera.far = distance + radius * 12;
    this.camera.updateProjectionMatrix();
    // A little below the centre, since the buttons cover the lower edge.
    const lift = new Vector3(0, 0, bottom > 0 ? 0 : -0.07 * radius);
    this.camera.position.add(lift);
    this.controls.target.copy(center).add(lift);
    this.controls.minDistance = radius / 20;
    this.controls.maxDistance = radius * 8;
    this.controls.update();
  }

  /** The place of the camera, and the place that it looks at. */
  get cameraPlace(): number[] {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }
  lookAs(place: readonly number[]): void {
    this.camera.position.fromArray(place);
    this.controls.target.fromArray(place, 3);
    this.controls.update();
  }

  /** Puts the picture into the part of the canvas that nothing else covers. */
  leaveFree(covered: Margins): void {
    this.covered = covered;
    this.resize();
  }

  /**
   * Draws bodies: three numbers for each, the shape that it carries or else its radius, and its colour; balls that are not
   * in the focus, if there is one, as mere shadows.
   */
  draw(positions: Float64Array, radii: Float64Array, shapes: CarriedShapes, orientations: Orientations, focus: ReadonlySet<number> | null,
       colourOf: (body: number) => Color): void {
    this.bodies.resize(radii.length);
    this.ghosts.resize(focus === null ? 0 : radii.length);
    for (let k = 0; k < radii.length; ++k) {
      const isBall = !Number.isNaN(positions[3 * k]) && !shapes.has(k);
      const isGhost = isBall && focus?.has(k) === false;
      for (const spheres of focus === null ? [this.bodies] : [this.bodies, this.ghosts]) {
        if (isBall && isGhost === (spheres === this.ghosts)) spheres.put(k, positions[3 * k]!, positions[3 * k + 1]!, positions[3 * k + 2]!, radii[k]!, colourOf(k));
        else spheres.hide(k);
      }
    }
    this.bodies.done();
    this.ghosts.done();
    this.shapes.draw(shapes, positions, orientations, colourOf);
  }

  render(): void {
    this.controls.update();
    const { center, radius } = this.extent;
    const distance = this.camera.position.distanceTo(center);
    this.fog.near = Math.max(distance - 0.6 * radius, 0.1 * radius);
    this.fog.far = distance + 2.6 * radius;
    const above = new Vector3(0, 0, 1).transformDirection(this.camera.matrixWorldInverse);
    this.bodies.light(above, this.fog.color, this.fog.near, this.fog.far, this.lightStrength);
    // Materials divide light by pi.
    this.sky.intensity = Math.PI * this.lightStrength;
    this.sun.intensity = 0.62 * Math.PI * this.lightStrength;
    this.sun.position.copy(sunDirection).applyQuaternion(this.camera.quaternion);
    this.renderer.render(this.scene, this.camera);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    const { left, top, right, bottom } = this.covered;
    this.camera.setViewOffset(clientWidth, clientHeight, (right - left) / 2, (bottom - top) / 2, clientWidth, clientHeight);
    this.camera.updateProjectionMatrix();
  }
}

/** Returns squares on the floor of a region: about ten along its longer side, of a round size. */
function floorGrid({ lower, upper }: Box): BufferGeometry {
  const longest = Math.max(upper[0]! - lower[0]!, upper[1]! - lower[1]!, 1e-9);
  const decade = 10 ** Math.floor(Math.log10(longest / 10));
  const pitch = [1, 2, 5, 10].map((digit) => digit * decade).find((size) => longest / size <= 12)!;
  const [alongX, alongY] = [0, 1].map((axis) => [Math.floor(lower[axis]! / pitch), Math.ceil(upper[axis]! / pitch)]) as
    [[number, number], [number, number]];
  const points: number[] = [];
  for (let x = alongX[0]; x <= alongX[1]; ++x)
    points.push(x * pitch, alongY[0] * pitch, lower[2]!, x * pitch, alongY[1] * pitch, lower[2]!);
  for (let y = alongY[0]; y <= alongY[1]; ++y)
    points.push(alongX[0] * pitch, y * pitch, lower[2]!, alongX[1] * pitch, y * pitch, lower[2]!);
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
}
