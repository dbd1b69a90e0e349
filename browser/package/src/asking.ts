// Callbacks of an advancing world: states of bodies, and responses to events.
import { BodyMap } from "./body_map.js";
import { type Event, eventFrom } from "./event.js";
import { type Argument, type Callback, type Module, theModule, type Value } from "./module.js";
import { Motion } from "./motion.js";
import { checkKeys, type Keys, refusePromise, requireNumbers, shown } from "./options.js";
import { type BodyAction, bodyActions, type gameAt, responseAt, roughnessAt, type runAt } from "./records.js";
import { bounced, type Bounces, checkBounce, putRoughness, StepPotential } from "./response.js";
import { rotationNumbers, type RotationProbeFunction } from "./rigid_body.js";
import { Scene } from "./scene.js";
import { pairStateOf, type Vec3, vector } from "./state.js";

/**
 * Sets states[6 k], ... to position and velocity of ids[k] at `time`. Both arrays are good during the call alone.
 * It may not change the world that asks.
 */
export type ProbeFunction = (ids: Float64Array, time: number, states: Float64Array) => void;
/** If the ids of a world are the numbers of a motion's bodies, the motion itself is a probe; else a BodyMap. */
export type Probe = ProbeFunction | Motion | BodyMap;

/**
 * What an event does to its bodies: velocities from then on, and what else is done to them. A body without both goes on
 * as before. An answer has no effect on a body that an earlier one at the same time has removed, and none but `remove` on
 * one that it has disabled.
 */
export interface Answer {
  first?: Vec3;
  second?: Vec3;
  /** Of rigid bodies (radians / time), in a world without a rotation probe. */
  firstAngularVelocity?: Vec3;
  secondAngularVelocity?: Vec3;
  firstAction?: BodyAction;
  secondAction?: BodyAction;
  /** Of sensors: the two have been turned back at the sensor distance (World.turnBack). */
  turnedBack?: boolean;
  /** A whole number: the two get this state (World.setPairState). */
  pairState?: number;
  /** Calls `atStop` of the run with this event. */
  stop?: boolean;
}
/**
 * Is called at every event, at ends too: look at `event.kind` first, as velocities that are exchanged at each
 * `contact_end` turn the two back to each other, for ever. Precondition: equal events get equal answers. `bounce` is such
 * a function, which leaves ends as they are.
 */
export type RespondFunction = (event: Event) => Answer | undefined;
/** What a run may be told besides its motion and its end. */
export interface RunOptions {
  /** The source of states: a motion whose numbers are the indices of the ids, or a map. */
  motion: Motion | BodyMap;
  /** Without it, bodies pass through each other and through walls: `{ restitution: 1 }` lets them bounce. */
  respond?: RespondFunction | Bounces | StepPotential | Scene;
  /**
   * Is called with each event whose answer has `stop`. The world is at the time of the event, and may be changed, but not
   * advanced: add bodies and remove others, teleport them.
   */
  atStop?: (event: Event) => void;
}

export const runKeys: Keys<RunOptions> = { motion: true, respond: true, atStop: true };
const bounceKeys: Keys<Bounces> = { masses: true, restitution: "number", restingSpeed: "number", roughness: true };
const answerKeys: Keys<Answer> = {
  first: true, second: true, firstAngularVelocity: true, secondAngularVelocity: true, firstAction: true,
  secondAction: true, turnedBack: "boolean", pairState: "number", stop: "boolean",
};
/** The vectors of an answer, and where they are in a ks_response, with whether they are there. */
const answerVectors = [
  ["first", responseAt.turnsFirst, responseAt.firstVelocity],
  ["second", responseAt.turnsSecond, responseAt.secondVelocity],
  ["firstAngularVelocity", responseAt.spinsFirst, responseAt.firstAngularVelocity],
  ["secondAngularVelocity", responseAt.spinsSecond, responseAt.secondAngularVelocity],
] as const;
/** Returns the number of an action in C. */
function actionNumber(action: BodyAction | undefined, what: string): number {
  if (action === undefined) return 0;
  const number = bodyActions.indexOf(action) + 1;
  if (number < 1) throw new TypeError(`respond: ${what} must be "remove", "disable" or "sleep", but is ${shown(action)}`);
  return number;
}

/** Returns the arguments of C for a probe. */
export function probing(probe: Probe, call: string): [probe: Argument, user: Argument] {
  if (probe instanceof Motion || probe instanceof BodyMap) {
    const pointer = theModule().pointer(probe instanceof Motion ? "probe_motion" : "probe_map");
    return [pointer, (module) => module.use(probe.address)];
  }
  if (typeof probe !== "function") throw new TypeError(`${call}: probe must be a function, a Motion or a BodyMap`);
  return [theModule().pointer("probe"), (module) => module.hold((bodies, count, time, states) => {
    // The function may call the module, so its memory may grow.
    const answer = new Float64Array(6 * count!).fill(NaN);
    refusePromise(probe(module.idsAt(bodies!, count!), time!, answer), "probe");
    module.f64.set(answer, states! >> 3);
  })];
}

