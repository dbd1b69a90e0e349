// The chosen pair: who it is, and its distance over time.
import type { BodyId } from "kinesphere";
import { DistanceChart } from "./distance_chart.ts";
import { inksOf } from "./inks.ts";
import { digits } from "./numbers.ts";
import { lookInterval, PairCurve } from "./pair_curve.ts";
import type { ReportedEvent, Shown } from "./shown.ts";

const element = <E extends HTMLElement>(id: string): E => document.querySelector<E>(`#${id}`)!;

export class Pair {
  /** None, one, which waits for another one, or two. */
  ids: readonly BodyId[] = [];
  private curve: PairCurve | null = null;
  private shown: Shown | null = null;
  private readonly panel = element("pair");
  private readonly chart = new DistanceChart(element<HTMLCanvasElement>("pair-chart"));

  /** `goTo` shows a time; `changed` is called when the panel appears or goes. */
  constructor(goTo: (time: number) => void, private readonly changed: () => void) {
    this.chart.canvas.addEventListener("click", ({ clientX }) => {
      const { shown } = this;
      if (shown !== null) goTo(Math.min(Math.max(this.chart.timeAt(clientX), shown.firstTime), this.span[1]));
    });
    element("pair-least").addEventListener("click", () => {
      const least = this.curve?.least;
      if (least != null) goTo(least.time);
    });
    element("pair-close").addEventListener("click", () => this.choose([]));
  }

  /** Looks at another scene; the pair stays chosen if both are there. */
  show(shown: Shown): void {
    this.shown = shown;
    this.choose(this.ids.every((id) => shown.placeOf(id) !== null) ? this.ids : []);
  }

  /** Chooses bodies that exist, at most two different ones. */
  choose(ids: readonly BodyId[]): void {
    this.ids = ids;
    this.curve = ids.length === 2 ? new PairCurve(this.shown!, ids[0]!, ids[1]!) : null;
    this.panel.hidden = ids.length === 0;
    this.follow([]);
    this.update();
    this.changed();
  }

  /** Chooses one more, or leaves one out; a third begins another pair. */
  toggle(id: BodyId): void {
    if (this.ids.includes(id)) this.choose(this.ids.filter((each) => each !== id));
    else this.choose(this.ids.length === 1 ? [this.ids[0]!, id] : [id]);
  }

  /** Chooses the two that are nearest to each other now. */
  chooseNearest(): void {
    const { shown } = this;
    if (shown === null) return;
    const found = nearestOf(shown);
    if (found !== null) this.choose(found.map((place) => shown.idOf(place)));
  }

  /** Places of the chosen in the picture. */
  get places(): number[] {
    return this.ids.map((id) => this.shown!.placeOf(id)).filter((place) => place !== null);
  }

  /** Lets the scene run, with looks at the pair on the way if its course is not known. */
  run(shown: Shown, until: number, deadline: number): ReportedEvent[] {
    if (this.curve === null || this.curve.isKnown) {
      const reported = shown.run(until, deadline);
      this.follow(reported);
      return reported;
    }
    const all: ReportedEvent[] = [];
    for (let time = -Infinity; shown.time < until && shown.time > time && performance.now() < deadline;) {
      time = shown.time;
      const reported = shown.run(Math.min(until, time + lookInterval));
      this.follow(reported);
      all.push(...reported);
    }
    return all;
  }

  /** Call it with events that run() has not had. */
  follow(reported: readonly ReportedEvent[]): void {
    this.curve?.follow(reported);
  }

  /** The course after now is another one, since a body was thrown. */
  forgetFuture(): void {
    if (this.shown !== null) this.curve?.cutAfter(this.shown.time);
  }

  repaint(): void {
    this.chart.inks = inksOf(this.panel);
    this.update();
  }

  update(): void {
    const { shown, curve, ids } = this;
    if (shown === null || ids.length === 0) return;
    const names = ids.map((id) => shown.nameOf(id));
    element("pair-title").textContent = names.join(" – ");
    this.chart.canvas.hidden = curve === null;
    const { now = null, least = null } = curve ?? {};
    const lengthOf = (length: number) => `${digits(length, 3)}${shown.unit === null ? "" : ` ${shown.unit}`}`;
    const timeOf = (time: number) => `${Number(time.toFixed(3))} s`;
    const limits = curve?.limits.at(-1);
    const [lower, upper] = [Math.max(limits?.lower ?? 0, 0), limits?.upper ?? 0].map((limit) => digits(limit, 3));
    const certain = limits === undefined || limits.time !== now?.time || lower === upper ? "" : `, certainly ${lower} to ${lengthOf(limits.upper)}`;
    element("pair-now").textContent = curve === null ? "Choose another one for the distance of the two over time."
      : now !== null ? `Distance of the centres now: ${lengthOf(now.distance)}${certain}`
      : least === null ? "The two are never there together." : "The two are not there together now.";
    const button = element("pair-least");
    button.hidden = least === null;
    if (curve === null || least === null) return void (this.chart.canvas.hidden = true);
    button.textContent = `${curve.isKnown ? "closest" : "closest so far"}: ${lengthOf(least.distance)} at ${timeOf(least.time)}`;
    this.chart.canvas.setAttribute("aria-label", `Distance of ${names.join(" and ")} over time; ${button.textContent}`);
    const touch = this.touchDistance();
    this.chart.draw(curve, { span: this.span, now, lines: touch === null ? [] : [{ distance: touch, words: shown.ways.length > 0 ? `reported within ${lengthOf(touch)}` : "contact" }] },
                    { length: lengthOf, time: timeOf });
  }

  /** Times of both ends of the chart. */
  private get span(): readonly [number, number] {
    const { line } = this.curve!;
    return [line[0]!.time, Math.max(line.at(-1)!.time, this.curve!.isKnown ? -Infinity : this.shown!.time)];
  }

  /** The distance of centres at a contact; null if that is not one for all directions. */
  private touchDistance(): number | null {
    const { shown, places } = this;
    const carried = shown!.shapes();
    if (places.length < 2 || places.some((place) => carried.has(place))) return null;
    const radii = shown!.radii();
    return radii[places[0]!]! + radii[places[1]!]!;
  }
}

/** Returns the places of the two present bodies with the smallest gap; null if there are less than two. */
function nearestOf(shown: Shown): [number, number] | null {
  const positions = shown.positions();
  const radii = shown.radii();
  const present = Array.from(radii.keys()).filter((place) => !Number.isNaN(positions[3 * place]!));
  // In the order of x, so that few are compared.
  present.sort((a, b) => positions[3 * a]! - positions[3 * b]!);
  const largest = radii.reduce((most, radius) => Math.max(most, radius), 0);
  let found: [number, number] | null = null;
  let least = Infinity;
  for (const [k, one] of present.entries()) {
    for (const other of present.slice(k + 1)) {
      const [dx, dy, dz] = [0, 1, 2].map((axis) => positions[3 * other + axis]! - positions[3 * one + axis]!);
      if (dx! - 2 * largest > least) break;
      const gap = Math.hypot(dx!, dy!, dz!) - radii[one]! - radii[other]!;
      if (gap < least) [least, found] = [gap, [one, other]];
    }
  }
  return found;
}
