// Ready-made motions, which move bodies inside the module: their states need no call of JavaScript.
import { type Argument, Owned, theModule, type Value } from "./module.js";
import { checkKeys, type Keys, requireNumbers, shown, whole } from "./options.js";
import { bodyAt } from "./records.js";
import { countOf, each, type PerBody, sixes, sixOf, type State, type States, type Vec3, vector } from "./state.js";
import type { World } from "./world.js";

/** The address of a motion that was made in the module. */
export class Made {
  /** @internal */
  constructor(readonly address: number) {}
}

/** Returns the number of a body, or of one that no motion has if it is none. */
export function numberIn(body: number): number {
  return typeof body !== "number" || (Number.isInteger(body) && body >= 0 && body < 2 ** 32) ? body : -1;
}

/**
 * How bodies move. Bodies have the numbers 0, 1, 2, ..., which are their ids in a world to which they were added in
 * this order.
 */
export class Motion extends Owned {
  /** @internal */
  constructor(made: Made) {
    super(made.address, "motion_free");
  }
  /** @internal */
  protected override get kind(): string {
    return "Motion";
  }

  /** An upper limit of the bodies' numbers; not reached itself. */
  get size(): number {
    return theModule().call("motion_size", this.address);
  }
  /** True if the motion has a body of this number. */
  contains(body: number): boolean {
    return body >= 0 && body < this.size && theModule().call("motion_contains", this.address, numberIn(body)) !== 0;
  }
  /**
   * Returns six numbers for each: position and velocity, at `time` or, if the motion does not have the body then, at
   * the nearest time at which it does; NaN for absent bodies. Without `bodies`, for all.
   */
  states(time: number, bodies?: ArrayLike<number>): Float64Array {
    if (bodies !== undefined) requireNumbers(bodies, "bodies", "states");
    const count = bodies?.length ?? this.size;
    const numbers: Argument = bodies === undefined ? 0 : (module) => module.words(Array.from(bodies, numberIn));
    return this.read({ size: 48 * count }, "motion_states", time, count, numbers).numbers;
  }
  /** The state of a body at a time. Throws for an unknown body, and for a time before its last change. */
  state(body: number, time: number): State {
    const numbers = this.states(time, [body]);
    return { position: numbers.subarray(0, 3), velocity: numbers.subarray(3, 6) };
  }
  /** Returns the body's limits and state for a world. */
  definition(body: number, time: number): MotionDefinition {
    const from = this.read(bodyAt, "motion_definition", numberIn(body), time);
    return {
      accelerationLimit: from.number(bodyAt.accelerationLimit),
      plannedAcceleration: from.vector(bodyAt.plannedAcceleration),
      positionError: from.number(bodyAt.positionError),
      velocityError: from.number(bodyAt.velocityError),
      ...from.state(bodyAt.position),
    };
  }
  /** Sets the velocity. Call World.setVelocity as well if a world has the body. */
  setVelocity(body: number, time: number, velocity: Vec3): void {
    this.check("motion_set_velocity", numberIn(body), time, vector(velocity, "velocity", "Motion.setVelocity"));
  }
  /** Sets the state. Call World.teleport as well if a world has the body. */
  teleport(body: number, time: number, state: State): void {
    this.check("motion_teleport", numberIn(body), time, sixOf(state, "Motion.teleport"));
  }
  /** Removes the body. The next added body takes its number. */
  remove(body: number): void {
    this.check("motion_remove", numberIn(body));
  }
  /** Adds a body that moves on from there; returns its number. Bodies that fly freely ignore the limit. */
  add(time: number, state: State, accelerationLimit = 0, orientation: ArrayLike<number> = [1, 0, 0, 0]): number {
    const call = "Motion.add";
    const numbers = sixOf(state, call);
    const [count, turned] = rotationArguments(orientation, call);
    if (count !== 1) throw new TypeError(`${call}: orientation must be four numbers w, x, y, z`);
    return this.word("motion_add", time, numbers, accelerationLimit, turned);
  }
  /** Returns an independent copy. */
  clone(): this {
    const kind = this.constructor as new (made: Made) => this;
    return new kind(new Made(theModule().call("motion_clone", this.address)));
  }
}

