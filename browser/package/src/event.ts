// Events of a world: contacts and the like, each at its exact time.
import { theModule } from "./module.js";
import { shown } from "./options.js";
import type { BodyId, State } from "./state.js";

const kinds = [
  "bound_violation", "contact_begin", "contact_end", "wall_begin", "wall_end", "zeno_guard", "sensor_enter",
  "sensor_leave", "woke",
] as const;
/** The names of kinds; the C++ header event.hpp explains each. */
export type EventKind = (typeof kinds)[number];
export const eventKinds: readonly EventKind[] = kinds;

const walls = ["x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"] as const;
/** A wall of the box, by axis and side. */
export type Wall = (typeof walls)[number];
export function wallOf(number: number): Wall | null {
  return number === 0 ? null : walls[number - 1]!;
}

const senses = ["neither", "first", "second", "both"] as const;

/** Properties of one body of an event. */
export interface BodyTraits {
  /** It never moves: `setVelocity` refuses it. */
  isStatic: boolean;
  /** It is not solid: it touches no other body. */
  isZone: boolean;
  /** It sleeps and stays asleep: false for contacts, which wake their bodies. */
  isSleeping: boolean;
}
function traitsOf(bits: number): BodyTraits {
  return { isStatic: (bits & 1) !== 0, isZone: (bits & 2) !== 0, isSleeping: (bits & 4) !== 0 };
}

/** Size of an event in numbers; see `put` in browser/module/exchange.cpp. */
export const eventNumbers = 53;

/** An event. It reads from numbers that never change. */
export class Event {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}

  get kind(): EventKind { return kinds[this.numbers[0]!]!; }
  get time(): number { return this.numbers[1]!; }
  /** The body, or the one of the two with the smaller id. */
  get first(): BodyId { return this.numbers[2]!; }
  /** The other body; null for walls, violations and bodies that wake. */
  get second(): BodyId | null { return this.numbers[3]! < 0 ? null : this.numbers[3]!; }
  get wall(): Wall | null { return wallOf(this.numbers[4]!); }
  /** One of the two touched another body less than the Zeno interval ago. A response should take no energy here. */
  get repeated(): boolean { return this.numbers[5] === 1; }
  /** Each of the two has had 64 contacts at this instant, as if stuck: a response should part them, or stop both. */
  get jammed(): boolean { return this.numbers[6] === 1; }
  /**
   * Of begins: the two have touched since an earlier begin, and approach again. To count contacts, count the others.
   */
  get alreadyTouching(): boolean { return this.numbers[37] === 1; }
  /** For sensor events: the body or bodies with the sensor. */
  get senses(): (typeof senses)[number] { return senses[this.numbers[7]!]!; }
  /** States at `time`; in periodic space, of the nearest images. */
  get firstState(): State { return this.state(8); }
  get secondState(): State { return this.state(14); }
  /** The middle of the gap. */
  get point(): Float64Array { return this.numbers.subarray(20, 23); }
  /** Unit vector from the first towards the second, or the wall. */
  get normal(): Float64Array { return this.numbers.subarray(23, 26); }
  /** Distance between the surfaces; negative if they overlap. */
  get gap(): number { return this.numbers[26]!; }
  get approachSpeed(): number { return this.numbers[27]!; }
  /** For violations: how far the report lies outside the limits of the body. */
  get positionExcess(): number { return this.numbers[28]!; }
  get velocityExcess(): number { return this.numbers[29]!; }
  /** For violations: the acceleration limit that the body has from now on (length / time^2). */
  get accelerationLimit(): number { return this.numbers[52]!; }
  /** For sensor events: the crossed distance. */
  get distance(): number { return this.numbers[30]!; }
  /** The userData of the bodies. Exact up to 2^53. */
  get firstUserData(): number { return this.numbers[31]!; }
  get secondUserData(): number { return this.numbers[32]!; }

  /** The masses of the bodies; infinite for a static body and a wall. */
  get firstMass(): number { return this.numbers[33]!; }
  get secondMass(): number { return this.numbers[34]!; }
  get firstTraits(): BodyTraits { return traitsOf(this.numbers[35]!); }
  /** All false for a wall. */
  get secondTraits(): BodyTraits { return traitsOf(this.numbers[36]!); }

  /** Of rigid bodies: the number of the part at the contact; of a mesh: that of the triangle; 0 for all others. */
  get firstPart(): number { return this.numbers[38]!; }
  get secondPart(): number { return this.numbers[39]!; }
  /** Of rigid bodies (radians / time); zero for all others. */
  get firstAngularVelocity(): Float64Array { return this.numbers.subarray(40, 43); }
  get secondAngularVelocity(): Float64Array { return this.numbers.subarray(43, 46); }
  /** Change of the angular velocity of a rigid body by a unit impulse along the normal; zero for all others. */
  get firstSpinGain(): Float64Array { return this.numbers.subarray(46, 49); }
  get secondSpinGain(): Float64Array { return this.numbers.subarray(49, 52); }

  /** Returns the other body of the pair; null if there is none, or `body` has no part in the event. */
  partnerOf(body: BodyId): BodyId | null {
    return body === this.first ? this.second : body === this.second ? this.first : null;
  }
  /** For sensor events: true if this body senses the other, which may sense it, too. */
  isSensedBy(body: BodyId): boolean {
    const { senses } = this;
    return (body === this.first && (senses === "first" || senses === "both")) ||
           (body === this.second && (senses === "second" || senses === "both"));
  }

  private state(from: number): State {
    return {
      position: this.numbers.subarray(from, from + 3),
      velocity: this.numbers.subarray(from + 3, from + 6),
    };
  }
}

/** Many events, in order. */
export class Events implements Iterable<Event> {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}
  get length(): number { return this.numbers.length / eventNumbers; }
  /** Returns the event at a place, from 0, or undefined beyond the last. */
  at(place: number): Event | undefined {
    const from = place < 0 ? place + this.length : place;
    if (!(from >= 0 && from < this.length)) return undefined;
    return new Event(this.numbers.subarray(from * eventNumbers, (from + 1) * eventNumbers));
  }
  /** Goes through all events in order. */
  *[Symbol.iterator](): Iterator<Event> {
    for (let k = 0; k < this.length; ++k) yield this.at(k)!;
  }
}

/**
 * One number for all events of a run, equal to the library's EventHash and the program's `hash` line: runs with equal
 * numbers have equal events, to the last bit.
 */
export class EventHash {
  /** Two numbers of 64 bits and the value, each as two halves. */
  private parts = new Float64Array(6);

  /** Adds one event or several. */
  add(events: Event | Events): this {
    if (!(events instanceof Event || events instanceof Events))
      throw new TypeError(`EventHash.add: events must be an Event or Events, but is ${shown(events)}`);
    const module = theModule();
    module.with((scratch) => {
      const parts = scratch.numbers(this.parts);
      const numbers = events.numbers;
      module.call("hash_add", parts, scratch.numbers(numbers), numbers.length / eventNumbers);
      this.parts = module.numbersAt(parts, 6).slice();
    });
    return this;
  }
  /** 16 hexadecimal digits. */
  get value(): string {
    if (this.parts[2] === 0 && this.parts[3] === 0) this.add(new Events(new Float64Array()));
    const half = (k: number) => this.parts[k]!.toString(16).padStart(8, "0");
    return half(5) + half(4);
  }
  get count(): number {
    return this.parts[2]! + this.parts[3]! * 2 ** 32;
  }
  /** Returns a copy. */
  clone(): EventHash {
    const copy = new EventHash();
    copy.parts = this.parts.slice();
    return copy;
  }
}
