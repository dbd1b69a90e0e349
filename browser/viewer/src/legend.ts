// What the colours of the picture mean.
import type { Color } from "three";
import type { Palette } from "./colours.ts";
import type { Settings } from "./settings.ts";
import { countsMissed, type Shown } from "./shown.ts";

/** Forms that are drawn as lines. */
const drawings = {
  ring: '<circle cx="12" cy="12" r="8"/>',
  crossedRing: '<circle cx="12" cy="12" r="9"/><path d="m8 8 8 8m0-8-8 8"/>',
  square: '<path d="M6 6h12v12H6z"/>',
} as const;

interface Entry {
  /** A form of one colour, as it is in the picture, or a row of colours. */
  kind: "dot" | "line" | "row" | keyof typeof drawings;
  colours: readonly Color[];
  words: string;
}

const colourings: Record<Settings["colouring"], string> = {
  size: "small to large", asked: "asked just now to long ago", safe: "safe for 1 ms to 1 s",
};

function entries(shown: Shown, { overlays: on, colouring }: Settings, palette: Palette): Entry[] {
  const dot = (colour: Color, words: string): Entry => ({ kind: "dot", colours: [colour], words });
  const line = (colour: Color, words: string): Entry => ({ kind: "line", colours: [colour], words });
  const drawn = (kind: keyof typeof drawings, colour: Color, words: string): Entry => ({ kind, colours: [colour], words });
  const found: Entry[] = [];
  if (on.contacts && shown.alarms === null) found.push(drawn("ring", palette.contact, "contact"));
  if ((on.contacts || on.evidence) && countsMissed(shown)) found.push(drawn("crossedRing", palette.missed, "contact that 60 Hz misses"));
  if (shown.alarms !== null) found.push(line(palette.contact, "warning"), line(palette.missed, "alarm"));
  if (on.trails && shown.trails.length > 0) found.push(line(palette.trail, "trail"), drawn("square", palette.look, "where 60 Hz looks"));
  if (on.trails && shown.ways.length > 0) found.push(line(palette.trail, "way so far"));
  if (on.probes) found.push(dot(palette.probe, "asked just now"));
  if (on.bounds) found.push(dot(palette.zone, "bound"));
  if (on.certificates) found.push({ kind: "row", colours: palette.times, words: "certificate for 1 ms to 1 s" });
  if (shown.zone !== null) found.push(dot(palette.zone, "zone"));
  if (colouring !== "size") found.push({ kind: "row", colours: palette.times, words: colourings[colouring] });
  else if (haveSizes(shown.radii()) && !on.evidence) found.push({ kind: "row", colours: palette.sizes, words: colourings.size });
  return found;
}

/** False if all are of one size; then colours only tell them apart. */
function haveSizes(radii: Float64Array): boolean {
  return radii.some((radius) => Math.abs(radius - radii[0]!) > 1e-3 * radii[0]!);
}

export class Legend {
  private readonly list = document.querySelector<HTMLElement>("#legend")!;
  private shownWords = "";

  update(shown: Shown, settings: Settings, palette: Palette): void {
    const wanted = entries(shown, settings, palette);
    const words = JSON.stringify(wanted.map(({ words, colours }) => [words, colours[0]!.getHex()]));
    if (words === this.shownWords) return;
    this.shownWords = words;
    this.list.replaceChildren(...wanted.map(({ kind, colours, words }) => {
      const item = document.createElement("li");
      const sample = document.createElement("i");
      sample.className = kind;
      const names = colours.map((colour) => `#${colour.getHexString()}`);
      if (kind in drawings) sample.innerHTML = `<svg viewBox="0 0 24 24" stroke="${names[0]!}">${drawings[kind as keyof typeof drawings]}</svg>`;
      else sample.style.background = names.length === 1 ? names[0]! : `linear-gradient(90deg, ${names.join(", ")})`;
      item.append(sample, words);
      return item;
    }));
  }
}
