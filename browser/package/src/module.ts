/// <reference lib="esnext.disposable" preserve="true" />
// The WebAssembly module: the C library, its functions, and its errors as exceptions.
import { callOf, isNumeric, Memory, type Place } from "./memory.js";
import { checkKeys, type Keys, shown } from "./options.js";
import type { ErrorCode } from "./records.js";

/** An error of the library. Its message names the call, the argument, the body, and the wrong value. */
export class KinesphereError extends Error {
  override readonly name = "KinesphereError";
  constructor(
    message: string,
    readonly code: ErrorCode,
    /** The wrong argument, as the library spells it. */
    readonly argument: string,
    /** The body of the error, if there is one. */
    readonly body: number | null,
  ) {
    super(message);
  }
}

/** What a function of the module takes: numbers, addresses, and handles of objects, which have 64 bits. */
export type Value = number | bigint;
/** The id of a body as an argument. */
export class Id {
  constructor(readonly body: number) {}
}
/** The ids of bodies as an argument. */
export class Ids {
  constructor(readonly bodies: ArrayLike<number>) {}
}
/** What calls take: numbers, and what is copied to the memory of the module; a function returns an address there. */
export type Argument = Value | undefined | ArrayLike<number> | Id | Ids | ((module: Module) => Value);
type Exports = { memory: WebAssembly.Memory } & Record<string, (...values: Value[]) => number>;

/** A function of JavaScript that the module calls with numbers and addresses. */
export type Callback = (...values: number[]) => number | void;
/** A function that the module has for longer than a call, by its number. Whatever needs it keeps this object. */
export interface Kept { readonly number: number }

// Statuses of kinesphere.h that are no errors of callers.
const inUse = 3, bufferTooSmall = 6;

export class Module extends Memory {
  /** @internal The functions; call() and the like take care of arguments and errors. */
  readonly exports: Exports;
  private readonly decoder = new TextDecoder();
  /** Callbacks by number, the argument `user` of C. */
  private readonly callbacks = new Map<number, Callback>();
  private readonly forgottenCallbacks = new FinalizationRegistry<number>((number) => this.callbacks.delete(number));
  private readonly pointers = new Map<string, number>();
  /** Numbers of callbacks: positive ones of those that are kept, negative ones of those that running calls hold. */
  private lastKept = 0;
  private firstHeld = 0;
  private thrown: { value: unknown } | null = null;
  /** Objects of running calls, which may not be freed. */
  private readonly used: Value[] = [];
  /** Memory for the duration of calls, from `top` on. */
  private readonly arena: number;
  private top: number;
  /** What has to be done when the call that is being prepared, or runs, has returned. */
  private readonly ends: (() => void)[] = [];
  /** Where functions write one number. */
  private readonly result: number;
  private readonly capacities = new Map<string, number>();
  private written = "";

  /** @internal */
  constructor(compiled: WebAssembly.Module, readonly simd: boolean) {
    super();
    // An exception does not pass through the module, and is rethrown behind it.
    const asked = (...values: number[]): number => {
      try {
        return this.callbacks.get(values.at(-1)!)!(...values) ?? 0;
      } catch (value) {
        this.thrown ??= { value };
        return 1;
      }
    };
    const instance = new WebAssembly.Instance(compiled, {
      kinesphere: { probe: asked, rotate: asked, filter: asked, respond: asked, sink: asked, poll: asked },
      env: { emscripten_notify_memory_growth: () => this.see(this.exports.memory.buffer) },
      wasi_snapshot_preview1: {
        clock_time_get: (_clock: number, _precision: bigint, time: number) => {
          this.u64[time >> 3] = BigInt(Math.round(1e6 * performance.now()));
          return 0;
        },
        fd_close: () => 0,
        fd_seek: () => 0,
        fd_write: (_file: number, pieces: number, count: number, size: number) =>
          this.write(pieces, count, size),
        proc_exit: (): never => {
          this.thrown = { value: new Error(`kinesphere: the module stopped. ${this.written}`) };
          throw this.thrown.value;
        },
      },
    });
    this.exports = instance.exports as Exports;
    this.see(this.exports.memory.buffer);
    this.exports["_initialize"]!();
    this.arena = this.top = this.exports["malloc"]!(arenaSize);
    this.result = this.room(16);
  }

