// Callbacks of an advancing world: states of bodies, and responses to events.
import { BodyMap } from "./body_map.js";
import { Event } from "./event.js";
import type { Module } from "./module.js";
import { Motion } from "./motion.js";
import { checkKeys, type Keys, refusePromise, requireNumbers, shown } from "./options.js";
import { type BodyAction, bodyActions, eventSize } from "./records.js";
import { bounced, type Bounces, checkBounce, roughNumbers, StepPotential } from "./response.js";
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
/** The vectors of an answer, in the order in which the module reads them. */
const answerVectors = ["first", "second", "firstAngularVelocity", "secondAngularVelocity"] as const;
/** Returns the number of an action in the module. */
function actionNumber(action: BodyAction | undefined, what: string): number {
  if (action === undefined) return 0;
  const number = bodyActions.indexOf(action) + 1;
  if (number < 1) throw new TypeError(`respond: ${what} must be "remove", "disable" or "sleep", but is ${shown(action)}`);
  return number;
}

/** Returns the addresses of the motion and of the map, of which at most one is not 0. */
export function moving(probe: Probe): [motion: number, map: number] {
  return [probe instanceof Motion ? probe.address : 0, probe instanceof BodyMap ? probe.address : 0];
}

const respondings = { nothing: 0, bounces: 1, asksJavaScript: 2, asInScene: 3, byPotential: 4, rough: 5 } as const;
/** How many numbers of the module an answer has. */
export const responseSize = 22;

/** How to respond, for the module: a number, masses and so on, and a scene or a potential; and the function to call. */
export type Responding = [responding: number, bounces: Bounces, other: number, asked: RespondFunction | null];

export function responded(respond: RunOptions["respond"], call = "run"): Responding {
  if (respond === undefined) return [respondings.nothing, {}, 0, null];
  if (respond instanceof Scene) return [respondings.asInScene, {}, respond.address, null];
  if (respond instanceof StepPotential) return [respondings.byPotential, {}, respond.address, null];
  if (typeof respond === "function") return [respondings.asksJavaScript, {}, 0, respond];
  checkKeys(respond, bounceKeys, "respond", call);
  checkBounce(respond, call);
  if (respond.masses !== undefined) requireNumbers(respond.masses, "masses", call);
  if (respond.roughness === undefined) return [respondings.bounces, respond, 0, null];
  if (respond.masses !== undefined || respond.restingSpeed)
    throw new TypeError(`${call}: respond: roughness stands in place of masses and a resting speed`);
  return [respondings.rough, { ...respond, masses: roughNumbers(respond.roughness, call) }, 0, null];
}

/** Returns false for what no bounce turns: walls, static and sleeping bodies, infinite masses, and events but begins. */
function canBeTurned(event: Event, name: (typeof answerVectors)[number]): boolean {
  const [body, traits, mass] = name.startsWith("first")
    ? [event.first, event.firstTraits, event.firstMass] : [event.second, event.secondTraits, event.secondMass];
  return body !== null && !traits.isStatic && !traits.isSleeping && mass !== Infinity &&
         (event.kind === "contact_begin" || event.kind === "wall_begin");
}

/** Callbacks of the module, which pass tables of numbers to these functions. */
export function asking(
  module: Module, probe: ProbeFunction | null, respond: RespondFunction | null, rotate: RotationProbeFunction | null,
  atStop?: (event: Event) => void,
) {
  const eventAt = (numbers: number) => new Event(module.numbersAt(numbers, eventSize).slice());
  return {
    rotate(count: number, ids: number, time: number, rotations: number): void {
      const answer = new Float64Array(rotationNumbers * count).fill(NaN);
      refusePromise(rotate!(module.numbersAt(ids, count).slice(), time, answer), "rotation probe");
      module.numbersAt(rotations, answer.length).set(answer);
    },
    probe(count: number, ids: number, time: number, states: number): void {
      // The function may call the module, so its memory may grow.
      const answer = new Float64Array(6 * count).fill(NaN);
      refusePromise(probe!(module.numbersAt(ids, count).slice(), time, answer), "probe");
      module.numbersAt(states, 6 * count).set(answer);
    },
    respond(event: number, response: number): void {
      const happened = eventAt(event);
      const answer = respond!(happened);
      refusePromise(answer, "respond");
      if (answer !== undefined) checkKeys(answer, answerKeys, "answer", "respond", true);
      if (answer?.stop && atStop === undefined) throw new TypeError("respond: stop needs atStop in the options of run");
      const numbers = new Float64Array(responseSize);
      const isBounce = answer !== undefined && bounced in answer;
      for (const [k, name] of answerVectors.entries()) {
        const velocity = answer?.[name];
        if (velocity === undefined || (isBounce && !canBeTurned(happened, name))) continue;
        numbers.set(vector(velocity, name, "respond"), 4 * k);
        numbers[4 * k + 3] = 1;
      }
      numbers[16] = actionNumber(answer?.firstAction, "firstAction");
      numbers[17] = actionNumber(answer?.secondAction, "secondAction");
      numbers[18] = answer?.stop ? 1 : 0;
      numbers[19] = answer?.turnedBack ? 1 : 0;
      if (answer?.pairState !== undefined) numbers.set([1, pairStateOf(answer.pairState, "pairState", "respond")], 20);
      module.numbersAt(response, numbers.length).set(numbers);
    },
    stop(event: number): void {
      refusePromise(atStop!(eventAt(event)), "atStop");
    },
  };
}
