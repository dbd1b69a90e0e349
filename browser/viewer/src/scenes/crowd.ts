// A recorded crowd: each track is a body while it is present.
import { type Box, type Event, RecordedTracks, World } from "kinesphere";
import type { LiveScene, SceneChoice, Setup } from "./live_scene.ts";
import type { TrackTable } from "./track_table.ts";

/** The begin or the end of a track. */
interface Change {
  time: number;
  body: number;
  comes: boolean;
}

class Crowd implements LiveScene {
  /** `changes` are in order of time; `next` is the index of the next. */
  constructor(readonly world: World, private readonly motion: RecordedTracks, private readonly changes: readonly Change[],
              private next: number) {}

  run(until: number, deliver: (event: Event) => void): void {
    for (let change = this.changes[this.next]; change !== undefined && change.time <= until; change = this.changes[this.next]) {
      this.goTo(change.time, deliver);
      this.change(change);
      this.next += 1;
    }
    this.goTo(until, deliver);
  }
  get presentCount(): number {
    return this.world.bodyViews().filter(({ enabled }) => enabled).length;
  }
  states(): Float64Array {
    const states = this.motion.states(this.world.time);
    for (const { id, enabled } of this.world.bodyViews()) if (!enabled) states.fill(NaN, 6 * id, 6 * id + 6);
    return states;
  }
  positionAt(body: number, time: number): Float64Array | null {
    const { begin, end } = this.motion.span(body);
    return time < begin || time > end ? null : this.motion.states(time, [body]).subarray(0, 3);
  }
  clone(): Crowd {
    return new Crowd(this.world.clone(), this.motion.clone(), this.changes, this.next);
  }
  free(): void {
    this.world.free();
    this.motion.free();
  }

  private goTo(time: number, deliver: (event: Event) => void): void {
    this.world.run(time, { motion: this.motion }, (events) => {
      for (const event of events) deliver(event);
    });
  }
  private change({ time, body, comes }: Change): void {
    if (comes) this.world.enable(body, this.motion.state(body, time));
    else this.world.disable(body);
  }
}

function regionOf(table: TrackTable): Box {
  const lower = [Infinity, Infinity, Infinity];
  const upper = [-Infinity, -Infinity, -Infinity];
  for (const { positions } of table.tracks) {
    for (let at = 0; at < positions.length; ++at) {
      lower[at % 3] = Math.min(lower[at % 3]!, positions[at]!);
      upper[at % 3] = Math.max(upper[at % 3]!, positions[at]!);
    }
  }
  return { lower, upper };
}

/** Returns half of the distance of an approach. For people that is 0.5 m; at larger scales a visible size. */
function radiusIn({ lower, upper }: Box, plane: boolean): number {
  const size = Math.max(...[0, 1, 2].map((axis) => upper[axis]! - lower[axis]!));
  return plane && size < 100 ? 0.25 : size / 200;
}

export function crowd({ bodies }: SceneChoice, table: TrackTable): Setup {
  const tracks = table.tracks.slice(0, bodies);
  const region = regionOf(table);
  const motion = new RecordedTracks(tracks);
  const spans = tracks.map((_, body) => motion.span(body));
  const startTime = spans.reduce((least, { begin }) => Math.min(least, begin), Infinity);
  const endTime = spans.reduce((most, { end }) => Math.max(most, end), -Infinity);
  const world = new World({ dimensions: table.plane ? 2 : 3, startTime });
  const radius = radiusIn(region, table.plane);
  world.addMotion(motion, radius);
  const changes: Change[] = [];
  for (const [body, { begin, end }] of spans.entries()) {
    if (begin > startTime) {
      world.disable(body);
      changes.push({ time: begin, body, comes: true });
    }
    changes.push({ time: end, body, comes: false });
  }
  changes.sort((a, b) => a.time - b.time);
  const distance = `${Number((2 * radius).toPrecision(2))}${table.unit === null ? "" : ` ${table.unit}`}`;
  const about = `As it was recorded. Two that come within ${distance} of each other are reported. Click two for their distance over time.`;
  return {
    title: table.name, about,
    scene: new Crowd(world, motion, changes, 0), radii: new Float64Array(tracks.length).fill(radius), region, endTime,
    names: tracks.map(({ id }) => id), unit: table.unit, ways: tracks,
  };
}
