// The life of a pair: two bodies that weave towards each other, what a world knows of them, and when it asks.
import { type BodyId, type Event, type ProbeFunction, World } from "kinesphere";

export const radius = 0.6;
/** Seconds that the lesson lasts. */
export const lifeEnd = 5;
/** Seconds between two samples of what is certain. */
const sampleInterval = 0.01;

/** Goes along x at a speed and weaves across it. */
interface Course {
  x: number;
  speed: number;
  height: number;
  turn: number;
  phase: number;
}

const courses: readonly Course[] = [
  { x: -6, speed: 1.5, height: 0.8, turn: 0.8, phase: 0 },
  { x: 6, speed: -1.5, height: 0.6, turn: 0.7, phase: 2 },
];
/** The largest acceleration that each of them has in truth. */
export const trueAccelerations = courses.map(({ height, turn }) => height * turn * turn);

function stateAt({ x, speed, height, turn, phase }: Course, time: number): number[] {
  const angle = turn * time + phase;
  return [x + speed * time, height * Math.sin(angle), 0, speed, height * turn * Math.cos(angle), 0];
}

export interface Step {
  time: number;
  kind: "probe" | "begin" | "end" | "violation";
  /** The body that was asked, or that broke its promise; null for contacts. */
  body: BodyId | null;
}

export interface Sample {
  time: number;
  /** The gap of the two surfaces, and what is certainly left of it. */
  gap: number;
  certain: number;
}

export interface Life {
  /** What happens, in order of time. */
  steps: readonly Step[];
  samples: readonly Sample[];
}

export interface Known {
  /** Where it is in truth. */
  place: readonly [number, number];
  centre: readonly [number, number];
  boundRadius: number;
  reportTime: number;
  /** Lower and upper corner of the safe region, in which it certainly stays until its end. */
  region: readonly [number, number, number, number];
  regionEnd: number;
}

export interface Moment extends Sample {
  bodies: readonly Known[];
  /** When the world looks at the pair again. */
  due: number;
  touching: boolean;
  probes: number;
}

const kinds: Partial<Record<Event["kind"], Step["kind"]>> = {
  contact_begin: "begin", contact_end: "end", bound_violation: "violation",
};

/** A world with the two bodies, and what has happened in it. */
class Pair {
  readonly steps: Step[] = [];
  private readonly world = new World({ dimensions: 2 });
  private readonly probe: ProbeFunction = (ids, time, states) => {
    for (let k = 0; k < ids.length; ++k) {
      states.set(stateAt(courses[ids[k]!]!, time), 6 * k);
      this.steps.push({ time, kind: "probe", body: ids[k]! });
    }
  };

  constructor(accelerationLimit: number) {
    for (const course of courses) {
      const [x, y, , vx, vy] = stateAt(course, 0) as [number, number, number, number, number];
      this.world.add({ position: [x, y, 0], velocity: [vx, vy, 0], radius, accelerationLimit });
    }
  }

  goTo(time: number): void {
    for (const event of this.world.events(time, this.probe)) {
      const kind = kinds[event.kind];
      if (kind !== undefined) this.steps.push({ time: event.time, kind, body: kind === "violation" ? event.first : null });
    }
  }

  sample(): Sample {
    const { time } = this.world;
    const [first, second] = courses.map((course) => stateAt(course, time));
    const gap = distance(first!, second!) - 2 * radius;
    const [a, b] = this.world.bodyViews();
    return { time, gap, certain: Math.max(distance(a!.centre, b!.centre) - a!.boundRadius - b!.boundRadius, 0) };
  }

  moment(): Moment {
    const views = this.world.bodyViews();
    const bodies = views.map(({ id, centre, boundRadius, reportTime, box, boxEnd }): Known => {
      const [x, y] = stateAt(courses[id]!, this.world.time) as [number, number];
      return { place: [x, y], centre: [centre[0]!, centre[1]!], boundRadius, reportTime,
               region: [box.lower[0]!, box.lower[1]!, box.upper[0]!, box.upper[1]!], regionEnd: boxEnd };
    });
    const certificates = this.world.certificates();
    let due = Math.min(...bodies.map(({ regionEnd }) => regionEnd));
    for (let at = 2; at < certificates.length; at += 3) due = Math.min(due, certificates[at]!);
    const touching = this.world.touching(views[0]!.id).length > 0;
    return { ...this.sample(), bodies, due, touching, probes: this.steps.filter(({ kind }) => kind === "probe").length };
  }

  free(): void {
    this.world.free();
  }
}

function distance(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!);
}

/** Returns all that happens if both promise this limit of their acceleration. */
export function lifeOf(limit: number): Life {
  const pair = new Pair(limit);
  const samples: Sample[] = [];
  for (let k = 0; k * sampleInterval <= lifeEnd; ++k) {
    pair.goTo(k * sampleInterval);
    samples.push(pair.sample());
  }
  pair.free();
  return { steps: pair.steps, samples };
}

/** Returns what is known at a time. */
export function momentOf(limit: number, time: number): Moment {
  const pair = new Pair(limit);
  pair.goTo(time);
  const moment = pair.moment();
  pair.free();
  return moment;
}