/** What a motion promises of a body, and its state at a time. */
export interface MotionDefinition extends State {
  accelerationLimit: number;
  plannedAcceleration: Vec3;
  positionError: number;
  velocityError: number;
}

/** The start of bodies with limited acceleration. */
export interface LimitedMotion {
  /** >= 0 (length / time^2): the largest acceleration. */
  accelerationLimits: PerBody;
  startTime?: number;
}

const limitedKeys: Keys<LimitedMotion> = { accelerationLimits: true, startTime: "number" };

/** Makes the motion of bodies with limits by the function of this name; `more` are its last arguments. */
function limited<Options extends LimitedMotion>(name: string, call: string, start: States, options: Options,
                                                keys: Keys<Options>, ...more: number[]): Made {
  checkKeys(options, keys, "options", call);
  const numbers = sixes(start, call);
  const count = numbers.length / 6;
  const limits = each(options.accelerationLimits, count, "accelerationLimits", call);
  return new Made(theModule().word(name, count, numbers, limits, ...more, options.startTime ?? 0));
}

/** The bodies of a Ballistic motion, and their gravity. */
export interface BallisticOptions {
  /** Length / time^2. */
  gravity?: Vec3;
  startTime?: number;
}

/** Bodies that fly freely under a common gravity. */
export class Ballistic extends Motion {
  constructor(start: States, options?: BallisticOptions);
  /** @internal */
  constructor(made: Made);
  constructor(start: States | Made, options: BallisticOptions = {}) {
    super(start instanceof Made ? start : flying(start, options));
  }
}

const ballisticKeys: Keys<BallisticOptions> = { gravity: true, startTime: "number" };

function flying(start: States, options: BallisticOptions): Made {
  const call = "Ballistic";
  checkKeys(options, ballisticKeys, "options", call);
  const numbers = sixes(start, call);
  const gravity = vector(options.gravity ?? [0, 0, 0], "gravity", call);
  return new Made(theModule().word("motion_ballistic", numbers.length / 6, numbers, gravity, options.startTime ?? 0));
}

export interface RandomForcesOptions extends LimitedMotion {
  /** > 0 (time): how long each force lasts; by default 0.2. */
  interval?: number;
  seed?: number;
}

const forcesKeys: Keys<RandomForcesOptions> = { ...limitedKeys, interval: "number", seed: "number" };

/** Bodies pushed around by random forces that change at fixed times. */
export class RandomForces extends Motion {
  constructor(start: States, options: RandomForcesOptions);
  /** @internal */
  constructor(made: Made);
  constructor(start: States | Made, options?: RandomForcesOptions) {
    super(start instanceof Made ? start
      : limited("motion_random_forces", "RandomForces", start, options!, forcesKeys, options?.interval ?? 0.2,
                whole(options?.seed ?? 1, 2 ** 53, "seed", "RandomForces")));
  }
}

/** Bodies steered by hand: each keeps its acceleration, at first zero, until it is steered again. */
export class SteeredMotion extends Motion {
  constructor(start: States, options: LimitedMotion);
  /** @internal */
  constructor(made: Made);
  constructor(start: States | Made, options?: LimitedMotion) {
    super(start instanceof Made ? start : limited("motion_steered", "SteeredMotion", start, options!, limitedKeys));
  }
  /** Sets the acceleration from `time` on, within the body's limit. Needs no call of the world. */
  steer(body: number, time: number, acceleration: Vec3): void {
    this.check("motion_steer", numberIn(body), time, vector(acceleration, "acceleration", "steer"));
  }
}

