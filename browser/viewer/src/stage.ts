// The picture: camera, light, fog, the box and the spheres.
import {
  BackSide, BoxGeometry, type BufferGeometry, type Color, DirectionalLight, EdgesGeometry, Fog, Group, HemisphereLight, IcosahedronGeometry,
  InstancedMesh, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshPhongMaterial, PerspectiveCamera,
  Scene, Sphere, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";
import type { Palette } from "./colours.ts";
import type { Shown } from "./shown.ts";

/** The matrix of a sphere with this middle and radius, as the instance of a unit sphere. */
export function putSphere(matrices: ArrayLike<number> & { fill(value: number, from: number, to: number): unknown; [k: number]: number },
                          k: number, x: number, y: number, z: number, radius: number): void {
  const at = 16 * k;
  matrices.fill(0, at, at + 16);
  matrices[at] = matrices[at + 5] = matrices[at + 10] = radius;
  matrices[at + 12] = x;
  matrices[at + 13] = y;
  matrices[at + 14] = z;
  matrices[at + 15] = 1;
}

/** A unit sphere with fewer triangles where there are many of them, which share their corners. */
export function unitSphere(count: number): BufferGeometry {
  const sphere = new IcosahedronGeometry(1, count > 2000 ? 2 : count > 150 ? 3 : 6);
  sphere.deleteAttribute("uv");
  return mergeVertices(sphere);
}

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(38, 1, 0.1, 1000);
  readonly controls: OrbitControls;
  /** The smallest sphere around all that is shown. */
  readonly extent = new Sphere(new Vector3(), 1);
  private readonly renderer: WebGLRenderer;
  private readonly sky = new HemisphereLight(0xffffff, 0x4a5578, 1.5);
  private readonly sun = new DirectionalLight(0xffffff, 2.1);
  private readonly fog = new Fog(0, 1, 2);
  private readonly surroundings = new Group();
  private readonly lineMaterial = new LineBasicMaterial({ transparent: true, opacity: 0.7 });
  private readonly wallMaterial = new MeshBasicMaterial({ transparent: true, opacity: 0.07, side: BackSide, depthWrite: false, fog: false });
  private readonly bodyMaterial = new MeshPhongMaterial({ shininess: 45, specular: 0x2c2c34 });
  private bodies: InstancedMesh | null = null;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.scene.fog = this.fog;
    this.scene.add(this.sky, this.sun, this.sun.target, this.surroundings);
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  paint(palette: Palette): void {
    this.scene.background = palette.background;
    this.fog.color = palette.background;
    this.lineMaterial.color = palette.line;
    this.wallMaterial.color = palette.wall;
    this.sky.intensity = 1.5 * palette.light;
    this.sun.intensity = 2.1 * palette.light;
  }

  /** Makes room for what is shown from now on, and looks at it from the front. */
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
    const narrow = Math.min(Math.atan(Math.tan(half) * this.camera.aspect), half);
    const distance = radius / Math.sin(narrow);
    this.camera.position.set(0.55, -1, 0.42).setLength(distance).add(center);
    this.camera.near = radius / 100;
    this.camera.far = distance + radius * 12;
    this.camera.updateProjectionMatrix();
    // A little below the middle, as the buttons cover the lower edge.
    const lift = new Vector3(0, 0, -0.07 * radius);
    this.camera.position.add(lift);
    this.controls.target.copy(center).add(lift);
    this.controls.minDistance = radius / 20;
    this.controls.maxDistance = radius * 8;
    this.controls.update();
  }

  /** Three numbers of each body, and its colour. */
  draw(positions: Float64Array, radii: Float64Array, colourOf: (body: number) => Color): void {
    const count = radii.length;
    if (this.bodies === null || this.bodies.instanceMatrix.count !== count) {
      if (this.bodies !== null) {
        this.scene.remove(this.bodies);
        this.bodies.geometry.dispose();
        this.bodies.dispose();
      }
      this.bodies = new InstancedMesh(unitSphere(count), this.bodyMaterial, count);
      this.bodies.frustumCulled = false;
      this.scene.add(this.bodies);
    }
    const matrices = this.bodies.instanceMatrix.array;
    for (let k = 0; k < count; ++k) {
      putSphere(matrices, k, positions[3 * k]!, positions[3 * k + 1]!, positions[3 * k + 2]!, radii[k]!);
      this.bodies.setColorAt(k, colourOf(k));
    }
    this.bodies.instanceMatrix.needsUpdate = true;
    if (this.bodies.instanceColor !== null) this.bodies.instanceColor.needsUpdate = true;
  }

  render(): void {
    this.controls.update();
    const { center, radius } = this.extent;
    const distance = this.camera.position.distanceTo(center);
    this.fog.near = Math.max(distance - 0.6 * radius, 0.1 * radius);
    this.fog.far = distance + 2.6 * radius;
    // The light comes from above, to the left of whoever looks.
    this.sun.position.set(-0.6, 0.9, 0.7).applyQuaternion(this.camera.quaternion).add(new Vector3(0, 0, 0.6))
      .multiplyScalar(radius).add(center);
    this.sun.target.position.copy(center);
    this.renderer.render(this.scene, this.camera);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
  }
}