/** Returns the callback of a ks_rotation_probe. */
export function rotating(module: Module, probe: RotationProbeFunction): Callback {
  return (bodies, count, time, rotations) => {
    const answer = new Float64Array(rotationNumbers * count!).fill(NaN);
    refusePromise(probe(module.idsAt(bodies!, count!), time!, answer), "rotation probe");
    module.f64.set(answer, rotations! >> 3);
  };
}

/** Returns the callback of a ks_respond. */
function responding(module: Module, respond: RespondFunction, mayStop: boolean): Callback {
  return (event, response) => {
    const happened = eventFrom(module, event!);
    const answer = respond(happened);
    refusePromise(answer, "respond");
    if (answer === undefined) return;
    checkKeys(answer, answerKeys, "answer", "respond", true);
    if (answer.stop && !mayStop) throw new TypeError("respond: stop needs atStop in the options of run");
    const put = (at: number, word: number) => module.putWord(response! + at, word);
    for (const [name, isThere, at] of answerVectors) {
      const velocity = answer[name];
      if (velocity === undefined || (bounced in answer && !canBeTurned(happened, name))) continue;
      module.putVector(response! + at, vector(velocity, name, "respond"));
      put(isThere, 1);
    }
    put(responseAt.firstAction, actionNumber(answer.firstAction, "firstAction"));
    put(responseAt.secondAction, actionNumber(answer.secondAction, "secondAction"));
    put(responseAt.stop, answer.stop ? 1 : 0);
    put(responseAt.turnedBack, answer.turnedBack ? 1 : 0);
    if (answer.pairState === undefined) return;
    put(responseAt.setsPairState, 1);
    put(responseAt.pairState, pairStateOf(answer.pairState, "pairState", "respond"));
  };
}

/** Returns false for what no bounce turns: walls, static and sleeping bodies, infinite masses, and events but begins. */
function canBeTurned(event: Event, name: (typeof answerVectors)[number][0]): boolean {
  const [body, traits, mass] = name.startsWith("first")
    ? [event.first, event.firstTraits, event.firstMass] : [event.second, event.secondTraits, event.secondMass];
  return body !== null && !traits.isStatic && !traits.isSleeping && mass !== Infinity &&
         (event.kind === "contact_begin" || event.kind === "wall_begin");
}

/** What answers the events of a run or a game. */
export interface Answering {
  /** NaN: bodies pass through each other. */
  restitution: number;
  restingSpeed: number;
  masses: ArrayLike<number>;
  scene: Value;
  /** The function of the module that answers instead, and its argument. */
  pointer: number;
  user: number;
  /** The function of JavaScript that answers instead; its argument is its number. */
  callback: Callback | null;
  /** What has to be there as long as the answers. */
  kept: unknown;
}

/** `room` gives memory for as long as the answers need it. */
export function answeringOf(
  module: Module, respond: RunOptions["respond"], call: string, mayStop: boolean, room: (size: number) => number,
): Answering {
  const none: Answering =
    { restitution: NaN, restingSpeed: 0, masses: [], scene: 0, pointer: 0, user: 0, callback: null, kept: respond };
  if (respond === undefined) return none;
  if (respond instanceof Scene) return { ...none, scene: respond.address };
  if (respond instanceof StepPotential)
    return { ...none, pointer: module.pointer("potential"), user: Number(respond.address), kept: respond.block };
  if (typeof respond === "function")
    return { ...none, pointer: module.pointer("respond"), callback: responding(module, respond, mayStop) };
  checkKeys(respond, bounceKeys, "respond", call);
  checkBounce(respond, call);
  const { restitution = 1, restingSpeed = 0, masses = [], roughness } = respond;
  requireNumbers(masses, "masses", call);
  if (roughness === undefined) return { ...none, restitution, restingSpeed, masses };
  if (respond.masses !== undefined || respond.restingSpeed)
    throw new TypeError(`${call}: respond: roughness stands in place of masses and a resting speed`);
  const user = room(roughnessAt.size);
  putRoughness(module, user, restitution, roughness, call);
  return { ...none, pointer: module.pointer("rough"), user };
}

/** @internal Returns the address of a ks_run_definition or a ks_game_definition; `user` is the number of a callback. */
export function answeringRecord(
  module: Module, layout: typeof runAt | typeof gameAt, answering: Answering, user: number,
): number {
  const at = module.record(layout);
  module.putNumber(at + layout.restitution, answering.restitution);
  module.putNumber(at + layout.restingSpeed, answering.restingSpeed);
  module.putWord(at + layout.respond, answering.pointer);
  module.putWord(at + layout.respondUser, answering.callback === null ? answering.user : user);
  return at;
}
