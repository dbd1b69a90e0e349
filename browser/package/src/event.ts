// Events of a world: contacts and the like, each at its exact time.
import type { Place } from "./memory.js";
import { type Module, theModule } from "./module.js";
import { shown } from "./options.js";
import { eventAt, EventFields } from "./records.js";
import type { BodyId } from "./state.js";

/** An event, in a copy that never changes. */
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

let room: number | null = null;
const hashSize = 16;
/** @internal Returns the address of memory that stays, for one event and a ks_event_hash behind it. */
export function eventRoom(module: Module): number {
  return room ??= module.call("malloc", eventAt.size + hashSize);
}

/** Returns a copy of the event at an address of the module. */
export function eventFrom(module: Module, address: number): Event {
  const { numbers, words } = module.copy(address, eventAt.size);
  return new Event(numbers, words);
}

/** Many events, in order. */
export class Events implements Iterable<Event> {
  /** @internal */
  readonly records: Place;
  /** @internal */
  constructor(records: Place) {
    this.records = records;
  }
  get length(): number { return 8 * this.records.numbers.length / eventAt.size; }
  /** Returns the event at a place, from 0, or undefined beyond the last. */
  at(place: number): Event | undefined {
    const from = place < 0 ? place + this.length : place;
    if (!(from >= 0 && from < this.length)) return undefined;
    return new Event(this.records.numbers, this.records.words, from * eventAt.size);
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
  /** A ks_event_hash. */
  private readonly parts = new Int32Array(hashSize / 4);

  /** Adds one event or several. */
  add(events: Event | Events): this {
    if (!(events instanceof Event || events instanceof Events))
      throw new TypeError(`EventHash.add: events must be an Event or Events, but is ${shown(events)}`);
    const module = theModule();
    const { numbers, from } = events instanceof Event ? events : events.records;
    const [first, count] = events instanceof Event ? [from >> 3, 1] : [0, events.length];
    const at = eventRoom(module), parts = at + eventAt.size, size = eventAt.size / 8;
    const add = module.exports["ks_event_hash_add"]!;
    module.i32.set(this.parts, parts >> 2);
    for (let k = first; k < first + count * size; k += size) {
      module.f64.set(numbers.subarray(k, k + size), at >> 3);
      add(parts, at);
    }
    for (let k = 0; k < this.parts.length; ++k) this.parts[k] = module.i32[(parts >> 2) + k]!;
    return this;
  }
  /** 16 hexadecimal digits. */
  get value(): string {
    return hexOf(theModule().handle("ks_event_hash_value", (module) => module.words(this.parts)));
  }
  get count(): number {
    return Number(new BigUint64Array(this.parts.buffer)[1]);
  }
  /** Returns a copy. */
  clone(): EventHash {
    const copy = new EventHash();
    copy.parts.set(this.parts);
    return copy;
  }
}

/** Returns 16 hexadecimal digits. */
export function hexOf(number: bigint): string {
  return number.toString(16).padStart(16, "0");
}
