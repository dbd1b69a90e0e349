// A state, with its tracks, places and pairs linked.
import type { Need, OpenVerdict, Pair, Place, StreamTime, Track, WatchState } from "./state.ts";
import { secondsOf } from "./text.ts";

export interface DrawnTrack {
  track: Track;
  /** The worst verdict of its pairs. */
  verdict: OpenVerdict | null;
  need: Need | null;
}

export interface DrawnPair {
  key: string;
  pair: Pair;
  /** The two possible places that are nearest to each other; null if a track was dropped. */
  places: readonly [Place, Place] | null;
}

export interface Scene {
  state: WatchState;
  tracks: Map<string, DrawnTrack>;
  /** Pairs within before undecided ones; of the latter, the soonest likely ones first. */
  pairs: DrawnPair[];
  needs: Need[];
}

export const pairKey = ({ first, second, level }: Pair): string => JSON.stringify([first, second, level]);

function nearestPlaces(a: Track, b: Track): readonly [Place, Place] | null {
  let nearest: readonly [Place, Place] | null = null;
  let least = Infinity;
  for (const one of a.places) {
    for (const other of b.places) {
      const distance = Math.hypot(one.x - other.x, one.y - other.y);
      if (distance >= least) continue;
      least = distance;
      nearest = [one, other];
    }
  }
  return nearest;
}

/** Null means never, and comes last. */
function compareTimes(a: StreamTime | null, b: StreamTime | null): number {
  if (a === null || b === null) return Number(a === null) - Number(b === null);
  return secondsOf(a) - secondsOf(b);
}

export function sceneOf(state: WatchState): Scene {
  const tracks = new Map<string, DrawnTrack>(state.tracks.map((track) => [track.id, { track, verdict: null, need: null }]));
  for (const need of state.needed) {
    const drawn = tracks.get(need.track);
    if (drawn !== undefined) drawn.need ??= need;
  }
  const pairs = state.pairs.map((pair): DrawnPair => {
    const first = tracks.get(pair.first);
    const second = tracks.get(pair.second);
    for (const drawn of [first, second])
      if (drawn !== undefined && drawn.verdict !== "within") drawn.verdict = pair.verdict;
    const places = first === undefined || second === undefined ? null : nearestPlaces(first.track, second.track);
    return { key: pairKey(pair), pair, places };
  });
  pairs.sort(({ pair: a }, { pair: b }) =>
    Number(b.verdict === "within") - Number(a.verdict === "within") || compareTimes(a.likely_time, b.likely_time) ||
    compareTimes(a.since, b.since));
  return { state, tracks, pairs, needs: state.needed };
}

export interface Bounds {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** Returns the bounds of the centres of places; null if there are none. */
export function boundsOf(places: Iterable<Place>): Bounds | null {
  const bounds = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const { x, y } of places) {
    bounds.left = Math.min(bounds.left, x);
    bounds.right = Math.max(bounds.right, x);
    bounds.bottom = Math.min(bounds.bottom, y);
    bounds.top = Math.max(bounds.top, y);
  }
  return bounds.left <= bounds.right ? bounds : null;
}

export function* placesOf(tracks: Iterable<DrawnTrack | undefined>): Iterable<Place> {
  for (const drawn of tracks) yield* drawn?.track.places ?? [];
}
