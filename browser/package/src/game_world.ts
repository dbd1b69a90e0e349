// Games: worlds that move their own bodies.
import { answeringOf, answeringRecord, type RespondFunction } from "./asking.js";
import { definitionRecord, type WorldDefinition } from "./definition.js";
import { type Event, Events } from "./event.js";
import { filterArguments, keptFilter, type PairFilter } from "./filter.js";
import { type Module, theModule } from "./module.js";
import { checkKeys, type Keys, requireBytes, requireNumbers } from "./options.js";
import { bodyListAt, eventAt, eventListAt, gameAt, type MotionLimits } from "./records.js";
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

/** Returns the address of a ks_game_definition, for the duration of a call, and what the game has to keep. */
function gameRecord(module: Module, { respond, gravity = [0, 0, 0] }: GameOptions, call: string): [at: number, kept: unknown] {
  if (respond !== null && typeof respond === "object" && "masses" in respond)
    throw new TypeError(`${call}: respond must not have masses: those of the bodies count`);
  const answering = answeringOf(module, respond, call, true);
  const callback = answering.callback && module.keep(answering.callback);
  const at = answeringRecord(module, gameAt, answering, callback?.number ?? 0);
  module.putVector(at + gameAt.gravity, vector(gravity, "gravity", call));
  return [at, callback ?? answering.kept];
}

/**
 * A world that moves its own bodies, so that a game keeps nothing of them but ids. Between events each body flies freely,
 * by the gravity of the game and its own planned acceleration, so steps of any length miss nothing. All else is as for
 * World, but for what asks for states: motions, probes, run() and setMotionLimits().
 */
export class GameWorld extends World {
  /** What answers events. */
  #answering: unknown;

