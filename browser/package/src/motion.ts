// Ready-made motions, which move bodies inside the module: nothing of JavaScript is called for their states.
import type { State, Vec3 } from "./event.js";
import { Owned, theModule } from "./module.js";

/** States of many bodies: three numbers of each in `positions`, and in `velocities` where they move. */
export interface States {
  positions: ArrayLike<number>;
  velocities?: ArrayLike<number>;
}

/** One number for all, or one of each. */
export type PerBody = number | ArrayLike<number>;

export function countOf(positions: ArrayLike<number>, call: string): number {
  if (positions.length % 3 !== 0)
    throw new RangeError(`${call}: positions must have three numbers for each body, but has ${positions.length}`);
  return positions.length / 3;
}

export function each(values: PerBody, count: number, what: string, call: string): ArrayLike<number> {
  if (typeof values === "number") return new Float64Array(count).fill(values);
  if (values.length !== count)
    throw new RangeError(`${call}: ${what} must have a number for each of ${count} bodies, but has ${values.length}`);
  return values;
}

export function vector(values: Vec3, what: string, call: string): [number, number, number] {
  if (values.length !== 3)
    throw new RangeError(`${call}: ${what} must have three numbers, but has ${values.length}`);
  return [values[0]!, values[1]!, values[2]!];
}

function sixes(states: States, call: string): Float64Array {
  const count = countOf(states.positions, call);
  const { positions, velocities } = states;
  if (velocities !== undefined && velocities.length !== positions.length)
    throw new RangeError(
      `${call}: velocities must have as many numbers as positions, ${positions.length}, but has ${velocities.length}`);
  const numbers = new Float64Array(6 * count);
  for (let k = 0; k < count; ++k) {
    for (let axis = 0; axis < 3; ++axis) {
      numbers[6 * k + axis] = positions[3 * k + axis]!;
      numbers[6 * k + 3 + axis] = velocities?.[3 * k + axis] ?? 0;
    }
  }
  return numbers;
}

export function sixOf(state: State, call: string): number[] {
  return [...vector(state.position, "position", call), ...vector(state.velocity, "velocity", call)];
}

/** How bodies move. Bodies are named by their numbers 0, 1, 2, ..., which are their ids in a world to which they were added in this order. */
export class Motion extends Owned {
  /** @internal */
  constructor(address: number) {
    super(address, "motion_free");
  }