/** Frame 0 of a FrameMotion, and what its bodies promise. */
export interface FrameMotionOptions {
  /**
   * >= 0 (length / time^2), gravity included; infinite (the default) for bodies without a limit, whose velocities are
   * news at every frame. See `FrameMotion` in kinesphere/motion/frame_motion.hpp.
   */
  accelerationLimits?: PerBody;
  startTime?: number;
  /**
   * > 0 (time): from one frame to the next, where frames have no times of their own; by default 1 / 60. Bodies with a
   * limit cost least if no frame is longer.
   */
  interval?: number;
  /** >= 0 (length): the largest error of the game's positions. */
  positionError?: number;
  /**
   * Orientations of rigid bodies in frame 0: four numbers w, x, y, z for each body. Without them the frames do not say
   * how bodies turn.
   */
  rotations?: ArrayLike<number>;
}

const frameKeys: Keys<FrameMotionOptions> = {
  ...limitedKeys, interval: "number", positionError: "number", rotations: true,
};

/** Makes a FrameMotion in the module. */
function framed(start: States, options: FrameMotionOptions): Made {
  const call = "FrameMotion";
  checkKeys(options, frameKeys, "options", call);
  const numbers = sixes(start, call);
  const count = numbers.length / 6;
  const limits = each(options.accelerationLimits ?? Infinity, count, "accelerationLimits", call);
  return new Made(theModule().word(
    "motion_frames", count, numbers, limits, options.interval ?? 1 / 60, options.positionError ?? 0,
    ...rotationArguments(options.rotations, call), options.startTime ?? 0));
}

/** Returns the number of rotations and these, or 0 without any. */
function rotationArguments(rotations: ArrayLike<number> | undefined, call: string): [count: number, rotations: Argument] {
  if (rotations === undefined) return [0, 0];
  requireNumbers(rotations, "rotations", call);
  if (rotations.length % 4 !== 0)
    throw new RangeError(`${call}: rotations must have four numbers w, x, y, z for each body, but has ${rotations.length}`);
  return [rotations.length / 4, rotations];
}

/** Returns the last arguments of a push: a time, or 0 without one, and rotations. */
export function timeAndRotations(
  time: number | undefined, rotations: ArrayLike<number> | undefined, call: string,
): [time: Argument, count: number, rotations: Argument] {
  return [time === undefined ? 0 : [time], ...rotationArguments(rotations, call)];
}

/** A position with which a body violated its limit; see `FrameViolation` in kinesphere/motion/frame_motion.hpp. */
export interface FrameViolation {
  body: number;
  /** > 0 (length): how far the position lies beyond the places that the limit allows. */
  excess: number;
  /** (length / time^2): the limit that would have allowed it. */
  acceleration: number;
  /** Velocity of the body in the pushed frame. */
  velocity: Float64Array;
}

/**
 * The motion of a game that moves its bodies in steps: straight lines between its last two frames, so the world is one
 * frame late. Frames may have any lengths.
 *
 *     const frames = new FrameMotion({ positions });
 *     world.addMotion(frames, radii);
 *     // each frame, after the game has moved its bodies:
 *     time += dt;
 *     frames.push(world, positions, time);
 *     for (const event of world.events(frames.latestTime, frames)) ...
 *     positions.set(frames.latest());  // includes changes at events
 *
 * To change a velocity at an event, call frames.setVelocity(body, event.time, velocity) and
 * world.setVelocity(body, velocity).
 */