  /** Calls a function and returns its result. The caller throws what a callback threw (rethrow). */
  status(name: string, ...values: Argument[]): number {
    return this.invoke(name, values);
  }
  private invoke(name: string, values: Argument[]): number {
    const top = this.top, count = this.ends.length, used = this.used.length;
    try {
      for (let k = 0; k < values.length; ++k) {
        const value = values[k];
        if (typeof value !== "number" && typeof value !== "bigint") values[k] = this.argument(value, name);
      }
      return this.exports[name]!(...(values as Value[]));
    } finally {
      this.leave(top, count, used);
    }
  }
  /** Does the same, and throws what a callback threw. */
  call(name: string, ...values: Argument[]): number {
    const result = this.status(name, ...values);
    this.rethrow();
    return result;
  }
  /** Calls a function that returns a status or nothing. Throws its error. */
  check(name: string, ...values: Argument[]): void {
    this.settle(name, values);
  }
  private settle(name: string, values: Argument[]): void {
    this.judge(this.invoke(name, values), name);
  }
  /** Throws what a callback threw, or the error of this status. */
  private judge(status: number, name: string): void {
    if (this.thrown !== null) this.rethrow();
    if (status) throw this.error(status, name);
  }
  /** Calls a function that writes one number to its last argument, and returns it. */
  number(name: string, ...values: Argument[]): number {
    values.push(this.result);
    this.settle(name, values);
    return this.f64[this.result >> 3]!;
  }
  /** Does the same for a number of 32 bits: a count, a flag, an address. */
  word(name: string, ...values: Argument[]): number {
    values.push(this.result);
    this.settle(name, values);
    return this.i32[this.result >> 2]!;
  }
  /** Does the same for one of 64 bits, such as a handle. */
  handle(name: string, ...values: Argument[]): bigint {
    values.push(this.result);
    this.settle(name, values);
    return this.u64[this.result >> 3]!;
  }
  /** Does what number() does for a function that takes an object alone: that of a getter, which has to be quick. */
  numberOf(name: string, object: Value): number {
    this.judge(this.exports[name]!(object, this.result), name);
    return this.f64[this.result >> 3]!;
  }
  /** Does what word() does for such a function. */
  wordOf(name: string, object: Value): number {
    this.judge(this.exports[name]!(object, this.result), name);
    return this.i32[this.result >> 2]!;
  }
  /** Calls a function that writes a record to its last argument, and returns a copy. */
  read(layout: { readonly size: number }, name: string, ...values: Argument[]): Place {
    return this.with(() => {
      const at = this.record(layout);
      this.check(name, ...values, at);
      return this.copy(at, layout.size);
    });
  }
  /**
   * Calls a function whose last three arguments are an array, its capacity and the number of elements of this size.
   * Returns what take(address of the array, this number) returns.
   */
  fill<T>(size: number, take: (address: number, count: number) => T, name: string, ...values: Argument[]): T {
    return this.with(() => {
      for (let capacity = this.capacities.get(name) ?? 64; ;) {
        const count = this.room(8), array = this.room(capacity * size);
        const status = this.call(name, ...values, array, capacity, count);
        if (status === 0) return take(array, this.i32[count >> 2]!);
        if (status !== bufferTooSmall) throw this.error(status, name);
        capacity = Math.ceil(1.25 * this.i32[count >> 2]!);
        this.capacities.set(name, capacity);
      }
    });
  }
  /** Returns what such a function gives, each element as read() makes it. */
  rows<Row>(size: number, read: (row: Place) => Row, name: string, ...values: Argument[]): Row[] {
    const all = (address: number, count: number) =>
      Array.from({ length: count }, (_, k) => read(this.at(address + size * k)));
    return this.fill(size, all, name, ...values);
  }
  /** Returns the bytes that such a function gives. */
  filled(name: string, ...values: Argument[]): Uint8Array {
    return this.fill(1, (address, count) => this.bytes.slice(address, address + count), name, ...values);
  }
  /** Calls a function that answers with numbers, and returns a copy of them. */
  answer(name: string, ...values: Argument[]): Float64Array {
    this.check(name, ...values);
    return this.numbersAt(this.exports["answer_numbers"]!(), this.exports["answer_count"]!());
  }