  constructor(definition: WorldDefinition = {}, options: GameOptions = {}, made: [handle: bigint, answering: unknown] | null = null) {
    const call = "GameWorld";
    checkKeys(options, gameKeys, "options", call);
    const module = theModule();
    const [handle, answering] = made ?? module.with(() => {
      const [at, kept] = gameRecord(module, options, call);
      return [module.handle("ks_game_create", definitionRecord(module, definition), at), kept];
    });
    super(handle);
    this.#answering = answering;
  }
  /** @internal */
  protected override get kind(): string {
    return "GameWorld";
  }
  /**
   * Restores a game from save(), called here or in any other program, which goes on as the saved one did; its gravity is
   * that of the snapshot. A game that had a pair filter needs the same one.
   */
  static override restore(snapshot: Uint8Array, pairFilter: PairFilter | null = null, options: GameOptions = {}): GameWorld {
    const call = "GameWorld.restore";
    requireBytes(snapshot, "snapshot", call);
    checkKeys(options, gameKeys, "options", call);
    const module = theModule();
    const filter = keptFilter(module, pairFilter, "pairFilter", call);
    return module.with(() => {
      const [at, kept] = gameRecord(module, options, call);
      const handle = module.handle("ks_game_restore", module.bytesOf(snapshot), snapshot.length, at, ...filterArguments(module, filter));
      const game = new GameWorld({}, {}, [handle, kept]);
      game.keep(filter, null);
      return game;
    });
  }
  /** Returns a copy with an equal future. */
  override clone(): GameWorld {
    const copy = new GameWorld({}, {}, [theModule().handle("ks_world_clone", this.address), this.#answering]);
    copy.keep(...this.kept());
    return copy;
  }

  /**
   * Advances by dt > 0, answers all events, and returns them in order. What the response throws comes out of the call; the
   * next step goes on from where the game stands then, and returns the events of this one, too.
   */
  step(dt: number): Events {
    const module = theModule();
    return module.with(() => {
      const told = module.room(eventListAt.size);
      module.check("ks_game_step", this.address, dt, told);
      const size = eventAt.size * module.i32[(told + eventListAt.count) >> 2]!;
      return new Events(module.copy(module.i32[(told + eventListAt.events) >> 2]!, size));
    });
  }
  /** Advances to the next event, answers it and returns it, or to `until`, and returns null. */
  override advance(until: number): Event | null {
    const module = theModule();
    return this.next((event) => module.status("ks_world_advance", this.address, until, module.pointer("probe_game"), 0, event));
  }
  /** Yields the events up to `until`, each answered already, for a loop in which bodies may be changed. */
  override *events(until: number): Generator<Event, void, undefined> {
    for (let event = this.advance(until); event !== null; event = this.advance(until)) yield event;
  }
  /** Replaces what answers events; clones keep theirs. */
  setRespond(respond: GameOptions["respond"]): void {
    const module = theModule();
    module.with(() => {
      const [at, kept] = gameRecord(module, respond === undefined ? {} : { respond }, "setRespond");
      module.check("ks_game_set_response", this.address, at);
      this.#answering = kept;
    });
  }

  /** The bodies that can move, disabled ones too: the last one takes the place of a removed one. Cost of each: a copy. */
  get ids(): Float64Array {
    return this.listed((module, at, count) => module.idsAt(module.i32[(at + bodyListAt.ids) >> 2]!, count));
  }
  /** Three numbers for each body, in the order of ids: where it is now, on periodic axes in the box. */
  get positions(): Float64Array {
    return this.listed((module, at, count) => module.numbersAt(module.i32[(at + bodyListAt.positions) >> 2]!, 3 * count));
  }
  /** Three numbers for each body, in the order of ids: its velocity now. */
  get velocities(): Float64Array {
    return this.listed((module, at, count) => module.numbersAt(module.i32[(at + bodyListAt.velocities) >> 2]!, 3 * count));
  }
  private listed<T>(read: (module: Module, list: number, count: number) => T): T {
    const module = theModule();
    return module.with(() => {
      const at = module.room(bodyListAt.size);
      module.check("ks_game_bodies", this.address, at);
      return read(module, at, module.i32[(at + bodyListAt.count) >> 2]!);
    });
  }
  /** Returns the place of a body in these arrays, or -1. */
  indexOf(body: BodyId): number {
    const module = theModule();
    return module.with(() => {
      const at = module.room(8);
      const status = module.call("ks_game_index_of", this.address, module.id(body, "indexOf"), at);
      return status === 0 ? module.i32[at >> 2]! : -1;
    });
  }

  /**
   * Sets the velocities of all bodies, three numbers for each in the order of ids, or on an error of none. A body that has
   * its velocity already goes on undisturbed.
   */
  setVelocities(velocities: ArrayLike<number>): void {
    const call = "setVelocities";
    requireNumbers(velocities, "velocities", call);
    const count = this.listed((_module, _at, bodies) => bodies);
    if (velocities.length !== 3 * count)
      throw new RangeError(`${call}: velocities must have three numbers for each of ${count} bodies, but has ${velocities.length}`);
    const module = theModule();
    module.with(() => module.check("ks_game_set_velocities", this.address, module.numbers(velocities), count));
  }
  /** Sets the acceleration of a body besides the gravity (length / time^2): engines, wind. */
  setAcceleration(body: BodyId, acceleration: Vec3): void {
    this.changeBy("ks_game_set_acceleration", body, vector(acceleration, "acceleration", "setAcceleration"));
  }
  /** Acceleration of all bodies (length / time^2). */
  get gravity(): Float64Array {
    const module = theModule();
    return module.with(() => {
      const at = module.room(24);
      module.check("ks_game_gravity", this.address, at);
      return module.numbersAt(at, 3);
    });
  }
  /** Sets the gravity of the game; wakes all that sleep. */
  setGravity(gravity: Vec3): void {
    const numbers = vector(gravity, "gravity", "setGravity");
    const module = theModule();
    module.with(() => module.check("ks_game_set_gravity", this.address, module.numbers(numbers)));
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

function refuse(call: string): never {
  throw new TypeError(`${call}: a GameWorld moves its bodies itself; step(), advance() and events() let time pass`);
}
