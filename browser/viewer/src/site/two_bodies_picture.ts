// The two bodies at a moment, and the curve of their gap.
import type { FlatPicture } from "../flat_picture.ts";
import type { Ink } from "../inks.ts";
import { type Life, lifeEnd, type Moment, radius, type Sample } from "./two_bodies_life.ts";

export const planeExtent = { left: -8, right: 8, bottom: -2.7, top: 2.7 };
export const chartExtent = { left: -0.35, right: lifeEnd + 0.25, bottom: -2.2, top: 11.5 };
const inks: readonly Ink[] = ["body", "other"];
/** Seconds after a probe in which it shows. */
const probeShown = 0.08;

export function drawPlane(picture: FlatPicture, { bodies, time, gap, certain, touching }: Moment): void {
  picture.begin();
  const { left, bottom, right, top } = picture.extent;
  picture.rectangle(left, bottom, right, top, { fill: "paper" });
  for (const [body, { region, regionEnd }] of bodies.entries()) {
    if (!Number.isFinite(regionEnd)) continue;
    picture.rectangle(...region, { stroke: inks[body]!, dash: [7, 6], width: 1.5 });
  }
  for (const [body, { centre, boundRadius }] of bodies.entries()) {
    picture.disc(...centre, boundRadius, { fill: inks[body]!, opacity: 0.16 });
    picture.disc(...centre, boundRadius, { stroke: inks[body]!, width: 2 });
  }
  for (const [body, { place, reportTime }] of bodies.entries()) {
    picture.disc(...place, radius, { fill: inks[body]! });
    picture.text(place[0], place[1] - 0.12, "AB"[body]!, { fill: "paper", align: "center" });
    if (time - reportTime < probeShown) picture.ring(...place, 18, { stroke: "probe", width: 5, opacity: 1 - (time - reportTime) / probeShown });
  }
  const [a, b] = bodies;
  if (gap > 0.3) drawGap(picture, a!.place, b!.place, certain);
  if (touching) picture.ring((a!.place[0] + b!.place[0]) / 2, (a!.place[1] + b!.place[1]) / 2, 12, { stroke: "contact", width: 4 });
}

/** A line across the gap, with what is certain of it. */
function drawGap(picture: FlatPicture, from: readonly [number, number], to: readonly [number, number], certain: number): void {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const along = (way: number): [number, number] =>
    [from[0] + (way * (to[0] - from[0])) / length, from[1] + (way * (to[1] - from[1])) / length];
  picture.line([along(radius), along(length - radius)], { stroke: "quiet", width: 1.5 });
  const middle = along(length / 2);
  picture.text(middle[0], picture.extent.bottom + 0.35, `certainly ${certain.toFixed(2)} apart`, { fill: "sure", stroke: "paper", align: "center" });
}

export function drawChart(picture: FlatPicture, { samples, steps }: Life, moment: Moment): void {
  picture.begin();
  const { extent } = picture;
  picture.rectangle(extent.left, extent.bottom, extent.right, extent.top, { fill: "paper" });
  for (const gap of [0, 5, 10]) {
    picture.line([[0, gap], [lifeEnd, gap]], { stroke: "frame", width: 1, opacity: gap === 0 ? 1 : 0.35 });
    picture.text(-0.06, gap - 0.35, `${gap}`, { fill: "quiet", align: "right" });
  }
  for (let second = 0; second <= lifeEnd; ++second) picture.text(second, -1.7, `${second} s`, { fill: "quiet", align: "center" });
  for (const part of partsOf(samples, steps.filter(({ kind }) => kind === "probe").map(({ time }) => time))) {
    picture.line([[part[0]![0], 0], ...part, [part.at(-1)![0], 0]], { fill: "sure", opacity: 0.16 });
    picture.line(part, { stroke: "sure", width: 2 });
  }
  picture.line(samples.map(({ time, gap }) => [time, Math.max(gap, 0)]), { stroke: "ink", width: 2, dash: [6, 5] });
  for (const { time, kind } of steps) {
    const sample = samples[Math.min(Math.round(time * 100), samples.length - 1)]!;
    if (kind === "probe") picture.ring(time, Math.max(sample.gap, 0), 4, { fill: "probe", stroke: "quiet", width: 1 });
    else if (kind === "violation") picture.cross(time, Math.max(sample.gap, 0), 7, { stroke: "missed", width: 3 });
    else picture.ring(time, 0, 8, { stroke: "contact", width: 3 });
  }
  picture.line([[moment.time, -0.9], [moment.time, extent.top]], { stroke: "ink", width: 2 });
  if (moment.due <= lifeEnd) drawDue(picture, moment);
}

/** How far it is from now to the time at which the pair is looked at again. */
function drawDue(picture: FlatPicture, { time, due }: Moment): void {
  const height = picture.extent.top - 1;
  picture.line([[due, 0], [due, height]], { stroke: "quiet", width: 1.5, dash: [3, 5] });
  picture.line([[time, height], [due, height]], { stroke: "quiet", width: 1.5 });
  const right = due > 0.8 * lifeEnd;
  picture.text(right ? due - 0.04 : due + 0.04, height - 0.8, `due ${due.toFixed(3)} s`, { fill: "quiet", stroke: "paper", align: right ? "right" : "left" });
}

/** Returns the curve of what is certain, in parts that end at probes, where it jumps. */
function partsOf(samples: readonly Sample[], probes: readonly number[]): [number, number][][] {
  const parts: [number, number][][] = [];
  let next = 0;
  let part: [number, number][] = [];
  for (const { time, certain } of samples) {
    if (next < probes.length && probes[next]! <= time) {
      if (part.length > 0) parts.push(part);
      part = [];
      while (next < probes.length && probes[next]! <= time) ++next;
    }
    part.push([time, certain]);
  }
  if (part.length > 0) parts.push(part);
  return parts;
}
