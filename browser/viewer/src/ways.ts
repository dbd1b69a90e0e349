// The ways of recorded bodies: faint wherever they have been, brighter where they were lately.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, type Scene } from "three";
import type { Palette } from "./colours.ts";
import { Lines } from "./lines.ts";
import type { Shown } from "./shown.ts";

/** Lines that are kept at most; of longer recordings some samples are left out. */
const mostLines = 2_000_000;
/** What is lately, as a part of all of the time. */
const latePart = 0.08;
const [faint, strong] = [0.22, 0.75];

export class Ways {
  private readonly past = waysOf(faint);
  private readonly late = waysOf(strong);
  /** From the last sample of each present body to where it is. */
  private readonly ends = new Lines(strong);
  /** The ways of chosen bodies. */
  private readonly chosen = new Lines(1);
  /** Times at which the lines end, in order. */
  private lineEnds = new Float64Array(0);
  /** For each body the place of its last sample that has passed. */
  private passed = new Int32Array(0);
  private lateTime = 0;

  constructor(scene: Scene) {
    scene.add(this.past, this.late, this.ends.object, this.chosen.object);
  }

  show({ ways, firstTime, endTime }: Shown): void {
    this.lateTime = latePart * (endTime - firstTime);
    this.passed = new Int32Array(ways.length);
    const all = ways.reduce((sum, { times }) => sum + times.length, 0);
    const each = Math.ceil(all / mostLines);
    const lines: { body: number; from: number; to: number }[] = [];
    for (const [body, { times }] of ways.entries())
      for (let from = 0; from + 1 < times.length; from += each) lines.push({ body, from, to: Math.min(from + each, times.length - 1) });
    lines.sort((a, b) => ways[a.body]!.times[a.to]! - ways[b.body]!.times[b.to]!);
    this.lineEnds = Float64Array.from(lines, ({ body, to }) => ways[body]!.times[to]!);
    const points = new Float32Array(6 * lines.length);
    for (const [k, { body, from, to }] of lines.entries())
      for (const [end, sample] of [from, to].entries())
        for (let axis = 0; axis < 3; ++axis) points[6 * k + 3 * end + axis] = ways[body]!.positions[3 * sample + axis]!;
    const attribute = new BufferAttribute(points, 3);
    for (const object of [this.past, this.late]) {
      object.geometry.dispose();
      object.geometry = new BufferGeometry().setAttribute("position", attribute);
    }
  }

  /** `chosen` are places of bodies whose ways are marked, visible or not. */
  update({ ways, time }: Shown, positions: Float64Array, visible: boolean, chosen: readonly number[], palette: Palette): void {
    this.past.visible = this.late.visible = visible && ways.length > 0;
    const last = countUpTo(this.lineEnds, time);
    const first = countUpTo(this.lineEnds, time - this.lateTime);
    this.past.geometry.setDrawRange(0, 2 * last);
    this.late.geometry.setDrawRange(2 * first, 2 * (last - first));
    this.past.material.color = this.late.material.color = palette.trail;
    for (const [body, { times }] of ways.entries()) {
      while (this.passed[body]! + 1 < times.length && times[this.passed[body]! + 1]! <= time) this.passed[body]! += 1;
      while (this.passed[body]! > 0 && times[this.passed[body]!]! > time) this.passed[body]! -= 1;
    }
    const sample = (lines: Lines, body: number, k: number, colour: Palette["trail"]) => {
      const at = ways[body]!.positions;
      lines.point(at[3 * k]!, at[3 * k + 1]!, at[3 * k + 2]!, colour);
    };
    const end = (lines: Lines, body: number, colour: Palette["trail"]) => {
      if (Number.isNaN(positions[3 * body]!)) return;
      sample(lines, body, this.passed[body]!, colour);
      lines.point(positions[3 * body]!, positions[3 * body + 1]!, positions[3 * body + 2]!, colour);
    };
    this.ends.begin(visible ? ways.length : 0);
    if (visible) for (const body of ways.keys()) end(this.ends, body, palette.trail);
    this.ends.end();
    const marked = chosen.filter((body) => body < ways.length);
    this.chosen.begin(marked.reduce((sum, body) => sum + this.passed[body]! + 1, 0));
    for (const body of marked) {
      for (let k = 0; k < this.passed[body]!; ++k) {
        sample(this.chosen, body, k, palette.held);
        sample(this.chosen, body, k + 1, palette.held);
      }
      end(this.chosen, body, palette.held);
    }
    this.chosen.end();
  }
}

function waysOf(opacity: number): LineSegments<BufferGeometry, LineBasicMaterial> {
  const made = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity, depthWrite: false }));
  made.frustumCulled = false;
  return made;
}

/** Returns how many of the ordered times are not later than `time`. */
function countUpTo(times: Float64Array, time: number): number {
  let [from, to] = [0, times.length];
  while (from < to) {
    const middle = (from + to) >> 1;
    if (times[middle]! <= time) from = middle + 1;
    else to = middle;
  }
  return from;
}
