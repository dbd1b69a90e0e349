// The memory of the module, in which records lie as in C: addresses and offsets are in bytes.
import { shown } from "./options.js";
import type { State } from "./state.js";

const twoTo32 = 2 ** 32;

/** Returns true for what the library can judge: a number, or undefined, which is NaN for it. */
export function isNumeric(value: unknown): boolean {
  return typeof value === "number" || value === undefined;
}

/**
 * Returns the name of the call that uses this function of the module: setVelocity for ks_world_set_velocity, and itself for
 * the name of a call.
 */
export function callOf(name: string): string {
  const [first, ...words] = name.replace(/^ks_/, "").split("_");
  return words.map((word, k) => (k === 0 ? word : word[0]!.toUpperCase() + word.slice(1))).join("") || first!;
}

/** A record to be read: in the memory of the module, until that is called again, or in a copy. */
export class Place {
  /** @internal Both are of one buffer, in which the record begins at `from`. */
  constructor(
    /** @internal */ readonly numbers: Float64Array, /** @internal */ readonly words: Int32Array,
    /** @internal */ readonly from = 0,
  ) {}

  /** @internal */
  number(at: number): number { return this.numbers[(this.from + at) >> 3]!; }
  /** @internal */
  word(at: number): number { return this.words[(this.from + at) >> 2]!; }
  /** @internal A number of 64 bits, exact up to 2^53; -1 for all bits. */
  whole(at: number): number {
    const low = this.word(at), high = this.word(at + 4);
    return low === -1 && high === -1 ? -1 : (low >>> 0) + twoTo32 * (high >>> 0);
  }
  /** @internal A number of 64 bits with a sign, exact up to 2^53. */
  signed(at: number): number { return (this.word(at) >>> 0) + twoTo32 * this.word(at + 4); }
  /** @internal The id of a body, its index and, above 32 bits, its generation; -1 for none. */
  id(at: number): number {
    const index = this.word(at), generation = this.word(at + 4);
    return index === -1 && generation === 0 ? -1 : (index >>> 0) + twoTo32 * (generation >>> 0);
  }
  /** @internal A view of `count` numbers. */
  view(at: number, count: number): Float64Array {
    const first = (this.from + at) >> 3;
    return this.numbers.subarray(first, first + count);
  }
  /** @internal */
  vector(at: number): Float64Array { return this.view(at, 3); }
  /** @internal */
  state(at: number): State { return { position: this.vector(at), velocity: this.vector(at + 24) }; }
}

export class Memory {
  f64!: Float64Array;
  i32!: Int32Array;
  bytes!: Uint8Array;
  u64!: BigUint64Array;

  /** Has to be called when the memory has grown. */
  protected see(buffer: ArrayBufferLike): void {
    this.f64 = new Float64Array(buffer);
    this.i32 = new Int32Array(buffer);
    this.bytes = new Uint8Array(buffer);
    this.u64 = new BigUint64Array(buffer);
  }

  /** Returns the record at an address, until the module is called again. */
  at(address: number): Place {
    return new Place(this.f64, this.i32, address);
  }
  /** Returns a copy of memory that is a multiple of 8 bytes. */
  copy(address: number, size: number): Place {
    const numbers = this.f64.slice(address >> 3, (address + size) >> 3);
    return new Place(numbers, new Int32Array(numbers.buffer));
  }
  /** Returns a copy of numbers. */
  numbersAt(address: number, count: number): Float64Array {
    return this.f64.slice(address >> 3, (address >> 3) + count);
  }
  /** Returns the ids of bodies. */
  idsAt(address: number, count: number): Float64Array {
    const ids = new Float64Array(count);
    for (let k = 0, at = address >> 2; k < count; ++k, at += 3)
      ids[k] = (this.i32[at]! >>> 0) + twoTo32 * (this.i32[at + 1]! >>> 0);
    return ids;
  }

  putNumber(at: number, value: number): void { this.f64[at >> 3] = value; }
  putWord(at: number, value: number): void { this.i32[at >> 2] = value; }
  /** Writes a number of 64 bits, up to 2^53, or all bits for -1. */
  putWhole(at: number, value: number): void {
    this.i32[at >> 2] = value;
    this.i32[(at + 4) >> 2] = Math.floor(value / twoTo32);
  }
  putVector(at: number, values: ArrayLike<number>): void { this.f64.set(values, at >> 3); }
  /** Writes the id of a body; for a number that is none, that of a body that no world has. */
  putId(at: number, id: number, call: string): void {
    if (!isNumeric(id)) throw new TypeError(`${callOf(call)}: arguments must be numbers, but one is ${shown(id)}`);
    const isId = id >= 0 && id < twoTo32 * twoTo32 && Number.isInteger(id);
    this.i32[at >> 2] = isId ? id : -1;
    this.i32[(at + 4) >> 2] = isId ? Math.floor(id / twoTo32) : 0;
    this.i32[(at + 8) >> 2] = 0;
  }
}
