// Colours of bodies, and of the page's two themes.
import type { BodyView } from "kinesphere";
import { Color } from "three";
import type { Shown } from "./shown.ts";

export interface Palette {
  background: Color;
  line: Color;
  wall: Color;
  probe: Color;
  contact: Color;
  missed: Color;
  held: Color;
  /** Spheres beneath the marks of missed contacts. */
  grey: Color;
  zone: Color;
  trail: Color;
  /** Where a loop looks at a fast body. */
  look: Color;
  /** Colours from the smallest to the largest. */
  sizes: readonly Color[];
  /** Colours from now to long ago, or from soon to far off. */
  times: readonly Color[];
  light: number;
}

const colours = (...names: string[]) => names.map((name) => new Color(name));

export const dark: Palette = {
  background: new Color("#0a0f1c"),
  line: new Color("#7f93bd"),
  wall: new Color("#5f7bc4"),
  probe: new Color("#eaf6ff"),
  contact: new Color("#ffc46b"),
  missed: new Color("#ff4256"),
  held: new Color("#ffffff"),
  grey: new Color("#7d8798"),
  zone: new Color("#3ddbd0"),
  trail: new Color("#a5c8ff"),
  look: new Color("#c8f7c5"),
  sizes: colours("#ffd479", "#f58a5e", "#d95b8b", "#8a62d8", "#4079e0"),
  times: colours("#ff5a4e", "#ffb04f", "#5fc9a8", "#3f7fd0", "#3a4874"),
  light: 1,
};

export const bright: Palette = {
  background: new Color("#eef2f8"),
  line: new Color("#5b6c92"),
  wall: new Color("#7a90c8"),
  probe: new Color("#0d2a5c"),
  contact: new Color("#e08a00"),
  missed: new Color("#e00025"),
  held: new Color("#101828"),
  grey: new Color("#aab3c2"),
  zone: new Color("#009f98"),
  trail: new Color("#3f78d8"),
  look: new Color("#0b6b2e"),
  sizes: colours("#f0b429", "#ee7445", "#d24480", "#7c4fd0", "#2f68d8"),
  times: colours("#e2382c", "#ee9a2b", "#45b392", "#4a8ad8", "#a9b6d3"),
  light: 1.2,
};

/** Sets `colour` to the place in the row of colours, from 0 to 1. */
export function along(row: readonly Color[], place: number, colour: Color): Color {
  const at = Math.min(Math.max(place, 0), 1) * (row.length - 1);
  const below = Math.min(Math.floor(at), row.length - 2);
  return colour.copy(row[below]!).lerp(row[below + 1]!, at - below);
}

/** 0 for a millisecond or less, 1 for a second or more. */
export function placeOfDuration(seconds: number): number {
  return Math.log10(Math.max(seconds, 1e-3) / 1e-3) / 3;
}

/** Returns a number for each body from 0 to 1: smallest to largest; equal radii differ by their numbers. */
export function placesOfSizes(radii: Float64Array): Float64Array {
  let least = Infinity;
  let most = 0;
  for (const radius of radii) {
    least = Math.min(least, radius);
    most = Math.max(most, radius);
  }
  if (most <= least * 1.001) return radii.map((_, k) => (k * 0.618034) % 1);
  return radii.map((radius) => (radius - least) / (most - least));
}

/** Returns for each body how long it certainly touches no other: a lower bound that costs little. */
export function safeDurations(shown: Shown, views: readonly BodyView[]): Float64Array {
  const { time } = shown.view;
  const places = new Map(views.map((view, k) => [view.id, k]));
  const durations = Float64Array.from(views, (view) => view.boxEnd - time);
  const certificates = shown.view.certificates();
  for (let at = 0; at < certificates.length; at += 3) {
    for (const id of [certificates[at]!, certificates[at + 1]!]) {
      const place = places.get(id);
      if (place !== undefined) durations[place] = Math.min(durations[place]!, certificates[at + 2]! - time);
    }
  }
  return durations;
}