  /** All bodies have smaller numbers than this. */
  get size(): number {
    return theModule().call("motion_size", this.address);
  }
  contains(body: number): boolean {
    return body >= 0 && body < this.size && theModule().call("motion_contains", this.address, body) !== 0;
  }
  /**
   * Six numbers for each: position and velocity, at `time` or when the body was last changed if that was later;
   * NaN for bodies that are not there. Of all bodies when none are named.
   */
  states(time: number, bodies?: ArrayLike<number>): Float64Array {
    const module = theModule();
    const count = bodies?.length ?? this.size;
    return module.with((scratch) => {
      const numbers = bodies === undefined ? 0 : scratch.numbers(bodies);
      const states = scratch.room(6 * count);
      module.call("motion_states", this.address, time, count, numbers, states);
      return module.numbersAt(states, 6 * count).slice();
    });
  }
  state(body: number, time: number): State {
    const numbers = this.states(time, [body]);
    return { position: numbers.subarray(0, 3), velocity: numbers.subarray(3, 6) };
  }
  /** What a world has to know of the body: its promise and its state. */
  definition(body: number, time: number): MotionDefinition {
    const module = theModule();
    return module.with((scratch) => {
      const room = scratch.room(12);
      module.require(module.call("motion_definition", this.address, body, time, room));
      const numbers = module.numbersAt(room, 12).slice();
      return {
        accelerationLimit: numbers[0]!,
        plannedAcceleration: numbers.subarray(1, 4),
        positionError: numbers[4]!,
        velocityError: numbers[5]!,
        position: numbers.subarray(6, 9),
        velocity: numbers.subarray(9, 12),
      };
    });
  }
  /** The world that watches the body has to be told as well: World.setVelocity. */
  setVelocity(body: number, time: number, velocity: Vec3): void {
    const numbers = vector(velocity, "velocity", "Motion.setVelocity");
    const module = theModule();
    module.with((scratch) =>
      module.require(module.call("motion_set_velocity", this.address, body, time, scratch.numbers(numbers))));
  }
  /** As setVelocity(): World.teleport. */
  teleport(body: number, time: number, state: State): void {
    const numbers = sixOf(state, "Motion.teleport");
    const module = theModule();
    module.with((scratch) =>
      module.require(module.call("motion_teleport", this.address, body, time, scratch.numbers(numbers))));
  }
  /** The next body that is added takes its number. */
  remove(body: number): void {
    const module = theModule();
    module.require(module.call("motion_remove", this.address, body));
  }
  /** A body that moves on from there; returns its number. The limit does not count for bodies that fly freely. */
  add(time: number, state: State, accelerationLimit = 0): number {
    const numbers = sixOf(state, "Motion.add");
    const module = theModule();
    const body = module.with((scratch) =>
      module.call("motion_add", this.address, time, scratch.numbers(numbers), accelerationLimit));
    if (body < 0) throw module.error();
    return body;
  }
  /** A copy that goes its own way. */
  clone(): Motion {
    return new Motion(theModule().call("motion_clone", this.address));
  }
}

export interface MotionDefinition extends State {
  accelerationLimit: number;
  plannedAcceleration: Vec3;
  positionError: number;
  velocityError: number;
}

/** Bodies that fly freely under a common gravity. */
export class Ballistic extends Motion {
  constructor(start: States, options: { gravity?: Vec3; startTime?: number } = {}) {
    const call = "Ballistic";
    const numbers = sixes(start, call);
    const gravity = vector(options.gravity ?? [0, 0, 0], "gravity", call);
    const module = theModule();
    super(module.with((scratch) =>
      module.require(module.call("motion_ballistic", numbers.length / 6, scratch.numbers(numbers),
                                 scratch.numbers(gravity), options.startTime ?? 0))));
  }
}

/** Bodies pushed around by random forces that change at fixed times. */
export class RandomForces extends Motion {
  constructor(start: States, options: { accelerationLimits: PerBody; interval?: number; seed?: number; startTime?: number }) {
    const call = "RandomForces";
    const numbers = sixes(start, call);
    const count = numbers.length / 6;
    const limits = each(options.accelerationLimits, count, "accelerationLimits", call);
    const module = theModule();
    super(module.with((scratch) =>
      module.require(module.call("motion_random_forces", count, scratch.numbers(numbers), scratch.numbers(limits),
                                 options.interval ?? 0.2, options.seed ?? 1, options.startTime ?? 0))));
  }
}

/** Bodies steered by hand: each keeps its acceleration, at first zero, until it is steered again. */
export class Steered extends Motion {
  constructor(start: States, options: { accelerationLimits: PerBody; startTime?: number }) {
    const call = "Steered";
    const numbers = sixes(start, call);
    const count = numbers.length / 6;
    const limits = each(options.accelerationLimits, count, "accelerationLimits", call);
    const module = theModule();
    super(module.with((scratch) =>
      module.require(module.call("motion_steered", count, scratch.numbers(numbers), scratch.numbers(limits),
                                 options.startTime ?? 0))));
  }
  /** The acceleration from `time` on, no longer than the body's limit. The world need not hear of it. */
  steer(body: number, time: number, acceleration: Vec3): void {
    const numbers = vector(acceleration, "acceleration", "steer");
    const module = theModule();
    module.with((scratch) =>
      module.require(module.call("motion_steer", this.address, body, time, scratch.numbers(numbers))));
  }
}
