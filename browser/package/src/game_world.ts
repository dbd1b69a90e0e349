// Games: worlds that move their own bodies.
import { asking, responded, type RespondFunction } from "./asking.js";
import { definitionNumbers, type WorldDefinition } from "./definition.js";
import { Event, Events } from "./event.js";
import type { PairFilter } from "./filter.js";
import { type Scratch, theModule } from "./module.js";
import { checkKeys, type Keys, requireBytes, requireNumbers, shown } from "./options.js";
import type { MotionLimits } from "./records.js";
import type { Bounces, StepPotential } from "./response.js";
import { type BodyId, type Vec3, vector } from "./state.js";
import { World } from "./world.js";

/** What a game has besides its world. */
export interface GameOptions {
  /** Acceleration of all bodies (length / time^2), besides the planned acceleration of each. */
  gravity?: Vec3;
  /**
   * What an event does to its bodies: a function of the event alone, or bounces with a restitution and a resting speed.
   * Without it, bodies pass through each other and through walls.
   */
  respond?: RespondFunction | Omit<Bounces, "masses"> | StepPotential;
}

const gameKeys: Keys<GameOptions> = { gravity: true, respond: true };

/** The function to call, and the arguments of the module. */
type Answering = [asked: RespondFunction | null, numbers: (scratch: Scratch) => number[]];

function answeringOf(respond: GameOptions["respond"], call: string): Answering {
  if (respond !== null && typeof respond === "object" && "masses" in respond)
    throw new TypeError(`${call}: respond must not have masses: those of the bodies count`);
  const [responding, { restitution = 1, restingSpeed = 0, masses = [] }, other, asked] = responded(respond, call);
  return [asked, (scratch) => [responding, restitution, restingSpeed, scratch.numbers(masses), other]];
}

/**
 * A world that moves its own bodies, so that a game keeps nothing of them but ids. Between events each body flies freely,
 * by the gravity of the game and its own planned acceleration, so steps of any length miss nothing. All else is as for
 * World, but for what asks for states: motions, probes, run() and setMotionLimits().
 */
export class GameWorld extends World {
  /** What answers events, if a function does. */
  #respond: RespondFunction | null;

  constructor(definition: WorldDefinition = {}, options: GameOptions = {}, restored: number | null = null) {
    const call = "GameWorld";
    checkKeys(options, gameKeys, "options", call);
    const [asked, numbers] = answeringOf(options.respond, call);
    const gravity = vector(options.gravity ?? [0, 0, 0], "gravity", call);
    const module = theModule();
    super(restored ?? module.with((scratch) => module.require(module.call(
      "game_create", scratch.numbers(definitionNumbers(definition)), scratch.numbers(gravity), ...numbers(scratch)))), "game_free");
    this.#respond = asked;
  }
  /**
   * Restores a game from save(), called here or in any other program, which goes on as the saved one did; its gravity is
   * that of the snapshot. A game that had a pair filter needs the same one.
   */
  static override restore(snapshot: Uint8Array, pairFilter: PairFilter | null = null, options: GameOptions = {}): GameWorld {
    const call = "GameWorld.restore";
    requireBytes(snapshot, "snapshot", call);
    if (pairFilter !== null && typeof pairFilter !== "function")
      throw new TypeError(`${call}: pairFilter must be a function or null, but is ${shown(pairFilter)}`);
    const [, numbers] = answeringOf(options.respond, call);
    const module = theModule();
    const kept = pairFilter === null ? null : module.keepFilter(pairFilter);
    const game = new GameWorld({}, options, module.with((scratch) => module.require(module.call(
      "game_restore", scratch.bytes(snapshot), snapshot.length, kept?.number ?? -1, ...numbers(scratch)))));
    game.keep(kept, null);
    return game;
  }
  /** Returns a copy with an equal future. */
  override clone(): GameWorld {
    const module = theModule();
    const copy = new GameWorld({}, {}, module.require(module.call("game_clone", this.address)));
    copy.#respond = this.#respond;
    copy.keep(...this.kept());
    return copy;
  }
  /** @internal Games have calls of their own for what moves bodies. */
  protected override named(name: string): string {
    return gameCalls.has(name) ? name.replace("world_", "game_") : name;
  }

