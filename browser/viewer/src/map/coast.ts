// The coasts of the earth (Natural Earth, ../../coast.js), on the plane of a watch.
import { address, step } from "virtual:coast";
import type { EarthPlane } from "./earth.ts";
import type { Bounds } from "./scene.ts";
import type { View } from "./view.ts";

/** A closed line with the land on its right, or, for a hole, on its left. */
export interface Ring {
  /** Longitudes and latitudes alternating. Unit: degrees. */
  angles: Float32Array;
  isHole: boolean;
}

interface PlaneRing extends Bounds {
  /** x and y alternating. */
  points: Float64Array;
}

/** Corners of the coast are about this far off. Unit: metres. */
const coarseness = 1200;
/** The coast is as strong as it gets while its error is below the first number of pixels, and gone above the second. */
const [sharp, useless] = [10, 60];
/** Metres from the origin; land beyond is not drawn. */
const reach = 7e6;

/** Reads what packedCoast() of ../../coast.js writes, after decompression. */
export function ringsOf(bytes: Uint8Array): Ring[] {
  let at = 0;
  const number = (): number => {
    let value = 0;
    for (let place = 1; ; place *= 128) {
      const byte = bytes[at++]!;
      value += byte % 128 * place;
      if (byte < 128) return value;
    }
  };
  const signed = (): number => {
    const value = number();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  };
  const rings: Ring[] = [];
  while (at < bytes.length) {
    const head = number();
    const angles = new Float32Array(2 * Math.floor(head / 2));
    let [x, y] = [0, 0];
    for (let k = 0; k < angles.length; k += 2) {
      angles[k] = (x += signed()) * step;
      angles[k + 1] = (y += signed()) * step;
    }
    rings.push({ angles, isHole: head % 2 === 1 });
  }
  return rings;
}

async function fetchRings(): Promise<Ring[]> {
  const response = await fetch(address);
  if (!response.ok || response.body === null) throw new Error(`the coast: ${response.status}`);
  const whole = response.body.pipeThrough(new DecompressionStream("gzip"));
  return ringsOf(new Uint8Array(await new Response(whole).arrayBuffer()));
}

/**
 * Returns the ring on the plane; null if nothing of it is within reach. Points beyond are moved to the circle that ends
 * the reach, which changes nothing inside.
 */
function onPlane({ angles, isHole }: Ring, plane: EarthPlane): { ring: PlaneRing; isAround: boolean } | null {
  const points = new Float64Array(angles.length);
  const bounds = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  let isNear = false;
  let doubleArea = 0;
  for (let k = 0; k < angles.length; k += 2) {
    let [x, y] = plane.toPlane(angles[k]!, angles[k + 1]!);
    const distance = Math.hypot(x, y);
    if (distance > reach) [x, y] = [x * reach / distance, y * reach / distance];
    else isNear = true;
    points[k] = x;
    points[k + 1] = y;
    bounds.left = Math.min(bounds.left, x);
    bounds.right = Math.max(bounds.right, x);
    bounds.bottom = Math.min(bounds.bottom, y);
    bounds.top = Math.max(bounds.top, y);
    if (k > 0) doubleArea += points[k - 2]! * y - x * points[k - 1]!;
  }
  // The land of a ring around the point opposite to the origin is outside of it on the plane; such a ring turns the
  // other way there.
  const isAround = (doubleArea > 0) !== isHole && Math.abs(doubleArea) > reach ** 2;
  return isNear || isAround ? { ring: { points, ...bounds }, isAround } : null;
}

/** A circle of land for each ring around the opposite point. */
function wholeReach(): PlaneRing {
  const corners = 180;
  const points = Float64Array.from({ length: 2 * corners + 2 }, (_, k) => {
    const angle = -Math.floor(k / 2) / corners * 2 * Math.PI;
    return reach * (k % 2 === 0 ? Math.cos(angle) : Math.sin(angle));
  });
  return { points, left: -reach, right: reach, bottom: -reach, top: reach };
}

export class Coast {
  private rings: Ring[] | null = null;
  private plane: EarthPlane | null = null;
  private drawn: PlaneRing[] = [];
  private isAsked = false;

  /** `loaded` is called when the coast can be drawn. It is asked for at the first call of draw(). */
  constructor(private readonly loaded: () => void) {}

  /** Number of rings that may be seen on the plane. */
  get size(): number {
    return this.drawn.length;
  }

  draw(context: CanvasRenderingContext2D, view: View, plane: EarthPlane, colours: { land: string; shore: string }): void {
    if (this.rings === null) return this.load();
    if (plane !== this.plane) this.place(plane);
    const strength = (useless - coarseness * view.look.scale) / (useless - sharp);
    if (strength <= 0) return;
    context.beginPath();
    for (const ring of this.drawn) addRing(context, view, ring);
    context.globalAlpha = Math.min(strength, 1);
    context.fillStyle = colours.land;
    // Land is where rings turn, in sum, once.
    context.fill("nonzero");
    context.strokeStyle = colours.shore;
    context.lineWidth = 1;
    context.lineJoin = "round";
    context.stroke();
    context.globalAlpha = 1;
  }

  private load(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    fetchRings().then((rings) => {
      this.rings = rings;
      this.loaded();
    }, (error: unknown) => console.warn(error));
  }

  private place(plane: EarthPlane): void {
    this.plane = plane;
    this.drawn = [];
    for (const ring of this.rings!) {
      const placed = onPlane(ring, plane);
      if (placed === null) continue;
      this.drawn.push(placed.ring);
      if (placed.isAround) this.drawn.push(wholeReach());
    }
  }
}

/** Adds what is seen of a ring, without points that would make no difference. */
function addRing(context: CanvasRenderingContext2D, view: View, ring: PlaneRing): void {
  const { points } = ring;
  const [left, bottom] = view.toScreen(ring.left, ring.bottom);
  const [right, top] = view.toScreen(ring.right, ring.top);
  const margin = 4;
  if (right < -margin || left > view.width + margin || bottom < -margin || top > view.height + margin) return;
  if (right - left < 1 && bottom - top < 1) return;
  const [originX, originY] = view.toScreen(0, 0);
  const { scale } = view.look;
  /** Bits of the sides of the picture beyond which a place lies. */
  const outside = (x: number, y: number): number =>
    (x < -margin ? 1 : x > view.width + margin ? 2 : 0) | (y < -margin ? 4 : y > view.height + margin ? 8 : 0);
  let [lastX, lastY] = [NaN, NaN];
  let [skippedX, skippedY, hasSkipped] = [0, 0, false];
  // Sides beyond which all points lie since the last one that was added.
  let common = 0;
  for (let k = 0; k < points.length; k += 2) {
    const x = originX + points[k]! * scale;
    const y = originY - points[k + 1]! * scale;
    const here = outside(x, y);
    if (k > 0 && (here & common) !== 0) {
      common &= here;
      [skippedX, skippedY, hasSkipped] = [x, y, true];
      continue;
    }
    if (k > 0 && Math.abs(x - lastX) + Math.abs(y - lastY) < 0.8) continue;
    if (hasSkipped) context.lineTo(skippedX, skippedY);
    hasSkipped = false;
    if (k === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
    [lastX, lastY, common] = [x, y, here];
  }
  context.closePath();
}