  /** Returns the address of the function of this name in browser/module/callbacks.cpp. */
  pointer(name: string): number {
    const address = this.pointers.get(name) ?? this.exports[`callback_${name}`]!();
    this.pointers.set(name, address);
    return address;
  }
  /** Gives a callback a number until the returned object is forgotten. */
  keep(callback: Callback): Kept {
    const kept = { number: ++this.lastKept };
    this.callbacks.set(kept.number, callback);
    this.forgottenCallbacks.register(kept, kept.number);
    return kept;
  }
  /** Gives a callback a number until the call returns. */
  hold(callback: Callback): number {
    const number = --this.firstHeld;
    this.callbacks.set(number, callback);
    this.ends.push(() => this.callbacks.delete(this.firstHeld++));
    return number;
  }
  /** Returns the address of an object, which may not be freed until the call returns. */
  use(address: Value): Value {
    this.used.push(address);
    return address;
  }
  /** True if a callback threw during the last call, which then has to rethrow. */
  get hasThrown(): boolean {
    return this.thrown !== null;
  }
  /** Returns what a callback threw, once. */
  takeThrown(): { value: unknown } | null {
    const { thrown } = this;
    this.thrown = null;
    return thrown;
  }
  /** Throws what a callback threw. */
  rethrow(): void {
    const thrown = this.thrown && this.takeThrown();
    if (thrown) throw thrown.value;
  }

  /** Returns the error of a failed call of this function. */
  error(status: number, name: string): Error {
    if (status === inUse && /_(destroy|free)$/.test(name))
      return new Error("kinesphere: an object cannot be freed while it asks for states or answers");
    // Calls that only read ask nothing but pair filters.
    if (status === inUse)
      return new KinesphereError(`${callOf(name)}: a pair filter may not call it`, "filter_in_progress", "world", null);
    this.exports["ks_last_error_body"]!(this.result);
    const body = this.at(this.result).id(0);
    return new KinesphereError(
      this.text(this.exports["ks_last_error_message"]!()).replace(/^ks_\w+(?=:)/, callOf(name)),
      this.text(this.exports["ks_status_name"]!(status)) as ErrorCode,
      this.text(this.exports["ks_last_error_argument"]!()),
      body < 0 ? null : body,
    );
  }
  /** Calls a function that ends an object. */
  free(name: string, address: Value): void {
    if (this.used.includes(address)) throw this.error(inUse, name);
    const status = this.call(name, address);
    if (status) throw this.error(status, name);
  }

  /** Calls action(), and gives back the memory that it takes. */
  with<T>(action: () => T): T {
    const top = this.top, count = this.ends.length, used = this.used.length;
    try {
      return action();
    } finally {
      this.leave(top, count, used);
    }
  }
  private leave(top: number, count: number, used: number): void {
    this.top = top;
    this.used.length = used;
    while (this.ends.length > count) this.ends.pop()!();
  }
  /** Does this when the call has returned. */
  finally(end: () => void): void {
    this.ends.push(end);
  }

  // Memory until the call returns for which it is an argument, or the action of with().

