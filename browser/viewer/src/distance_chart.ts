// The picture of the distance of two over time: its line, a band of what is certain, its smallest value, and now.
import { FlatPicture } from "./flat_picture.ts";
import type { Inks } from "./inks.ts";

/** A distance at a time. */
export interface Spot {
  time: number;
  distance: number;
}

/** What is certain of a distance at a time. */
export interface SpotLimits {
  time: number;
  lower: number;
  /** Infinite if nothing is. */
  upper: number;
}

/** The distance of two over time, in order of time. */
export interface DistanceCurve {
  line: readonly Spot[];
  limits: readonly SpotLimits[];
  least: Spot | null;
}

/** What is drawn beside the curve. */
export interface ChartMarks {
  /** Times of both ends of the picture. */
  span: readonly [number, number];
  now: Spot | null;
  /** Distances with a meaning. */
  lines: readonly { distance: number; words: string }[];
  /** A closest approach that is expected, and how far its distance is off at most, if that is known. */
  expected?: (Spot & { error: number | null }) | null;
}

/** How lengths and times are written. */
export interface ChartWords {
  length(length: number): string;
  /** The unit in which lengths up to one are round; 1 without it. */
  unitOf?(longest: number): number;
  time(time: number): string;
}

/** Pixels beside the axes: for numbers on the left and below, and for half of a mark. */
const margins = { left: 56, right: 12, top: 12, bottom: 22 };

export class DistanceChart {
  private readonly picture: FlatPicture;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.picture = new FlatPicture(canvas, { left: 0, right: 1, bottom: 0, top: 1 }, true);
    this.picture.font = "12px system-ui, sans-serif";
  }

  set inks(inks: Inks) {
    this.picture.inks = inks;
  }

  /** Returns the time at a place of the page, as far as the picture reaches. */
  timeAt(x: number): number {
    const { left, right } = this.picture.extent;
    const box = this.canvas.getBoundingClientRect();
    return left + ((x - box.left) / box.width) * (right - left);
  }

  draw({ line, limits, least }: DistanceCurve, { span: [from, to], now, lines, expected = null }: ChartMarks, words: ChartWords): void {
    const { picture, canvas: { clientWidth, clientHeight } } = this;
    if (picture.inks === null || clientWidth === 0) return;
    const marked = [...line, ...(now === null ? [] : [now]), ...(expected === null ? [] : [expected]), ...lines];
    const highest = marked.reduce((most, { distance }) => Math.max(most, distance), 0) || 1;
    // Times and distances that a pixel stands for.
    const alongX = Math.max(to - from, 1e-9) / Math.max(clientWidth - margins.left - margins.right, 1);
    const alongY = highest / Math.max(clientHeight - margins.top - margins.bottom, 1);
    picture.extent = { left: from - margins.left * alongX, right: Math.max(to, from + 1e-9) + margins.right * alongX,
                       bottom: -margins.bottom * alongY, top: highest + margins.top * alongY };
    picture.begin();
    const unit = words.unitOf?.(highest) ?? 1;
    const step = unit * roundStep(highest / unit / 5);
    for (let k = 0; k * step <= highest; ++k) {
      picture.line([[from, k * step], [to, k * step]], { stroke: "frame", width: 1 });
      picture.text(from - 6 * alongX, k * step - 4 * alongY, words.length(k * step), { fill: "quiet", align: "right" });
    }
    picture.text(from, -17 * alongY, words.time(from), { fill: "quiet" });
    picture.text(to, -17 * alongY, words.time(to), { fill: "quiet", align: "right" });
    for (const { distance } of lines) picture.line([[from, distance], [to, distance]], { stroke: "contact", width: 1.5, dash: [5, 4] });
    const top = picture.extent.top;
    const band = thinned(limits.map(({ time, lower, upper }) => ({ time, values: [Math.max(lower, 0), Math.min(upper, top)] })), alongX);
    if (band.length > 1) {
      const edge = (k: 0 | 1) => band.map(({ time, values }) => [time, values[k]!] as const);
      picture.line([...edge(1), ...edge(0).reverse()], { fill: "sure", opacity: 0.25 });
    }
    picture.line(thinned(line.map(({ time, distance }) => ({ time, values: [distance] })), alongX).map(({ time, values }) => [time, values[0]!]),
                 { stroke: "ink", width: 1.8 });
    if (expected !== null) {
      const { time, distance, error } = expected;
      if (now !== null) picture.line([[now.time, now.distance], [time, distance]], { stroke: "quiet", width: 1.5, dash: [2, 5] });
      if (error !== null) picture.line([[time, Math.max(distance - error, 0)], [time, Math.min(distance + error, top)]], { stroke: "quiet", width: 1.5 });
      picture.square(time, distance, 8, { fill: "paper", stroke: "contact", width: 2 });
    }
    if (now !== null) {
      picture.line([[now.time, 0], [now.time, top]], { stroke: "quiet", width: 1 });
      picture.ring(now.time, now.distance, 3.5, { fill: "ink" });
    }
    // On the side where the curve is farther away.
    const isOnLeft = least !== null && least.time > (from + to) / 2;
    for (const { distance, words: name } of lines)
      picture.text(isOnLeft ? from : to, distance + 5 * alongY, name, { fill: "quiet", align: isOnLeft ? "left" : "right" });
    if (least !== null) picture.ring(least.time, least.distance, 6, { stroke: "contact", width: 2.5 });
  }
}

/** Returns the smallest round number, 1, 2 or 5 with zeros, that is not below `least`. */
function roundStep(least: number): number {
  const decade = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * decade).find((step) => step >= least * (1 - 1e-9))!;
}

/** Keeps of each pixel along time the rows with the smallest and the largest values, and both ends. */
function thinned<Row extends { time: number; values: number[] }>(rows: readonly Row[], pixel: number): readonly Row[] {
  if (rows.length < 3 || (rows.at(-1)!.time - rows[0]!.time) / pixel > rows.length / 2) return rows;
  const kept = new Set([0, rows.length - 1]);
  let begin = 0;
  for (let k = 1; k <= rows.length; ++k) {
    if (k < rows.length && rows[k]!.time < rows[begin]!.time + pixel) continue;
    for (const column of rows[0]!.values.keys()) {
      let [least, most] = [begin, begin];
      for (let at = begin; at < k; ++at) {
        if (rows[at]!.values[column]! < rows[least]!.values[column]!) least = at;
        if (rows[at]!.values[column]! > rows[most]!.values[column]!) most = at;
      }
      kept.add(least).add(most);
    }
    begin = k;
  }
  return [...kept].sort((a, b) => a - b).map((k) => rows[k]!);
}
