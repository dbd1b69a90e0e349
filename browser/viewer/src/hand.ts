// Grabbing a sphere with the pointer and throwing it, and clicking it.
import { Plane, Raycaster, Vector2, Vector3 } from "three";
import type { Shown } from "./shown.ts";
import type { Simulation } from "./simulation.ts";
import type { Stage } from "./stage.ts";

/** Seconds in which the held sphere is to reach the pointer. */
const reach = 0.1;
/** Pixels beside a sphere at which it can still be grabbed. */
const slack = 12;
/** Pixels and milliseconds within which a press is a click, and pulls nothing. */
const clickWay = 5;
const clickTime = 250;

export class Hand {
  /** The held body. */
  body: number | null = null;
  private readonly ray = new Raycaster();
  private readonly pointer = new Vector2();
  private readonly plane = new Plane();
  /** Vector from the place of the pointer on the plane to the centre of the sphere. */
  private readonly offset = new Vector3();
  private pointerId = -1;
  /** The press of the pointer, if it may still be a click. */
  private press: { pointerId: number; x: number; y: number; time: number } | null = null;

  /** `simulation` returns null while nothing can be pushed. `clicked` gets the body at which there was a click. */
  constructor(private readonly stage: Stage, private readonly shown: () => Shown, private readonly simulation: () => Simulation | null,
              clicked: (place: number) => void) {
    const { canvas } = stage;
    // Before the camera's controls get the event.
    canvas.addEventListener("pointerdown", (event) => this.grab(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.follow(event));
    canvas.addEventListener("pointerup", (event) => {
      if (this.press?.pointerId !== event.pointerId || this.hasPassed) return;
      const body = this.body ?? this.bodyAt(event.clientX, event.clientY);
      if (body !== null) clicked(body);
    }, { capture: true });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"] as const)
      canvas.addEventListener(name, (event) => {
        if (event.pointerId === this.pointerId) this.release();
      });
  }

  /** Gives the held sphere the velocity that brings it to the pointer; `speed` is simulated seconds for each second. */
  pull(speed: number): void {
    const simulation = this.simulation();
    const goal = this.goal();
    if (this.body === null || simulation === null || goal === null || !this.hasPassed) return;
    const positions = simulation.positions();
    const velocity = new Vector3();
    for (let axis = 0; axis < 3; ++axis)
      velocity.setComponent(axis, (goal[axis]! - positions[3 * this.body + axis]!) / (reach * speed));
    velocity.clampLength(0, (3 * this.stage.extent.radius) / Math.max(speed, 1e-3));
    simulation.setVelocity(this.body, velocity.toArray());
  }

  /** Returns the place for the centre of the held sphere: the pointer's, inside the walls. */
  goal(): Float64Array | null {
    const simulation = this.simulation();
    if (this.body === null || simulation === null) return null;
    const target = this.target();
    if (target === null) return null;
    const radius = simulation.radii()[this.body]!;
    const { box } = simulation;
    return Float64Array.from(target.toArray(), (goal, axis) =>
      box === null ? goal : Math.min(Math.max(goal, box.lower[axis]! + radius), box.upper[axis]! - radius));
  }

  release(): void {
    this.body = null;
    this.pointerId = -1;
    this.stage.controls.enabled = true;
    this.stage.canvas.classList.remove("holding");
  }

  /** Returns the body that is seen at a place of the page, if there is one. */
  bodyAt(x: number, y: number): number | null {
    const shown = this.shown();
    this.aim(x, y);
    const { origin, direction } = this.ray.ray;
    const positions = shown.positions();
    const radii = shown.radii();
    const shapes = shown.shapes();
    const { camera, canvas } = this.stage;
    const slackPerDistance = (2 * slack * Math.tan((camera.fov * Math.PI) / 360)) / canvas.clientHeight;
    const middle = new Vector3();
    let found: number | null = null;
    let foundHit = false;
    let least = Infinity;
    for (let k = 0; k < radii.length; ++k) {
      const shape = shapes.get(k);
      // Rigid bodies are grabbed as the balls around them.
      if (Number.isNaN(positions[3 * k]) || (shape !== undefined && !("parts" in shape))) continue;
      middle.fromArray(positions, 3 * k).sub(origin);
      const along = middle.dot(direction);
      if (along <= camera.near) continue;
      const aside = Math.sqrt(Math.max(middle.lengthSq() - along * along, 0)) - radii[k]!;
      const near = slackPerDistance * along;
      if (aside > near) continue;
      // A hit sphere comes before spheres that are only near the ray.
      const hit = aside <= 0;
      const order = hit ? along - radii[k]! : aside / near;
      if (hit === foundHit ? order < least : hit) {
        least = order;
        found = k;
        foundHit = hit;
      }
    }
    return found;
  }

  private grab(event: PointerEvent): void {
    if (this.body !== null || event.button !== 0) return;
    this.press = event.isPrimary ? { pointerId: event.pointerId, x: event.clientX, y: event.clientY, time: event.timeStamp } : null;
    const simulation = this.simulation();
    const body = simulation === null ? null : this.bodyAt(event.clientX, event.clientY);
    if (body === null || simulation === null) return;
    const middle = new Vector3().fromArray(simulation.positions(), 3 * body);
    this.plane.setFromNormalAndCoplanarPoint(this.stage.camera.getWorldDirection(new Vector3()), middle);
    const under = this.ray.ray.intersectPlane(this.plane, new Vector3());
    if (under === null) return;
    this.offset.subVectors(middle, under);
    this.body = body;
    this.pointerId = event.pointerId;
    this.stage.controls.enabled = false;
    this.stage.canvas.classList.add("holding");
    this.stage.canvas.setPointerCapture(event.pointerId);
  }

  /** True once the press is no click any more. */
  private get hasPassed(): boolean {
    if (this.press !== null && performance.now() - this.press.time > clickTime) this.press = null;
    return this.press === null;
  }

  private follow(event: PointerEvent): void {
    if (this.press !== null && Math.hypot(event.clientX - this.press.x, event.clientY - this.press.y) > clickWay) this.press = null;
    if (event.pointerId === this.pointerId) this.aim(event.clientX, event.clientY);
  }

  private aim(x: number, y: number): void {
    const frame = this.stage.canvas.getBoundingClientRect();
    this.pointer.set((2 * (x - frame.left)) / frame.width - 1, 1 - (2 * (y - frame.top)) / frame.height);
    this.stage.camera.updateMatrixWorld();
    this.ray.setFromCamera(this.pointer, this.stage.camera);
  }

  private target(): Vector3 | null {
    return this.ray.ray.intersectPlane(this.plane, new Vector3())?.add(this.offset) ?? null;
  }
}
