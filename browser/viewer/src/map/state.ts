// The content of /state.json of `kinesphere watch --serve` (docs/watch.md).

/** A number, or a text with a date, as in the stream. */
export type StreamTime = number | string;

export interface Place {
  /** Place in the plane of the watch. For latitudes and longitudes: metres east and north of the origin. */
  x: number;
  y: number;
  z: number;
  lon?: number;
  lat?: number;
  alt?: number;
  velocity: [number, number, number];
  /** Horizontal and vertical; null without a limit. */
  radius: [number | null, number | null];
}

export interface Track {
  id: string;
  /** Callsign or ship's name; null if none came. */
  name: string | null;
  stamp: StreamTime | null;
  stale: boolean;
  /** The track certainly is in one of these. */
  places: Place[];
}

export type Verdict = "apart" | "undecided" | "within";

export interface Pair {
  first: string;
  second: string;
  separation: string;
  level: number;
  verdict: Verdict;
  since: StreamTime | null;
  distance: [number | null, number | null];
  until: StreamTime | null;
  closest_distance: number | null;
  closest_time: StreamTime | null;
  likely_time: StreamTime | null;
  ask: string;
  ask_by: StreamTime | null;
}

/** Without a report of `track` by then a verdict of the two turns undecided. */
export interface Need {
  track: string;
  by: StreamTime | null;
  other: string;
}

export interface Separation {
  name: string;
  shape: "ellipsoid" | "cylinder" | "well_clear";
  horizontal: number;
  vertical: number;
}

export interface WatchState {
  /** Null before the first report. */
  time: StreamTime | null;
  stream: string;
  /** readsb, sbs, opensky, ais, nmea, csv or jsonl. */
  format: string;
  /** The track whose pairs are the only ones; null if all are watched. */
  own: string | null;
  geographic: boolean | null;
  dimensions: 2 | 3 | null;
  origin: { lon: number; lat: number; radius: number } | null;
  silence: number | null;
  forget: number | null;
  separations: Separation[];
  counts: Record<string, number>;
  tracks: Track[];
  /** The pairs that are not certainly apart. */
  pairs: Pair[];
  /** The predicted pairs, which may be certainly apart now. */
  predictions: Pair[];
  needed: Need[];
}
