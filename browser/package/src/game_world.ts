// Games: worlds that move their own bodies.
import { answeringOf, answeringRecord, type RespondFunction } from "./asking.js";
import { definitionRecord, type WorldDefinition } from "./definition.js";
import { type Event, Events } from "./event.js";
import { filterArguments, keptFilter, type PairFilter } from "./filter.js";
import type { Place } from "./memory.js";
import { type Argument, Block, Id, theModule } from "./module.js";
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

/** Returns a ks_game_definition as an argument, and what the game has to keep. */
function gameRecord({ respond, gravity = [0, 0, 0] }: GameOptions, call: string): [definition: Argument, kept: unknown] {
  if (respond !== null && typeof respond === "object" && "masses" in respond)
    throw new TypeError(`${call}: respond must not have masses: those of the bodies count`);
  const module = theModule();
  let block: Block | null = null;
  const answering = answeringOf(module, respond, call, true, (size) => (block = new Block(size)).address);
  const callback = answering.callback && module.keep(answering.callback);
  return [() => {
    const at = answeringRecord(module, gameAt, answering, callback?.number ?? 0);
    module.putVector(at + gameAt.gravity, vector(gravity, "gravity", call));
    return at;
  }, callback ?? block ?? answering.kept];
}

/**
 * A world that moves its own bodies, so that a game keeps nothing of them but ids. Between events each body flies freely,
 * by the gravity of the game and its own planned acceleration, so steps of any length miss nothing. All else is as for
 * World, but for what asks for states: motions, probes, run() and setMotionLimits().
 */
export class GameWorld extends World {
  /** What answers events. */
  #answering: unknown;

  constructor(
    definition: WorldDefinition = {}, options: GameOptions = {}, made: [handle: bigint, answering: unknown] | null = null,
  ) {
    const call = "GameWorld";
    checkKeys(options, gameKeys, "options", call);
    if (made !== null) {
      super(made[0]);
      this.#answering = made[1];
      return;
    }
    const [record, kept] = gameRecord(options, call);
    super(theModule().handle("ks_game_create", definitionRecord(definition), record));
    this.#answering = kept;
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
    const [record, kept] = gameRecord(options, call);
    const handle = module.handle("ks_game_restore", snapshot, snapshot.length, record, ...filterArguments(module, filter));
    const game = new GameWorld({}, {}, [handle, kept]);
    game.keep(filter, null);
    return game;
  }
  /** Returns a copy with an equal future. */
  override clone(): GameWorld {
    const copy = new GameWorld({}, {}, [this.handle("ks_world_clone"), this.#answering]);
    copy.keep(...this.kept());
    return copy;
  }

  /**
   * Advances by dt > 0, answers all events, and returns them in order. What the response throws comes out of the call; the
   * next step goes on from where the game stands then, and returns the events of this one, too.
   */
  step(dt: number): Events {
    const told = this.read(eventListAt, "ks_game_step", dt);
    return new Events(theModule().copy(told.word(eventListAt.events), eventAt.size * told.word(eventListAt.count)));
  }
  /** Advances to the next event, answers it and returns it, or to `until`, and returns null. */
  override advance(until: number): Event | null {
    return this.next(until, theModule().pointer("probe_game"), 0);
  }
  /** Yields the events up to `until`, each answered already, for a loop in which bodies may be changed. */
  override *events(until: number): Generator<Event, void, undefined> {
    for (let event = this.advance(until); event !== null; event = this.advance(until)) yield event;
  }
  /** Replaces what answers events; clones keep theirs. */
  setRespond(respond: GameOptions["respond"]): void {
    const [record, kept] = gameRecord(respond === undefined ? {} : { respond }, "setRespond");
    this.check("ks_game_set_response", record);
    this.#answering = kept;
  }

  /** The bodies that can move, disabled ones too: the last one takes the place of a removed one. Cost of each: a copy. */
  get ids(): Float64Array {
    const bodies = this.bodyList;
    return theModule().idsAt(bodies.word(bodyListAt.ids), bodies.word(bodyListAt.count));
  }
  /** Three numbers for each body, in the order of ids: where it is now, on periodic axes in the box. */
  get positions(): Float64Array {
    return this.listed("positions");
  }
  /** Three numbers for each body, in the order of ids: its velocity now. */
  get velocities(): Float64Array {
    return this.listed("velocities");
  }
  private listed(what: "positions" | "velocities"): Float64Array {
    const bodies = this.bodyList;
    return theModule().numbersAt(bodies.word(bodyListAt[what]), 3 * bodies.word(bodyListAt.count));
  }
  private get bodyList(): Place {
    return this.read(bodyListAt, "ks_game_bodies");
  }
  /** Returns the place of a body in these arrays, or -1. */
  indexOf(body: BodyId): number {
    const module = theModule();
    return module.with(() => {
      const at = module.room(8);
      return module.call("ks_game_index_of", this.address, new Id(body), at) === 0 ? module.i32[at >> 2]! : -1;
    });
  }

  /**
   * Sets the velocities of all bodies, three numbers for each in the order of ids, or on an error of none. A body that has
   * its velocity already goes on undisturbed.
   */
  setVelocities(velocities: ArrayLike<number>): void {
    const call = "setVelocities";
    requireNumbers(velocities, "velocities", call);
    const count = this.bodyList.word(bodyListAt.count);
    if (velocities.length !== 3 * count)
      throw new RangeError(`${call}: velocities must have three numbers for each of ${count} bodies, but has ${velocities.length}`);
    this.check("ks_game_set_velocities", velocities, count);
  }
  /** Sets the acceleration of a body besides the gravity (length / time^2): engines, wind. */
  setAcceleration(body: BodyId, acceleration: Vec3): void {
    this.check("ks_game_set_acceleration", new Id(body), vector(acceleration, "acceleration", "setAcceleration"));
  }
  /** Acceleration of all bodies (length / time^2). */
  get gravity(): Float64Array {
    return this.read({ size: 24 }, "ks_game_gravity").numbers;
  }
  /** Sets the gravity of the game; wakes all that sleep. */
  setGravity(gravity: Vec3): void {
    this.check("ks_game_set_gravity", vector(gravity, "gravity", "setGravity"));
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
