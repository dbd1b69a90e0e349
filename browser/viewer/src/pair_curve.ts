// The distance of two bodies over time: all of it for bodies that follow recorded ways, else what has been seen of it. Needs no page.
import type { BodyId } from "kinesphere";
import type { DistanceCurve, Spot, SpotLimits } from "./distance_chart.ts";
import { distanceBetween, type ReportedEvent, type Shown } from "./shown.ts";

/** Simulated time between two looks at a pair. */
export const lookInterval = 0.01;
/** Distances that are computed at most of two recorded ways, and looks that are kept at most of others. */
const mostKnown = 20_000;
const mostLooks = 40_000;

/** A look at the two. A contact is where they turn back, so that the distances on both sides do not foretell it. */
interface Look extends Spot {
  isContact: boolean;
}

export class PairCurve implements DistanceCurve {
  /** True if all of it is known from the begin. */
  readonly isKnown: boolean;
  private looks: Look[] = [];
  private seen: SpotLimits[] = [];
  private found: { looks: number; least: Spot | null } | null = null;

  /** Distances are those of centres. Both bodies must exist. */
  constructor(private readonly shown: Shown, readonly first: BodyId, readonly second: BodyId) {
    this.isKnown = shown.ways.length > 0;
    for (const time of this.isKnown ? timesOf(shown, first, second) : []) {
      const distance = shown.distanceAt(first, second, time);
      if (distance !== null) this.looks.push({ time, distance, isContact: false });
    }
  }

  get line(): readonly Spot[] { return this.looks; }
  get limits(): readonly SpotLimits[] { return this.seen; }
  /** The smallest distance so far, or of all times if they are known; null if the two never were there together. */
  get least(): Spot | null {
    if (this.found?.looks !== this.looks.length) this.found = { looks: this.looks.length, least: this.leastLook() };
    return this.found.least;
  }
  /** The distance now; null if one is absent. */
  get now(): Spot | null {
    const { shown, first, second } = this;
    const places = [first, second].map((id) => shown.placeOf(id));
    if (places.includes(null)) return null;
    const positions = shown.positions();
    const [one, other] = places.map((place) => positions.subarray(3 * place!, 3 * place! + 3));
    const distance = distanceBetween(shown, one!, other!);
    return Number.isNaN(distance) ? null : { time: shown.time, distance };
  }

  /** Looks at the two now, and at their contacts among the events. Call it as time goes on. */
  follow(reported: readonly ReportedEvent[]): void {
    const { first, second, shown } = this;
    for (const { event } of reported) {
      if (event.kind !== "contact_begin" || ![event.first, event.second].every((id) => id === first || id === second)) continue;
      this.add({ time: event.time, distance: distanceBetween(shown, event.firstState.position, event.secondState!.position), isContact: true });
    }
    const { now } = this;
    if (now === null) return;
    this.add({ ...now, isContact: false });
    const last = this.seen.at(-1);
    const carried = shown.shapes();
    if ((last !== undefined && now.time <= last.time) || [first, second].some((id) => carried.has(shown.placeOf(id)!))) return;
    // The limits are those of the gap between surfaces of two balls.
    const { view } = shown;
    const { lower, upper } = view.distanceLimits(first, second);
    const radii = view.body(first).radius + view.body(second).radius;
    this.seen.push({ time: now.time, lower: lower + radii, upper: upper + radii });
  }

  /** Forgets what came after a time: a throw has changed it. */
  cutAfter(time: number): void {
    if (this.isKnown) return;
    while (this.looks.length > 0 && this.looks.at(-1)!.time > time) this.looks.pop();
    while (this.seen.length > 0 && this.seen.at(-1)!.time > time) this.seen.pop();
    this.found = null;
  }

  private add(look: Look): void {
    if (this.isKnown) return;
    // Before what was seen, it is seen anew.
    if (look.time < (this.looks[0]?.time ?? -Infinity)) {
      this.looks = [];
      this.seen = [];
      this.found = null;
    }
    // A part that is gone through again is the same.
    if (look.time > (this.looks.at(-1)?.time ?? -Infinity)) this.looks.push(look);
    if (this.looks.length > mostLooks) this.thin();
  }

  /** Drops every other look, but for contacts and the closest. */
  private thin(): void {
    const { least } = this;
    const isNearLeast = ({ time }: Spot) => Math.abs(time - least!.time) <= 2 * lookInterval;
    this.looks = this.looks.filter((look, k) => k % 2 === 0 || look.isContact || isNearLeast(look));
    this.seen = this.seen.filter((_, k) => k % 2 === 0);
    this.found = null;
  }

  private leastLook(): Spot | null {
    let least: Spot | null = null;
    for (let k = 0; k < this.looks.length; ++k) {
      const around = this.looks.slice(Math.max(k - 1, 0), k + 2) as Look[];
      const { time, distance } = around.length === 3 && !around.some(({ isContact }) => isContact) ? vertexOf(around) : this.looks[k]!;
      if (least === null || distance < least.distance) least = { time, distance };
    }
    const { shown, first, second } = this;
    if (!this.isKnown || least === null) return least;
    return leastBetween((time) => shown.distanceAt(first, second, time) ?? Infinity, least, this.looks);
  }
}

/** Returns times at which both ways are looked at: their samples, and the middles between. */
function timesOf({ ways }: Shown, first: BodyId, second: BodyId): number[] {
  const times = [...new Set([first, second].flatMap((id) => Array.from(ways[id]!.times)))].sort((a, b) => a - b);
  const all = times.flatMap((time, k) => (k + 1 < times.length ? [time, (time + times[k + 1]!) / 2] : [time]));
  const each = Math.ceil(all.length / mostKnown);
  return all.filter((_, k) => k % each === 0 || k === all.length - 1);
}

/** Returns the lowest place of the parabola of squared distances through three, if that lies among them, or the middle one: exact for two that go straight on. */
function vertexOf([before, middle, after]: readonly Spot[]): Spot {
  const [b, m, a] = [before!, middle!, after!];
  if (m.distance > b.distance || m.distance > a.distance) return m;
  const slope = (m.distance ** 2 - b.distance ** 2) / (m.time - b.time);
  const bend = ((a.distance ** 2 - m.distance ** 2) / (a.time - m.time) - slope) / (a.time - b.time);
  if (!(bend > 0)) return m;
  const time = Math.min(Math.max((b.time + m.time) / 2 - slope / (2 * bend), b.time), a.time);
  const squared = b.distance ** 2 + slope * (time - b.time) + bend * (time - b.time) * (time - m.time);
  return { time, distance: Math.sqrt(Math.max(squared, 0)) };
}

/** Narrows the smallest distance down between the looks around it. */
function leastBetween(distanceAt: (time: number) => number, { time }: Spot, looks: readonly Spot[]): Spot {
  let from = looks.filter((look) => look.time < time).at(-1)?.time ?? time;
  let to = looks.find((look) => look.time > time)?.time ?? time;
  const golden = (Math.sqrt(5) - 1) / 2;
  for (let k = 0; k < 50; ++k) {
    const [one, other] = [to - golden * (to - from), from + golden * (to - from)];
    if (distanceAt(one) < distanceAt(other)) to = other;
    else from = one;
  }
  const found = (from + to) / 2;
  return { time: found, distance: distanceAt(found) };
}
