// Responses of two bodies to a contact.
import type { Event, Vec3 } from "./event.js";
import { theModule } from "./module.js";
import { checkKeys, type Keys } from "./options.js";

/** The velocities of the two bodies after the contact; that of a wall is zero. */
export interface Bounce {
  first: Vec3;
  second: Vec3;
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
}

const bounceKeys: Keys<BounceOptions> = { firstMass: true, secondMass: true, restitution: true, restingSpeed: true };

/**
 * Returns the response of smooth spheres to a begin, as `bounce` and `settle` of the C++ library do. Momentum is kept.
 */
export function bounce(contact: Event, options: BounceOptions = {}): Bounce {
  checkKeys(options, bounceKeys, "options", "bounce");
  const { firstMass = contact.firstMass, secondMass = contact.secondMass, restitution = 1, restingSpeed = 0 } = options;
  const module = theModule();
  return module.with((scratch) => {
    const event = scratch.numbers(contact.numbers);
    const room = scratch.room(6);
    module.call("event_bounce", event, firstMass, secondMass, restitution, restingSpeed, room);
    const velocities = module.numbersAt(room, 6).slice();
    return { first: velocities.subarray(0, 3), second: velocities.subarray(3, 6) };
  });
}
