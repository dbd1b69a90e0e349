// What two bodies do when they touch.
import type { Event, Vec3 } from "./event.js";
import { theModule } from "./module.js";

/** The velocities that the two have afterwards; that of a wall is zero. */
export interface Bounce {
  first: Vec3;
  second: Vec3;
}

/** What `bounce` and `settle` take beside the contact. */
export interface BounceOptions {
  /** >= 0, infinite for what stands still (walls do by themselves); by default 1. */
  firstMass?: number;
  secondMass?: number;
  /** From 0 to 1, which is the default: how much of the speed of approach is left. */
  restitution?: number;
  /** > 0 (length / time): bodies that come to rest in a heap, as `settle` in kinesphere/response.hpp has it. */
  restingSpeed?: number;
}

/** Of smooth spheres, at a contact that begins: what `bounce` and `settle` of the C++ library answer. Momentum is kept. */
export function bounce(contact: Event, options: BounceOptions = {}): Bounce {
  const { firstMass = 1, secondMass = 1, restitution = 1, restingSpeed = 0 } = options;
  const module = theModule();
  return module.with((scratch) => {
    const event = scratch.numbers(contact.numbers);
    const room = scratch.room(6);
    module.call("event_bounce", event, firstMass, secondMass, restitution, restingSpeed, room);
    const velocities = module.numbersAt(room, 6).slice();
    return { first: velocities.subarray(0, 3), second: velocities.subarray(3, 6) };
  });
}
