// A running scene: a world, a motion of its bodies, and responses to its events.
import type { BodyId, Box, Event, Motion, RunOptions, Track, Vec3, World } from "kinesphere";

export interface LiveScene {
  readonly world: World;
  /** Advances to `until`, and passes the events to `deliver`, in order, including those before an error. */
  run(until: number, deliver: (event: Event) => void): void;
  /** Number of present bodies, if bodies are added and removed. */
  readonly presentCount?: number;
  /** Returns true positions and velocities of bodies: six numbers for each, NaN for absent ones. */
  states(): Float64Array;
  /** Returns the true position at any time; null for an absent body. Missing if bodies follow no recorded ways. */
  positionAt?(body: BodyId, time: number): Float64Array | null;
  /** Sets the velocity until the body is pushed or hits something. Absent if bodies follow fixed paths. */
  setVelocity?(body: BodyId, velocity: Vec3): void;
  /** Returns a copy with an equal future. */
  clone(): LiveScene;
  free(): void;
}

/** A scene at its start, and its properties for display. */
export interface Setup {
  scene: LiveScene;
  /** Title, if it depends on the opened files. */
  title?: string;
  about?: string;
  /** Radius of each body. */
  radii: Float64Array;
  /** Names of bodies; numbers if there are none. */
  names?: readonly string[];
  /** Unit of lengths, if it is known. */
  unit?: string | null;
  /** Fast bodies whose trails are shown. */
  trails?: readonly BodyId[];
  /** The recorded ways of all bodies. */
  ways?: readonly Track[];
  /** A thin zone; its crossings are counted. */
  zone?: { id: BodyId; box: Box };
  /** Distances between surfaces at which there is a warning and an alarm. */
  alarms?: AlarmDistances;
  /** The camera's target if there are no walls. */
  region?: Box;
  /** The end of the scene, if it is known. */
  endTime?: number;
}

export interface AlarmDistances {
  warning: number;
  alarm: number;
}

/** The user's choice. */
export interface SceneChoice {
  name: string;
  bodies: number;
  seed: number;
}

/** Bodies of a motion; the module computes the responses to their events. */
export class MovedScene implements LiveScene {
  constructor(readonly world: World, private readonly motion: Motion,
              private readonly respond: NonNullable<RunOptions["respond"]>) {}

  run(until: number, deliver: (event: Event) => void): void {
    this.world.run(until, { motion: this.motion, respond: this.respond }, (events) => {
      for (const event of events) deliver(event);
    });
  }
  states(): Float64Array {
    return this.motion.states(this.world.time);
  }
  setVelocity(body: BodyId, velocity: Vec3): void {
    this.motion.setVelocity(body, this.world.time, velocity);
    this.world.setVelocity(body, velocity);
  }
  clone(): MovedScene {
    return new MovedScene(this.world.clone(), this.motion.clone(), this.respond);
  }
  free(): void {
    this.world.free();
    this.motion.free();
  }
}
