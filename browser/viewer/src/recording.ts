// A recording for display: bodies are drawn at the centres of their bounds, since nothing else is recorded.
import { type BodyId, type BodyView, type Box, type BusyBody, EventHash, Replay, type WorldView } from "kinesphere";
import { type CarriedShapes, carriedShapes, type Orientations, orientationsAt } from "./carried_shapes.ts";
import { isMissedByLoop } from "./missed.ts";
import { emptyTally, RecentRate, type Shown, type Tally, type ReportedEvent, wrapInto } from "./shown.ts";

export class Recording implements Shown {
  readonly about = "A recording, gone through again. Bodies are drawn in the middle of their bounds. R leads back to the scene.";
  readonly region = null;
  readonly zone = null;
  readonly trails = [];
  readonly ways = [];
  readonly unit = null;
  readonly alarms = null;
  readonly near = [];
  readonly box: Box | null;
  readonly periodic: readonly boolean[];
  private replay: Replay;
  private events = new EventHash();
  private counts = emptyTally();
  private rate = new RecentRate();
  private shownTime = 0;
  readonly firstTime: number;
  private carried: CarriedShapes = new Map();
  /** The ids of the moving bodies whose shapes are known. */
  private carriers = "";

  /** Throws KinesphereError for bytes that are no recording. */
  constructor(readonly title: string, private readonly bytes: Uint8Array) {
    this.replay = new Replay(bytes);
    const { box, periodic } = this.replay.world.definition;
    this.box = box ?? null;
    this.periodic = [periodic.x === true, periodic.y === true, periodic.z === true];
    this.firstTime = this.begin();
  }

  get time(): number { return this.shownTime; }
  get endTime(): number { return this.replay.finished ? this.replay.world.time : Infinity; }
  get view(): WorldView { return this.replay.world; }
  get tally(): Tally { return this.counts; }
  get hash(): string { return this.events.value; }
  get probesPerSecond(): number { return this.rate.value; }
  get bodyCount(): number { return this.replay.world.size; }

  /** The world of a replay is not profiled. */
  busiest(): BusyBody[] {
    return [];
  }
  idOf(place: number): BodyId {
    return this.views()[place]!.id;
  }
  placeOf(id: BodyId): number | null {
    const place = this.views().findIndex((view) => view.id === id);
    return place < 0 ? null : place;
  }
  nameOf(id: BodyId): string {
    return `${id}`;
  }
  distanceAt(): null {
    return null;
  }
  radii(): Float64Array {
    return Float64Array.from(this.views(), (view) => view.radius);
  }
  shapes(): CarriedShapes {
    const views = this.views();
    const carriers = views.map(({ id }) => id).join(" ");
    if (carriers !== this.carriers) {
      this.carriers = carriers;
      this.carried = carriedShapes(this.replay.world, views);
    }
    return this.carried;
  }
  orientations(): Orientations {
    return this.shapes().size === 0 ? new Map() : orientationsAt(this.shownTime, this.replay.world, this.views());
  }
  positions(): Float64Array {
    const views = this.views();
    const positions = new Float64Array(3 * views.length);
    // The world stands at the end of a recorded step, possibly a little later than the shown time.
    const early = this.replay.world.time - this.shownTime;
    views.forEach(({ centre, reported }, k) => {
      for (let axis = 0; axis < 3; ++axis) positions[3 * k + axis] = centre[axis]! - early * reported.velocity[axis]!;
    });
    return wrapInto(positions, this.box, this.periodic);
  }
  views(): BodyView[] {
    return this.replay.world.bodyViews().filter((view) => !view.isStatic);
  }

  run(until: number, deadline = Infinity): ReportedEvent[] {
    const reported: ReportedEvent[] = [];
    while (!this.replay.finished && this.replay.world.time < until && performance.now() <= deadline) this.step(reported);
    this.shownTime = Math.min(until, this.replay.world.time);
    return reported;
  }

  nextEvent(): ReportedEvent[] {
    const reported: ReportedEvent[] = [];
    while (!this.replay.finished && reported.length === 0) this.step(reported);
    this.shownTime = this.replay.world.time;
    return reported;
  }

  back(seconds: number): void {
    const target = Math.max(this.shownTime - seconds, this.firstTime);
    this.rewind();
    this.run(target);
  }
  /** Goes back to the begin: a recording has no other moments. */
  rewind(): void {
    this.replay.free();
    this.replay = new Replay(this.bytes);
    this.events = new EventHash();
    this.counts = emptyTally();
    this.rate.clear();
    this.begin();
  }

  free(): void {
    this.replay.free();
  }

  /** Goes through the first steps, which add bodies. */
  private begin(): number {
    while (!this.replay.finished && this.replay.world.size === 0) this.step([]);
    return this.shownTime = this.replay.world.time;
  }

  private step(reported: ReportedEvent[]): void {
    const event = this.replay.advance();
    const { world } = this.replay;
    this.rate.add(world.time, world.counters.probes);
    if (event === null) return;
    this.events.add(event);
    let missed = false;
    if (event.kind === "contact_begin") {
      const [first, second] = world.bodyViews([event.first, event.second!]);
      const isOfBalls = [first!, second!].every(({ id }) => "ball" in world.shapeOf(id));
      missed = isOfBalls && isMissedByLoop(event, first!.radius + second!.radius);
      this.counts.contacts += 1;
      if (missed) this.counts.missed += 1;
    } else if (event.kind === "wall_begin") {
      this.counts.wallContacts += 1;
    } else if (event.kind === "bound_violation") {
      this.counts.violations += 1;
    }
    reported.push({ event, missed });
  }
}