  /**
   * Advances by dt > 0, answers all events, and returns them in order. What the response throws comes out of the call; the
   * next step goes on from where the game stands then, and returns the events of this one, too.
   */
  step(dt: number): Events {
    const module = theModule();
    module.require(this.go("game_step", dt));
    return new Events(module.answer());
  }
  /** Advances to the next event, answers it and returns it, or to `until`, and returns null. */
  override advance(until: number): Event | null {
    const module = theModule();
    const result = this.go("game_advance", until);
    if (result < 0) throw module.error();
    return result === 0 ? null : new Event(module.answer());
  }
  /** Yields the events up to `until`, each answered already, for a loop in which bodies may be changed. */
  override *events(until: number): Generator<Event, void, undefined> {
    for (let event = this.advance(until); event !== null; event = this.advance(until)) yield event;
  }
  private go(name: string, time: number): number {
    const module = theModule();
    const callbacks = asking(module, null, this.#respond, this.kept()[1], () => {});
    return module.callWith(callbacks, [this.address], name, this.address, time);
  }
  /** Replaces what answers events; clones keep theirs. */
  setRespond(respond: GameOptions["respond"]): void {
    const [asked, numbers] = answeringOf(respond, "setRespond");
    const module = theModule();
    module.with((scratch) => module.require(module.call("game_set_response", this.address, ...numbers(scratch))));
    this.#respond = asked;
  }

  /** The bodies that can move, disabled ones too: the last one takes the place of a removed one. Cost of each: a copy. */
  get ids(): Float64Array {
    const module = theModule();
    module.call("game_ids", this.address);
    return module.answer();
  }
  /** Three numbers for each body, in the order of ids: where it is now, on periodic axes in the box. */
  get positions(): Float64Array {
    return this.numbersOf("game_positions");
  }
  /** Three numbers for each body, in the order of ids: its velocity now. */
  get velocities(): Float64Array {
    return this.numbersOf("game_velocities");
  }
  private numbersOf(name: string): Float64Array {
    const module = theModule();
    const address = module.call(name, this.address);
    return module.numbersAt(address, 3 * module.call("game_count", this.address)).slice();
  }
  /** Returns the place of a body in these arrays, or -1. */
  indexOf(body: BodyId): number {
    return theModule().call("game_index_of", this.address, body);
  }

  /**
   * Sets the velocities of all bodies, three numbers for each in the order of ids, or on an error of none. A body that has
   * its velocity already goes on undisturbed.
   */
  setVelocities(velocities: ArrayLike<number>): void {
    const call = "setVelocities";
    requireNumbers(velocities, "velocities", call);
    const count = velocities.length / 3;
    const module = theModule();
    if (count !== module.call("game_count", this.address))
      throw new RangeError(`${call}: velocities must have three numbers for each of ${this.ids.length} bodies, but has ` +
                           `${velocities.length}`);
    module.with((scratch) =>
      module.require(module.call("game_set_velocity_all", this.address, count, 0, scratch.numbers(velocities))));
  }
  /** Sets the acceleration of a body besides the gravity (length / time^2): engines, wind. */
  setAcceleration(body: BodyId, acceleration: Vec3): void {
    this.change("game_set_acceleration", body, vector(acceleration, "acceleration", "setAcceleration"));
  }
  /** Acceleration of all bodies (length / time^2). */
  get gravity(): Float64Array {
    const module = theModule();
    module.call("game_gravity", this.address);
    return module.answer();
  }
  /** Sets the gravity of the game; wakes all that sleep. */
  setGravity(gravity: Vec3): void {
    const numbers = vector(gravity, "gravity", "setGravity");
    const module = theModule();
    module.with((scratch) => module.require(module.call("game_set_gravity", this.address, scratch.numbers(numbers))));
  }

  /** Throws: a game takes no motion. */
  override addMotion(): never {
    return refuse("addMotion");
  }
  /** Throws: step(), advance() and events() let time pass. */
  override run(): never {
    return refuse("run");
  }
  /** Throws: a body keeps to its flight. */
  override setMotionLimits(_body: BodyId, _limits: MotionLimits): never {
    return refuse("setMotionLimits");
  }
}

const gameCalls: ReadonlySet<string> = new Set([
  "world_add_all", "world_add_moving_shape", "world_add_rigid_body", "world_remove", "world_set_velocity",
  "world_set_velocity_all", "world_teleport", "world_disable", "world_enable", "world_sleep", "world_save",
]);

function refuse(call: string): never {
  throw new TypeError(`${call}: a GameWorld moves its bodies itself; step(), advance() and events() let time pass`);
}
