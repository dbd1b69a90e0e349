// A state, with its tracks, places and pairs linked.
import type { Need, Pair, Place, Track, WatchState } from "./state.ts";
import { secondsOf, shownName } from "./text.ts";

/** What a track or a pair is drawn as: the worst that is known of it. */
export type Concern = "undecided" | "predicted" | "within";
const concerns: readonly Concern[] = ["undecided", "predicted", "within"];

export interface DrawnTrack {
  track: Track;
  /** Its callsign or name, else its id, for display. */
  label: string;
  /** The worst of its pairs. */
  concern: Concern | null;
  need: Need | null;
}

/** The closest approach of two that go straight on. */
export interface Approach {
  /** Time to go. Unit: seconds. */
  seconds: number;
  /** Where the two are then: x, y, z. */
  places: readonly [Spot, Spot];
  /** Distance in the plane, then. */
  distance: number;
  /**
   * How far off that is for the bounds of the two places now: the sum of both. Courses and speeds may be off, too. Null
   * without a bound.
   */
  error: number | null;
  /** How much higher the other one is then; null if that is not known. */
  above: number | null;
}
export type Spot = Pick<Place, "x" | "y" | "z">;

export interface DrawnPair {
  key: string;
  pair: Pair;
  concern: Concern;
  isPredicted: boolean;
  /** The two ids: the own track first, if it is one of them. */
  ids: readonly [string, string];
  /** The possible places of the two that are nearest to each other; null if a track was dropped. */
  places: readonly [Place, Place] | null;
  /** How much higher the other one is, and how fast that grows; null in two dimensions, or if it is not known. */
  above: { difference: number; rate: number } | null;
  /** Null if they part. */
  approach: Approach | null;
}

export interface Scene {
  state: WatchState;
  tracks: Map<string, DrawnTrack>;
  /** Open and predicted pairs: those within, then by the times of their closest approaches, then those that part. */
  pairs: DrawnPair[];
  needs: Need[];
}

export const pairKey = ({ first, second, level }: Pair): string => JSON.stringify([first, second, level]);

/** Returns the name of a track for display. */
export const labelOf = (scene: Scene, id: string): string => scene.tracks.get(id)?.label ?? shownName(id);

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

const spotAfter = ({ x, y, z, velocity }: Place, seconds: number): Spot =>
  ({ x: x + velocity[0] * seconds, y: y + velocity[1] * seconds, z: z + velocity[2] * seconds });

/** Returns false for a track of which no height came: its bound is that of all heights. */
export const knowsHeight = ({ radius: [, vertical] }: Place, { dimensions, geographic }: WatchState): boolean =>
  dimensions === 3 && vertical !== null && vertical < (geographic === true ? 15e3 : 1e8);

/** Returns how much higher the other one is; none if that is nothing beside the bounds. */
function heightAbove(one: Spot, other: Spot, places: readonly [Place, Place]): number {
  const above = other.z - one.z;
  return Math.abs(above) < 0.01 * ((places[0].radius[1] ?? 0) + (places[1].radius[1] ?? 0)) ? 0 : above;
}

function approachOf({ closest_time }: Pair, [one, other]: readonly [Place, Place], { time }: WatchState, hasHeights: boolean): Approach | null {
  if (closest_time === null || time === null) return null;
  const seconds = secondsOf(closest_time) - secondsOf(time);
  if (!(seconds > 0.05)) return null;
  const places = [spotAfter(one, seconds), spotAfter(other, seconds)] as const;
  const [bound, otherBound] = [one.radius[0], other.radius[0]];
  return {
    seconds, places, distance: Math.hypot(places[1].x - places[0].x, places[1].y - places[0].y),
    error: bound === null || otherBound === null ? null : bound + otherBound,
    above: hasHeights ? heightAbove(...places, [one, other]) : null,
  };
}

/** Returns the pairs of a state; one that is both open and predicted is there once. */
function pairsOf(state: WatchState, tracks: Map<string, DrawnTrack>): DrawnPair[] {
  const predicted = new Set(state.predictions.map(pairKey));
  const all = new Map([...state.predictions, ...state.pairs].map((pair) => [pairKey(pair), pair]));
  return [...all].map(([key, pair]) => {
    const ids = pair.second === state.own ? [pair.second, pair.first] as const : [pair.first, pair.second] as const;
    const [one, other] = ids.map((id) => tracks.get(id)?.track);
    const places = one === undefined || other === undefined ? null : nearestPlaces(one, other);
    const isPredicted = predicted.has(key);
    const hasHeights = places !== null && places.every((place) => knowsHeight(place, state));
    return {
      key, pair, ids, places, isPredicted,
      above: hasHeights ? { difference: heightAbove(...places, places), rate: places[1].velocity[2] - places[0].velocity[2] } : null,
      concern: pair.verdict === "within" ? "within" : isPredicted ? "predicted" : "undecided",
      approach: places === null ? null : approachOf(pair, places, state, hasHeights),
    };
  });
}

const isUrgent = ({ concern, approach }: DrawnPair): boolean => concern === "within" || approach !== null;

/** Those that part, and are not certainly within, come last. */
export function compareByTime(a: DrawnPair, b: DrawnPair): number {
  return Number(isUrgent(b)) - Number(isUrgent(a)) || Number(b.concern === "within") - Number(a.concern === "within") ||
    (a.approach?.seconds ?? 0) - (b.approach?.seconds ?? 0) || compareByDistance(a, b);
}
export function compareByDistance(a: DrawnPair, b: DrawnPair): number {
  return (a.pair.closest_distance ?? Infinity) - (b.pair.closest_distance ?? Infinity) || (a.key < b.key ? -1 : 1);
}

export function sceneOf(state: WatchState): Scene {
  const tracks = new Map<string, DrawnTrack>(state.tracks.map((track) =>
    [track.id, { track, label: shownName(track.name ?? track.id), concern: null, need: null }]));
  for (const need of state.needed) {
    const drawn = tracks.get(need.track);
    if (drawn !== undefined) drawn.need ??= need;
  }
  const pairs = pairsOf(state, tracks).sort(compareByTime);
  for (const { ids, concern } of pairs) {
    for (const id of ids) {
      const drawn = tracks.get(id);
      if (drawn !== undefined && concerns.indexOf(concern) > (drawn.concern === null ? -1 : concerns.indexOf(drawn.concern))) drawn.concern = concern;
    }
  }
  return { state, tracks, pairs, needs: state.needed };
}

export interface Bounds {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** Returns the bounds of the centres of places; null if there are none. */
export function boundsOf(places: Iterable<Spot>): Bounds | null {
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
