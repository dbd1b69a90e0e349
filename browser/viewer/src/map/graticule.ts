// Lines of equal coordinates: of longitude and latitude, or of x and y.
import type { EarthPlane } from "./earth.ts";
import type { Bounds } from "./scene.ts";
import { latitudeText, longitudeText } from "./text.ts";
import type { Units } from "./units.ts";
import type { View } from "./view.ts";

export interface GridLine {
  label: string;
  /** True if it crosses the picture from bottom to top. */
  upright: boolean;
  /** x and y alternating, in the plane. */
  points: number[];
}

/** About how many pixels lie between two lines. */
const spacing = 130;
const mostLines = 60;

/** 1, 2 or 5 times a power of ten, at least `least`. */
export function niceStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((step) => step * power >= least * (1 - 1e-9)) ?? 10);
}

const angles = [1 / 3600, 2 / 3600, 5 / 3600, 10 / 3600, 20 / 3600, 30 / 3600, 1 / 60, 2 / 60, 5 / 60, 10 / 60, 20 / 60, 30 / 60,
                1, 2, 5, 10, 20, 30, 60];
/** Returns degrees; below a second, decimal parts of a second. */
function angleStep(least: number): number {
  if (least < 1 / 3600) return niceStep(least * 3600) / 3600;
  return angles.find((angle) => angle >= least) ?? 60;
}

/** Multiples of `step` from `first` to `last`. */
function* multiples(step: number, first: number, last: number): Iterable<number> {
  const end = Math.min(Math.floor(last / step), Math.ceil(first / step) + mostLines);
  for (let k = Math.ceil(first / step); k <= end; ++k) yield k * step;
}

function decimalText(value: number, step: number): string {
  return value.toFixed(Math.max(0, Math.min(9, Math.ceil(-Math.log10(step) - 1e-9))));
}

function plainGrid({ left, right, bottom, top }: Bounds, scale: number): GridLine[] {
  const step = niceStep(spacing / scale);
  return [
    ...Array.from(multiples(step, left, right), (x) => ({ label: decimalText(x, step), upright: true, points: [x, bottom, x, top] })),
    ...Array.from(multiples(step, bottom, top), (y) => ({ label: decimalText(y, step), upright: false, points: [left, y, right, y] })),
  ];
}

/** Returns the visible longitudes and latitudes; longitudes continue beyond 180. */
function anglesIn({ left, right, bottom, top }: Bounds, plane: EarthPlane): Bounds {
  const seen = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  const parts = 8;
  for (let i = 0; i <= parts; ++i) {
    for (let j = 0; j <= parts; ++j) {
      const [longitude, latitude] = plane.toEarth(left + (right - left) * i / parts, bottom + (top - bottom) * j / parts);
      const near = plane.longitude + ((longitude - plane.longitude + 540) % 360 + 360) % 360 - 180;
      seen.left = Math.min(seen.left, near);
      seen.right = Math.max(seen.right, near);
      seen.bottom = Math.min(seen.bottom, latitude);
      seen.top = Math.max(seen.top, latitude);
    }
  }
  for (const pole of [-90, 90]) {
    const [x, y] = plane.toPlane(0, pole);
    if (x < left || x > right || y < bottom || y > top) continue;
    Object.assign(seen, { left: plane.longitude - 180, right: plane.longitude + 180 }, pole < 0 ? { bottom: -90 } : { top: 90 });
  }
  return seen;
}

function earthGrid(bounds: Bounds, scale: number, plane: EarthPlane): GridLine[] {
  // Metres from the origin: about a quarter of the way round the earth, far beyond any radius that is watched.
  const reach = 9e6;
  const seen = anglesIn({
    left: Math.max(bounds.left, -reach), right: Math.min(bounds.right, reach),
    bottom: Math.max(bounds.bottom, -reach), top: Math.min(bounds.top, reach),
  }, plane);
  const degree = 111_195 * scale;
  const across = angleStep(spacing / degree);
  const middle = Math.min(Math.abs(seen.bottom + seen.top) / 2, 85);
  const along = angleStep(spacing / degree / Math.cos(middle * Math.PI / 180));
  // Steps of three degrees at most appear round.
  const parts = Math.max(24, Math.ceil(Math.max(seen.right - seen.left, seen.top - seen.bottom) / 3));
  const line = (at: (part: number) => [number, number]): number[] =>
    Array.from({ length: parts + 1 }, (_, k) => at(k / parts)).flatMap(([longitude, latitude]) => plane.toPlane(longitude, latitude));
  return [
    ...Array.from(multiples(along, seen.left, seen.right), (longitude) => ({
      label: longitudeText((longitude + 540) % 360 - 180, along), upright: true,
      points: line((part) => [longitude, seen.bottom + (seen.top - seen.bottom) * part]),
    })),
    ...Array.from(multiples(across, seen.bottom, seen.top), (latitude) => ({
      label: latitudeText(latitude, across), upright: false,
      points: line((part) => [seen.left + (seen.right - seen.left) * part, latitude]),
    })),
  ];
}

export function graticule(view: View, plane: EarthPlane | null): GridLine[] {
  return plane === null ? plainGrid(view.bounds, view.look.scale) : earthGrid(view.bounds, view.look.scale, plane);
}

/** Returns the longest bar of a round length that is at most `most` pixels long. */
export function scaleBar(scale: number, most: number, units: Units): { length: number; pixels: number } {
  const unit = units.unitOfBar(most / scale);
  const longest = most / scale / unit;
  const power = 10 ** Math.floor(Math.log10(longest));
  const length = unit * power * ([5, 2, 1].find((step) => step * power <= longest * (1 + 1e-9)) ?? 1);
  return { length, pixels: length * scale };
}
