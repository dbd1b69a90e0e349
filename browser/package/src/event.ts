// Events of a world: contacts and the like, each at its exact time.
import { theModule } from "./module.js";
import { shown } from "./options.js";
import { EventFields, eventSize } from "./records.js";
import type { BodyId } from "./state.js";

/** An event. It reads from numbers that never change. */
export class Event extends EventFields {
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
}

/** Many events, in order. */
export class Events implements Iterable<Event> {
  /** @internal */
  constructor(readonly numbers: Float64Array) {}
  get length(): number { return this.numbers.length / eventSize; }
  /** Returns the event at a place, from 0, or undefined beyond the last. */
  at(place: number): Event | undefined {
    const from = place < 0 ? place + this.length : place;
    if (!(from >= 0 && from < this.length)) return undefined;
    return new Event(this.numbers.subarray(from * eventSize, (from + 1) * eventSize));
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
      module.call("hash_add", parts, scratch.numbers(numbers), numbers.length / eventSize);
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
