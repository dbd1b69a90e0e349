// Responses of two bodies to an event: bounces, and potentials of steps.
import type { Answer } from "./asking.js";
import { Event } from "./event.js";
import { Owned, theModule } from "./module.js";
import { checkKeys, type Keys, requireNumbers, shown } from "./options.js";
import type { Vec3 } from "./state.js";
import type { WorldView } from "./world.js";

/** Marks what `bounce` returns: as an answer of a run it turns only the bodies that a contact can turn. */
export const bounced = Symbol("bounced");

/** The velocities of the two bodies after the contact; that of a wall is zero. The `respond` of a run may return it. */
export interface Bounce {
  first: Vec3;
  second: Vec3;
  /** @internal */
  [bounced]?: true;
  /** Of rigid bodies that the contact turns (radians / time). */
  firstAngularVelocity?: Vec3;
  secondAngularVelocity?: Vec3;
}

/** How rough spheres or discs bounce, beside their restitution: Walton's model. The balls are rigid bodies of one ball. */
export interface Roughness {
  /** Range: -1 to 1; default: 1, which loses no energy. Of a contact that sticks; -1 is smooth. */
  tangentialRestitution?: number;
  /** >= 0; default: Infinity. The coefficient beyond which a contact slides. */
  friction?: number;
  /** > 0; default: 0.4, of solid spheres. The moment of inertia in units of mass and squared radius; 0.5 for discs. */
  inertia?: number;
}

const roughKeys: Keys<Roughness> = { tangentialRestitution: "number", friction: "number", inertia: "number" };

/** Returns the numbers that bounce_roughly() of the module reads. Throws RangeError for numbers out of range. */
export function roughNumbers(rough: Roughness, call: string): [number, number, number] {
  checkKeys(rough, roughKeys, "roughness", call);
  const { tangentialRestitution = 1, friction = Infinity, inertia = 0.4 } = rough;
  if (!(Math.abs(tangentialRestitution) <= 1))
    throw new RangeError(`${call}: roughness.tangentialRestitution must be from -1 to 1, but is ${tangentialRestitution}`);
  if (!(friction >= 0)) throw new RangeError(`${call}: roughness.friction must be >= 0, but is ${friction}`);
  if (!(inertia > 0 && inertia < Infinity))
    throw new RangeError(`${call}: roughness.inertia must be > 0 and finite, but is ${inertia}`);
  return [tangentialRestitution, friction, inertia];
}

/** Arguments of `bounce` and `settle` besides the contact. */
export interface BounceOptions {
  /** >= 0; by default those of the event. A static body and a wall keep their velocity whatever is given. */
  firstMass?: number;
  secondMass?: number;
  /** Range: 0 to 1; default: 1. The part of the approach speed that is left. */
  restitution?: number;
  /** > 0 (length / time): for bodies that come to rest in a heap; see `settle` in kinesphere/response.hpp. */
  restingSpeed?: number;
  /** For rough balls, in place of masses and a resting speed. */
  roughness?: Roughness;
}

const bounceKeys: Keys<BounceOptions> = {
  firstMass: "number", secondMass: "number", restitution: "number", restingSpeed: "number", roughness: true,
};

/**
 * Bodies bounce off each other, static bodies and the walls. Masses are by index, by default those of the bodies; static
 * bodies are infinitely heavy.
 */
export interface Bounces {
  masses?: ArrayLike<number>;
  /** Range: 0 to 1; default: 1. */
  restitution?: number;
  /** > 0: bodies that come to rest in a heap; see `settle` in kinesphere/response.hpp. */
  restingSpeed?: number;
  /** For rough balls, in place of masses and a resting speed. */
  roughness?: Roughness;
}

/** Throws RangeError for numbers with which bodies would gain energy. */
export function checkBounce({ restitution = 1, restingSpeed = 0 }: Bounces, call: string): void {
  if (!(restitution >= 0 && restitution <= 1))
    throw new RangeError(`${call}: restitution must be from 0 to 1, but is ${restitution}`);
  if (!(restingSpeed >= 0 && restingSpeed < Infinity))
    throw new RangeError(`${call}: restingSpeed must be >= 0, but is ${restingSpeed}`);
}

