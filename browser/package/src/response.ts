// Responses of two bodies to a contact.
import { Event } from "./event.js";
import { theModule } from "./module.js";
import { checkKeys, type Keys, shown } from "./options.js";
import type { Vec3 } from "./state.js";

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