export class FrameMotion extends Motion {
  constructor(start: States, options?: FrameMotionOptions);
  /** @internal */
  constructor(made: Made);
  constructor(start: States | Made, options: FrameMotionOptions = {}) {
    super(start instanceof Made ? start : framed(start, options));
  }
  /**
   * Adds the next frame: three numbers for each body, NaN for a removed one. The world, in which the bodies' ids are
   * their numbers here, learns all new velocities, so that no contact is missed; its time must be latestTime. `time`
   * must be later than that; without it the frame comes `interval` after the latest one, so give it where frames differ
   * in length. `rotations` has four numbers w, x, y, z for each body, if the motion was made with rotations. Without a
   * world, all bodies must have limits and keep them.
   */
  push(world: World, positions: ArrayLike<number>, time?: number, rotations?: ArrayLike<number>): void;
  /** Appends the next frame, without a world. */
  push(positions: ArrayLike<number>, time?: number): void;
  push(
    first: World | ArrayLike<number>, second?: ArrayLike<number> | number, third?: number, rotations?: ArrayLike<number>,
  ): void {
    const call = "push";
    const isAlone = second === undefined || typeof second === "number";
    const world: Value = isAlone ? 0n : Owned.addressOf(first as World, "World", "world", call);
    const positions = isAlone ? (first as ArrayLike<number>) : second;
    const time = isAlone ? second : third;
    const count = countOf(positions, call);
    this.check("frames_push", world, count, positions, ...timeAndRotations(time, rotations, call));
  }
  /**
   * Adds a body that moves on from there, by default without a limit; returns its number. `orientation` counts in a
   * motion with rotations.
   */
  override add(
    time: number, state: State, accelerationLimit = Infinity, orientation: ArrayLike<number> = [1, 0, 0, 0],
  ): number {
    return super.add(time, state, accelerationLimit, orientation);
  }
  /** Returns three numbers for each body: its position at latestTime, including changes since the push; NaN if removed. */
  latest(): Float64Array {
    return this.frame().subarray(2);
  }
  /** Returns four numbers w, x, y, z for each body: its orientation at latestTime; none without rotations. */
  latestRotations(): Float64Array {
    return this.told("frames_latest_rotations");
  }
  /** Time of the last frame but one: states are known from here to latestTime. */
  get previousTime(): number {
    return this.frame()[0]!;
  }
  get latestTime(): number {
    return this.frame()[1]!;
  }
  /** Bodies that violated their limits in the latest frame. The world has been informed of them. */
  violations(): FrameViolation[] {
    const numbers = this.told("frames_violations");
    return Array.from({ length: numbers.length / 6 }, (_, k) => {
      const [body, excess, acceleration] = numbers.subarray(6 * k, 6 * k + 3);
      return { body: body!, excess: excess!, acceleration: acceleration!, velocity: numbers.subarray(6 * k + 3, 6 * k + 6) };
    });
  }
  private frame(): Float64Array {
    return this.told("frames_latest");
  }
}

/** The samples of one body in order of time: at least two. */
export interface Track {
  times: ArrayLike<number>;
  /** Three numbers for each sample. */
  positions: ArrayLike<number>;
}

/**
 * Motion along recorded tracks: the smoothest curve through the samples of each body, a natural cubic spline. Before
 * its first sample and after its last a body goes straight on. It accepts no other velocities.
 */
export class RecordedTracks extends Motion {
  constructor(tracks: readonly Track[]);
  /** @internal */
  constructor(made: Made);
  constructor(tracks: readonly Track[] | Made) {
    super(tracks instanceof Made ? tracks : alongTracks(tracks));
  }
  /** Returns the times of the body's first and last sample. */
  span(body: number): { begin: number; end: number } {
    const [begin, end] = this.told("tracks_span", numberIn(body));
    return { begin: begin!, end: end! };
  }
}

function alongTracks(tracks: readonly Track[]): Made {
  const samples: number[] = [];
  if (!Array.isArray(tracks))
    throw new TypeError(`RecordedTracks: tracks must be an array of objects with times and positions, but is ${shown(tracks)}`);
  for (const [body, { times, positions }] of (tracks as readonly Track[]).entries()) {
    if (typeof times?.length !== "number" || typeof positions?.length !== "number")
      throw new TypeError(`RecordedTracks: body ${body} must have arrays of times and positions`);
    requireNumbers(times, `times of body ${body}`, "RecordedTracks");
    requireNumbers(positions, `positions of body ${body}`, "RecordedTracks");
    if (positions.length !== 3 * times.length)
      throw new RangeError(`RecordedTracks: positions of body ${body} must have three numbers for each of ` +
                           `${times.length} times, but has ${positions.length}`);
    for (let k = 0; k < times.length; ++k)
      samples.push(times[k]!, positions[3 * k]!, positions[3 * k + 1]!, positions[3 * k + 2]!);
  }
  return new Made(theModule().word("motion_tracks", tracks.length, tracks.map(({ times }) => times.length), samples));
}