/**
 * Returns the response of smooth bodies to a begin, as `bounce` and `settle` of the C++ library do. Momentum is kept, and
 * of rigid bodies angular momentum, too.
 */
export function bounce(contact: Event, options: BounceOptions = {}): Bounce {
  if (!(contact instanceof Event)) throw new TypeError(`bounce: contact must be an Event, but is ${shown(contact)}`);
  checkKeys(options, bounceKeys, "options", "bounce");
  checkBounce(options, "bounce");
  const { firstMass = contact.firstMass, secondMass = contact.secondMass, restitution = 1, restingSpeed = 0 } = options;
  const module = theModule();
  return module.with((scratch) => {
    const event = scratch.numbers(contact.numbers);
    const room = scratch.room(12);
    if (options.roughness !== undefined)
      module.call("event_bounce_rough", event, restitution, ...roughNumbers(options.roughness, "bounce"), room);
    else
      module.call("event_bounce", event, firstMass, secondMass, restitution, restingSpeed, room);
    const velocities = module.numbersAt(room, 12).slice();
    const turns = (gain: Float64Array) => options.roughness !== undefined || gain.some((part) => part !== 0);
    return {
      [bounced]: true,
      first: velocities.subarray(0, 3),
      second: velocities.subarray(3, 6),
      ...(turns(contact.firstSpinGain) ? { firstAngularVelocity: velocities.subarray(6, 9) } : {}),
      ...(turns(contact.secondSpinGain) ? { secondAngularVelocity: velocities.subarray(9, 12) } : {}),
    };
  });
}

/** The energy of a pair, as a function of the gap between its surfaces (kinesphere/step_potential.hpp). */
export interface StepPotentialDefinition {
  /** Gaps at which it changes (length, > 0), ascending. */
  distances: ArrayLike<number>;
  /** Of pairs that are nearer than each distance, but not than the one before. */
  energies: ArrayLike<number>;
  /** Beyond the last distance; by default 0, and Infinity for a bond. */
  outside?: number;
  /** Of contacts. Range: 0 to 1; default: 1. */
  restitution?: number;
}

const potentialKeys: Keys<StepPotentialDefinition> = { distances: true, energies: true, outside: "number", restitution: "number" };

/**
 * A potential of steps as a response to events: square wells, Lennard-Jones potentials in steps, bonds. Runs and games take
 * it. Bodies need a sensor with its distances (World.setSensor).
 */
export class StepPotential extends Owned {
  /** For worlds with the definition of this one. */
  constructor(world: WorldView, definition: StepPotentialDefinition) {
    const call = "StepPotential";
    if (typeof (world as WorldView | undefined)?.earliestContact !== "function")
      throw new TypeError(`${call}: world must be a World, but is ${shown(world)}`);
    checkKeys(definition, potentialKeys, "definition", call);
    const { distances, energies, outside = 0, restitution = 1 } = definition;
    requireNumbers(distances, "distances", call);
    requireNumbers(energies, "energies", call);
    if (energies.length !== distances.length)
      throw new RangeError(`${call}: energies must be as many as distances, ${distances.length}, but are ${energies.length}`);
    const module = theModule();
    super(module.with((scratch) => module.require(module.call(
      "potential_create", world.address, distances.length, scratch.numbers(distances), scratch.numbers(energies), outside,
      restitution))), "potential_free");
  }
  /** At a step the two gain or lose what their energy changes by, or are turned back; at a contact they bounce. */
  respond(event: Event): Answer {
    if (!(event instanceof Event)) throw new TypeError(`respond: event must be an Event, but is ${shown(event)}`);
    const module = theModule();
    return module.with((scratch) => {
      const room = scratch.numbers(new Float64Array(22));
      module.call("potential_respond", this.address, scratch.numbers(event.numbers), room);
      const numbers = module.numbersAt(room, 22).slice();
      return {
        ...(numbers[3] === 1 ? { first: numbers.subarray(0, 3) } : {}),
        ...(numbers[7] === 1 ? { second: numbers.subarray(4, 7) } : {}),
        ...(numbers[19] === 1 ? { turnedBack: true } : {}),
      };
    });
  }
  /** Returns the potential energy of a pair with this gap (length). */
  energy(gap: number): number {
    return theModule().call("potential_energy", this.address, gap);
  }
}
