// The distances of pairs over time, as far as the page has seen them.
import type { DistanceCurve, Spot, SpotLimits } from "../distance_chart.ts";
import type { DrawnPair, Scene } from "./scene.ts";
import type { WatchState } from "./state.ts";
import { secondsOf } from "./text.ts";

/** Pairs of a state that are remembered, the first of the list, and moments of each. */
const mostPairs = 100;
const mostMoments = 2000;

interface Remembered {
  line: Spot[];
  limits: SpotLimits[];
  least: Spot | null;
}

export class PairHistory {
  private readonly pairs = new Map<string, Remembered>();
  private time = -Infinity;

  /** Adds the moment of a state; a stream that begins again begins a new history. `chosen` is the key of a pair. */
  take({ state, pairs }: Scene, chosen: string | null): void {
    if (state.time === null) return;
    const time = secondsOf(state.time);
    if (time < this.time) this.pairs.clear();
    if (time === this.time) return;
    this.time = time;
    const present = new Set(pairs.map(({ key }) => key));
    for (const key of this.pairs.keys()) if (!present.has(key) && key !== chosen) this.pairs.delete(key);
    for (const [k, drawn] of pairs.entries()) if (k < mostPairs || drawn.key === chosen) this.add(time, drawn, state);
  }

  /** Returns what is remembered of a pair. */
  of(key: string): DistanceCurve | null {
    return this.pairs.get(key) ?? null;
  }

  private add(time: number, drawn: DrawnPair, state: WatchState): void {
    const distance = distanceNow(drawn);
    if (distance === null) return;
    const remembered = this.pairs.get(drawn.key) ?? { line: [], limits: [], least: null };
    this.pairs.set(drawn.key, remembered);
    const { line, limits } = remembered;
    line.push({ time, distance });
    const [lower, upper] = drawn.pair.distance;
    if (measuresPlane(drawn, state)) limits.push({ time, lower: lower ?? 0, upper: upper ?? Infinity });
    if (remembered.least === null || distance < remembered.least.distance) remembered.least = { time, distance };
    for (const each of [line, limits]) if (each.length > mostMoments) each.shift();
  }
}

/** Returns the distance in the plane between the most likely places; null if one is not known. */
export function distanceNow({ places }: DrawnPair): number | null {
  return places === null ? null : Math.hypot(places[1].x - places[0].x, places[1].y - places[0].y);
}

/** Returns false for ellipsoids in space, whose distances are no distances in the plane. */
function measuresPlane({ pair }: DrawnPair, { dimensions, separations }: WatchState): boolean {
  return dimensions !== 3 || separations.find(({ name }) => name === pair.separation)?.shape !== "ellipsoid";
}
