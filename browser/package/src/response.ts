// Responses of two bodies to an event: bounces, and potentials of steps.
import type { Answer } from "./asking.js";
import { Event } from "./event.js";
import { Block, type Module, Owned, theModule } from "./module.js";
import { checkKeys, type Keys, requireNumbers, shown } from "./options.js";
import { eventAt, responseAt, roughnessAt, stepPotentialAt } from "./records.js";
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

/** Writes a ks_roughness. Throws RangeError for numbers out of range. */
export function putRoughness(to: Module, at: number, restitution: number, rough: Roughness, call: string): void {
  checkKeys(rough, roughKeys, "roughness", call);
  const { tangentialRestitution = 1, friction = Infinity, inertia = 0.4 } = rough;
  if (!(Math.abs(tangentialRestitution) <= 1))
    throw new RangeError(`${call}: roughness.tangentialRestitution must be from -1 to 1, but is ${tangentialRestitution}`);
  if (!(friction >= 0)) throw new RangeError(`${call}: roughness.friction must be >= 0, but is ${friction}`);
  if (!(inertia > 0 && inertia < Infinity))
    throw new RangeError(`${call}: roughness.inertia must be > 0 and finite, but is ${inertia}`);
  to.putWord(at, roughnessAt.size);
  to.putNumber(at + roughnessAt.restitution, restitution);
  to.putNumber(at + roughnessAt.tangentialRestitution, tangentialRestitution);
  to.putNumber(at + roughnessAt.friction, friction);
  to.putNumber(at + roughnessAt.inertia, inertia);
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
  const weighed = eventRecord(contact).slice();
  weighed[eventAt.firstMass >> 3] = firstMass;
  weighed[eventAt.secondMass >> 3] = secondMass;
  const from = options.roughness === undefined
    ? module.read(responseAt, "ks_bounce", weighed, restitution, restingSpeed)
    : module.read(responseAt, "ks_bounce_rough", eventRecord(contact), (to) => {
      const at = to.room(roughnessAt.size);
      putRoughness(to, at, restitution, options.roughness!, "bounce");
      return at;
    });
  // A body that is not turned keeps its velocity.
  const after = (turns: number, velocity: number, before: Vec3) => (from.word(turns) ? from.vector(velocity) : before);
  return {
    [bounced]: true,
    first: after(responseAt.turnsFirst, responseAt.firstVelocity, contact.firstState.velocity),
    second: after(responseAt.turnsSecond, responseAt.secondVelocity, contact.secondState.velocity),
    ...(from.word(responseAt.spinsFirst) ? { firstAngularVelocity: from.vector(responseAt.firstAngularVelocity) } : {}),
    ...(from.word(responseAt.spinsSecond) ? { secondAngularVelocity: from.vector(responseAt.secondAngularVelocity) } : {}),
  };
}

/** Returns the ks_event of an event. */
export function eventRecord(event: Event): Float64Array {
  return event.view(0, eventAt.size / 8);
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
    const potential = module.handle("ks_step_potential_create", world.address, () => {
      const at = module.record(stepPotentialAt);
      module.putWord(at + stepPotentialAt.count, distances.length);
      module.putWord(at + stepPotentialAt.distances, module.numbers(distances));
      module.putWord(at + stepPotentialAt.energies, module.numbers(energies));
      module.putNumber(at + stepPotentialAt.outside, outside);
      module.putNumber(at + stepPotentialAt.restitution, restitution);
      return at;
    });
    const block = new Block(8, "ks_step_potential_destroy", potential);
    module.u64[block.address >> 3] = potential;
    super(block.address, "");
    this.block = block;
  }
  /** @internal Runs and games that have it keep this. */
  readonly block: Block;
  /** At a step the two gain or lose what their energy changes by, or are turned back; at a contact they bounce. */
  respond(event: Event): Answer {
    if (!(event instanceof Event)) throw new TypeError(`respond: event must be an Event, but is ${shown(event)}`);
    const from = theModule().read(responseAt, "ks_step_potential_respond", this.potential, eventRecord(event));
    return {
      ...(from.word(responseAt.turnsFirst) ? { first: from.vector(responseAt.firstVelocity) } : {}),
      ...(from.word(responseAt.turnsSecond) ? { second: from.vector(responseAt.secondVelocity) } : {}),
      ...(from.word(responseAt.turnedBack) ? { turnedBack: true } : {}),
    };
  }
  /** Returns the potential energy of a pair with this gap (length). */
  energy(gap: number): number {
    return theModule().number("ks_step_potential_energy", this.potential, gap);
  }
  private get potential(): bigint {
    return theModule().u64[Number(this.address) >> 3]!;
  }
}
