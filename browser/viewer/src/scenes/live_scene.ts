// A scene at work: a world, whatever moves its bodies, and whatever answers its events.
import type { BodyId, Box, Event, Motion, RunOptions, Vec3, World } from "kinesphere";

export interface LiveScene {
  readonly world: World;
  /** Goes on to `until`, and tells what happens, in order; also what came before an error. */
  run(until: number, tell: (event: Event) => void): void;
  /** How many bodies are there now, where they come and go. */
  readonly presentCount?: number;
  /** Where bodies truly are now, and how fast: six numbers of each, NaN of who is not there. */
  states(): Float64Array;
  /** From now on the body has this velocity, until it is pushed or meets something. Absent where bodies go their own way. */
  setVelocity?(body: BodyId, velocity: Vec3): void;
  /** A copy that goes on as this one does. */
  clone(): LiveScene;
  free(): void;
}

/** A scene at its start, and what is known of it beside. */
export interface Setup {
  scene: LiveScene;
  /** What is to be said of it, where that depends on what was opened. */
  title?: string;
  about?: string;
  /** By body. */
  radii: Float64Array;
  /** A thin zone whose crossings are counted. */
  zone?: { id: BodyId; box: Box };
  /** Distances between surfaces at which there is a warning and an alarm. */
  alarms?: AlarmDistances;
  /** What the camera looks at where there are no walls. */
  region?: Box;
  /** When all is over, if that is known. */
  endTime?: number;
}

export interface AlarmDistances {
  warning: number;
  alarm: number;
}

/** What the person chose. */
export interface SceneChoice {
  name: string;
  bodies: number;
  seed: number;
}

/** Bodies of a motion, whose answers to events the module computes by itself. */
export class MovedScene implements LiveScene {
  constructor(readonly world: World, private readonly motion: Motion,
              private readonly respond: NonNullable<RunOptions["respond"]>) {}

  run(until: number, tell: (event: Event) => void): void {
    this.world.run(until, { motion: this.motion, respond: this.respond }, (events) => {
      for (const event of events) tell(event);
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