  /** Returns the address of memory of any content. */
  room(size: number): number {
    const at = this.top, end = at + Math.max((size + 7) & ~7, 8);
    if (end <= this.arena + arenaSize) {
      this.top = end;
      return at;
    }
    const address = this.exports["malloc"]!(Math.max(size, 8));
    if (address === 0) throw new RangeError(`kinesphere: there is no memory for ${size} bytes`);
    this.ends.push(() => this.exports["free"]!(address));
    return address;
  }
  /** Returns a record of zeros, with its struct_size. */
  record({ size }: { readonly size: number }): number {
    const address = this.room(size);
    this.bytes.fill(0, address, address + size);
    this.i32[address >> 2] = size;
    return address;
  }
  /** A typed array would take null, as the second body of a wall event is, for 0; undefined becomes NaN. */
  numbers(values: ArrayLike<number>): number {
    if (Array.isArray(values))
      for (const value of values)
        if (!isNumeric(value)) throw new TypeError(`kinesphere: arrays must hold numbers, but one holds ${shown(value)}`);
    const address = this.room(8 * values.length);
    this.f64.set(values, address >> 3);
    return address;
  }
  words(values: ArrayLike<number>): number {
    const address = this.room(4 * values.length);
    this.i32.set(values, address >> 2);
    return address;
  }
  private argument(value: Argument | null, name: string): Value {
    if (value === undefined) return NaN;
    if (typeof value === "function") return value(this);
    if (value instanceof Id) {
      const address = this.room(12);
      this.putId(address, value.body, name);
      return address;
    }
    if (value instanceof Ids) {
      const address = this.room(12 * value.bodies.length);
      for (let k = 0; k < value.bodies.length; ++k) this.putId(address + 12 * k, value.bodies[k]!, name);
      return address;
    }
    if (value instanceof Uint8Array) {
      const address = this.room(value.length);
      this.bytes.set(value, address);
      return address;
    }
    if (Array.isArray(value) || ArrayBuffer.isView(value)) return this.numbers(value as ArrayLike<number>);
    throw new TypeError(`${callOf(name)}: arguments must be numbers, but one is ${shown(value)}`);
  }

  text(address: number): string {
    return this.decoder.decode(this.bytes.subarray(address, this.bytes.indexOf(0, address)));
  }

  private write(pieces: number, count: number, size: number): number {
    let sum = 0;
    for (let at = pieces >> 2; at < (pieces >> 2) + 2 * count; at += 2) {
      const address = this.i32[at]!, length = this.i32[at + 1]!;
      this.written += this.decoder.decode(this.bytes.subarray(address, address + length));
      sum += length;
    }
    this.putWord(size, sum);
    return 0;
  }
}

/** Size of the memory that calls take, in bytes. */
const arenaSize = 2 ** 18;

let loaded: Module | null = null;

/** Returns the module. Precondition: load() has finished. */
export function theModule(): Module {
  if (loaded === null) throw new Error("kinesphere: load() must be awaited before anything else is used");
  return loaded;
}

/** The smallest module with a SIMD instruction. */
const simdProbe = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

/** The smallest module with an exception. */
const exceptionProbe = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11,
]);

/** How load() gets the WebAssembly module. */
export interface LoadOptions {
  /** Whether to use the build with SIMD; by default if the engine supports it. */
  simd?: boolean;
  /**
   * In place of the package's file: the module itself, a WebAssembly.Module, its bytes, an ArrayBuffer or a typed array, or
   * an address to fetch it from, a URL or a text. (The types WebAssembly and BufferSource are those of the library `dom`,
   * which a project for Node.js lacks.)
   */
  source?: object | string;
}

const loadKeys: Keys<LoadOptions> = { simd: "boolean", source: true };

