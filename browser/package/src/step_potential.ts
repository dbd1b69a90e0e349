// Potentials of steps between pairs of bodies.
import type { Answer } from "./asking.js";
import { Event } from "./event.js";
import { Owned, theModule } from "./module.js";
import { checkKeys, type Keys, requireNumbers, shown } from "./options.js";
import type { WorldView } from "./world.js";

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

const keys: Keys<StepPotentialDefinition> = { distances: true, energies: true, outside: "number", restitution: "number" };

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
    checkKeys(definition, keys, "definition", call);
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
