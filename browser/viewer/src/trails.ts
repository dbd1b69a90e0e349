// Trails of fast bodies, with a square at each place where a loop of 60 Hz would look.
import {
  BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, LineBasicMaterial, LineSegments, Points, PointsMaterial, type Scene,
} from "three";
import type { Palette } from "./colours.ts";
import { loopRate } from "./missed.ts";
import type { Shown } from "./shown.ts";

/** Looks of the loop for which a trail is kept, and places in it at most. */
const looksKept = 4;
const placesKept = 64;

interface Place {
  time: number;
  at: [number, number, number];
}

export class Trails {
  private bodies: readonly number[] = [];
  private places: Place[][] = [];
  private readonly lines = new LineSegments(new BufferGeometry(),
    new LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));
  private readonly looks = new Points(new BufferGeometry(),
    new PointsMaterial({ size: 8, sizeAttenuation: false, transparent: true, depthWrite: false }));
  private readonly colour = new Color();

  constructor(scene: Scene) {
    // Hollow squares, which no mark of an event looks like.
    this.looks.material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace("#include <clipping_planes_fragment>",
        "if (max(abs(gl_PointCoord.x - 0.5), abs(gl_PointCoord.y - 0.5)) < 0.28) discard;\n#include <clipping_planes_fragment>");
    };
    for (const object of [this.lines, this.looks]) {
      object.frustumCulled = false;
      object.renderOrder = 2;
      scene.add(object);
    }
  }

  show(shown: Shown): void {
    this.bodies = shown.trails;
    this.places = this.bodies.map(() => []);
    for (const [object, points] of [[this.lines, 2 * placesKept], [this.looks, looksKept + 1]] as const) {
      object.geometry.dispose();
      object.geometry = new BufferGeometry();
      for (const name of ["position", "color"])
        object.geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * points * this.bodies.length), 3).setUsage(DynamicDrawUsage));
    }
  }

  update(shown: Shown, positions: Float64Array, visible: boolean, palette: Palette): void {
    this.lines.visible = this.looks.visible = visible && this.bodies.length > 0;
    if (this.bodies.length === 0) return;
    const { time } = shown;
    this.bodies.forEach((body, k) => this.follow(this.places[k]!, time, positions.subarray(3 * body, 3 * body + 3)));
    if (visible) this.draw(time, palette);
  }

  /** Adds the present place of a body, and drops those that are old, or later than now after going back. */
  private follow(places: Place[], time: number, at: Float64Array): void {
    while (places.length > 0 && places.at(-1)!.time >= time) places.pop();
    if (!Number.isNaN(at[0]!)) places.push({ time, at: [at[0]!, at[1]!, at[2]!] });
    while (places.length > placesKept || (places.length > 0 && places[0]!.time < time - looksKept / loopRate)) places.shift();
  }

  private draw(time: number, palette: Palette): void {
    const position = this.lines.geometry.getAttribute("position");
    const colours = this.lines.geometry.getAttribute("color");
    const dots = this.looks.geometry.getAttribute("position");
    let points = 0;
    let dotCount = 0;
    for (const places of this.places) {
      for (let k = 1; k < places.length; ++k) {
        const [from, to] = [places[k - 1]!, places[k]!];
        for (const place of [from, to]) {
          const age = ((time - place.time) * loopRate) / looksKept;
          this.colour.copy(palette.trail).lerp(palette.background, Math.min(age, 1));
          position.setXYZ(points, ...place.at);
          colours.setXYZ(points++, this.colour.r, this.colour.g, this.colour.b);
        }
        // The loop looks at whole multiples of its interval.
        const look = Math.floor(to.time * loopRate) / loopRate;
        if (look <= from.time || dotCount >= dots.count) continue;
        const part = (look - from.time) / (to.time - from.time);
        dots.setXYZ(dotCount++, ...([0, 1, 2].map((axis) => from.at[axis]! + part * (to.at[axis]! - from.at[axis]!)) as [number, number, number]));
      }
    }
    this.lines.geometry.setDrawRange(0, points);
    this.looks.geometry.setDrawRange(0, dotCount);
    this.looks.material.color = palette.look;
    for (const attribute of [position, colours, dots]) attribute.needsUpdate = true;
  }
}