async function compiled(source: BufferSource | WebAssembly.Module | URL | string): Promise<WebAssembly.Module> {
  if (source instanceof WebAssembly.Module) return source;
  if (typeof source !== "string" && !(source instanceof URL)) return WebAssembly.compile(source);
  const url = new URL(source, import.meta.url);
  if (url.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    return WebAssembly.compile(new Uint8Array(await readFile(url)));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`kinesphere: ${url.href} could not be fetched: ${response.status}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

/**
 * Loads the library. Must be awaited once before anything else; further calls do nothing. Fetches only the file next to
 * this one.
 */
export async function load(options: LoadOptions = {}): Promise<void> {
  checkKeys(options, loadKeys, "options", "load");
  if (loaded !== null) return;
  if (!WebAssembly.validate(exceptionProbe))
    throw new Error("kinesphere: this engine is too old: its WebAssembly has no exceptions, as Chrome 95, Firefox 100, Safari " +
                    "15.2 and Node.js 17 have");
  const simd = options.simd ?? WebAssembly.validate(simdProbe);
  const own = simd
    ? new URL("./kinesphere-simd.wasm", import.meta.url)
    : new URL("./kinesphere.wasm", import.meta.url);
  const source = (options.source ?? own) as BufferSource | WebAssembly.Module | URL | string;
  const module = new Module(await compiled(source), simd);
  loaded ??= module;
}

/** Returns the library's version, such as "0.3.0". */
export function version(): string {
  const module = theModule();
  return module.text(module.call("ks_version"));
}

/** Returns true if the build with SIMD was loaded. Its results are equal. */
export function usesSimd(): boolean {
  return theModule().simd;
}

/** Frees objects without a call of free() when they are collected. */
const forgotten = new FinalizationRegistry<{ free: string; address: Value }>(({ free, address }) => {
  loaded?.call(free, address);
});

/** Memory of the module that stays, with the object that it belongs to, until this is forgotten. */
export class Block {
  readonly address: number;
  constructor(size: number, free = "", object: Value = 0) {
    this.address = theModule().call("malloc", size);
    forgotten.register(this, { free: "free", address: this.address });
    if (free !== "") forgotten.register(this, { free, address: object });
  }
}

/** An object in the module's memory. It is freed by free(), by `using`, or when it is collected. */
export abstract class Owned {
  #address: Value;
  readonly #free: string;
  protected constructor(address: Value, free: string) {
    this.#address = address;
    this.#free = free;
    if (free !== "") forgotten.register(this, { free, address }, this);
  }
  /** @internal Its address or its handle. */
  get address(): Value {
    if (this.#address === 0) throw new Error(`kinesphere: the ${this.constructor.name} has been freed`);
    return this.#address;
  }
  /** @internal Returns the address of an argument, which must be an object of this class. */
  static addressOf(object: Owned, kind: "World" | "Motion", what: string, call: string): Value {
    if (!(object instanceof Owned) || object.kind !== kind)
      throw new TypeError(`${call}: ${what} must be a ${kind}, but is ${shown(object)}`);
    return object.address;
  }
  /** @internal */
  protected get kind(): string {
    return "";
  }
  // The calls of the module with these names, for this object.
  /** @internal */
  protected check(name: string, ...values: Argument[]): void { theModule().check(name, this.address, ...values); }
  /** @internal */
  protected number(name: string, ...values: Argument[]): number {
    return values.length === 0 ? theModule().numberOf(name, this.address) : theModule().number(name, this.address, ...values);
  }
  /** @internal */
  protected word(name: string, ...values: Argument[]): number {
    return values.length === 0 ? theModule().wordOf(name, this.address) : theModule().word(name, this.address, ...values);
  }
  /** @internal */
  protected handle(name: string, ...values: Argument[]): bigint { return theModule().handle(name, this.address, ...values); }
  /** @internal */
  protected told(name: string, ...values: Argument[]): Float64Array { return theModule().answer(name, this.address, ...values); }
  /** @internal */
  protected filled(name: string, ...values: Argument[]): Uint8Array { return theModule().filled(name, this.address, ...values); }
  /** @internal */
  protected read(layout: { readonly size: number }, name: string, ...values: Argument[]): Place {
    return theModule().read(layout, name, this.address, ...values);
  }
  /** @internal */
  protected rows<Row>(size: number, read: (row: Place) => Row, name: string, ...values: Argument[]): Row[] {
    return theModule().rows(size, read, name, this.address, ...values);
  }

  /** Frees its memory. The object must not be used afterwards. */
  free(): void {
    if (this.#address === 0) return;
    if (this.#free !== "") theModule().free(this.#free, this.#address);
    forgotten.unregister(this);
    this.#address = 0;
  }
  /** Releases the memory at the end of a block that declares it with `using`. */
  [Symbol.dispose](): void {
    this.free();
  }
}
