/// <reference lib="esnext.disposable" preserve="true" />
// The WebAssembly module: its memory, its functions, and its errors as exceptions.
import type { PairFilter } from "./filter.js";
import { checkKeys, type Keys, refusePromise, shown } from "./options.js";
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

/** The exports of the module. Addresses and counts are numbers; see the folder browser/module. */
type Exports = { memory: WebAssembly.Memory } & Record<string, (...values: number[]) => number>;

/** The callbacks of the module during a call. */
interface Callbacks {
  probe(count: number, ids: number, time: number, states: number): void;
  respond(event: number, response: number): void;
  stop(event: number): void;
  rotate(count: number, ids: number, time: number, rotations: number): void;
  poll(count: number, tracks: number, time: number, reports: number): void;
}

/** A pair filter in the module. The worlds that have it keep this object. */
export interface KeptFilter { readonly number: number }

/** Memory of the module for the duration of a call. */
export class Scratch {
  private readonly taken: number[] = [];
  constructor(private readonly module: Module) {}
  /** A typed array would take null, as the second body of a wall event is, for 0; undefined becomes NaN. */
  numbers(values: ArrayLike<number>): number {
    if (Array.isArray(values))
      for (const value of values)
        if (!isNumeric(value)) throw new TypeError(`kinesphere: arrays must hold numbers, but one holds ${shown(value)}`);
    const address = this.take(8 * values.length);
    this.module.numbersAt(address, values.length).set(values);
    return address;
  }
  bytes(values: Uint8Array): number {
    const address = this.take(values.length);
    new Uint8Array(this.module.memory.buffer, address, values.length).set(values);
    return address;
  }
  addresses(values: readonly number[]): number {
    return this.bytes(new Uint8Array(Uint32Array.from(values).buffer));
  }
  room(count: number): number {
    return this.take(8 * count);
  }
  private take(size: number): number {
    const address = this.module.call("allocate", Math.max(size, 8));
    if (address === 0) throw new RangeError(`kinesphere: there is no memory for ${size} bytes`);
    this.taken.push(address);
    return address;
  }
  release(): void {
    for (const address of this.taken) this.module.call("release", address);
  }
}

/** Returns the name of the call that uses this export: setVelocity for world_set_velocity. */
function callOf(name: string): string {
  const [, ...words] = name.split("_");
  return words.map((word, k) => (k === 0 ? word : word[0]!.toUpperCase() + word.slice(1))).join("");
}

/** Returns true for what the library can judge: a number, or undefined, which is NaN for it. */
function isNumeric(value: unknown): boolean {
  return typeof value === "number" || value === undefined;
}

export class Module {
  /** @internal */
  readonly memory: WebAssembly.Memory;
  private readonly exports: Exports;
  private readonly decoder = new TextDecoder();
  /** Running calls, the innermost last: their callbacks and the addresses of their objects. */
  private readonly asking: { callbacks: Partial<Callbacks>; addresses: readonly number[] }[] = [];
  private thrown: { value: unknown } | null = null;
  /** Pair filters by number: any call of a world may ask them. */
  private readonly filters = new Map<number, PairFilter>();
  private readonly forgottenFilters = new FinalizationRegistry<number>((number) => this.filters.delete(number));
  private lastFilter = 0;
  private filterThrown: { value: unknown } | null = null;
  private filtering = 0;
  private written = "";
  /** The last called export that is no part of reading an error. */
  private called = "";

  readonly simd: boolean;

  /** @internal */
  constructor(compiled: WebAssembly.Module, simd: boolean) {
    this.simd = simd;
    // Returns whether the callback did not throw: an exception does not pass through the module, and is rethrown behind
    // it.
    const asked = <K extends keyof Callbacks>(name: K) => (...values: Parameters<Callbacks[K]>): number => {
      try {
        (this.asking.at(-1)!.callbacks[name] as (...values: unknown[]) => void)(...values);
        return 1;
      } catch (value) {
        this.thrown ??= { value };
        return 0;
      }
    };
    const instance = new WebAssembly.Instance(compiled, {
      kinesphere: {
        probe: asked("probe"), respond: asked("respond"), stop: asked("stop"), rotate: asked("rotate"), poll: asked("poll"),
        filter: (number: number, first: number, second: number) => this.mayTouch(number, first, second) ? 1 : 0,
      },
      env: { emscripten_notify_memory_growth: () => {} },
      wasi_snapshot_preview1: {
        clock_time_get: () => 0,
        fd_close: () => 0,
        fd_seek: () => 0,
        fd_write: (_file: number, pieces: number, count: number, size: number) =>
          this.write(pieces, count, size),
        proc_exit: (): never => {
          throw new Error(`kinesphere: the module stopped. ${this.written}`);
        },
      },
    });
    this.exports = instance.exports as Exports;
    this.memory = this.exports.memory;
    this.exports["_initialize"]!();
  }

  /** The module would take null, as the second body of a wall event is, for body 0; undefined becomes NaN. */
  call(name: string, ...values: number[]): number {
    for (const value of values)
      if (!isNumeric(value)) throw new TypeError(`${callOf(name)}: arguments must be numbers, but one is ${shown(value)}`);
    if (!name.startsWith("error_") && name !== "release") this.called = name;
    const result = this.exports[name]!(...values);
    // World.advance() has to keep its event first.
    if (name !== "world_advance" && !name.startsWith("answer_")) this.rethrowOfFilter();
    return result;
  }

  /** Keeps a pair filter until the returned object is forgotten, and gives it a number. */
  keepFilter(filter: PairFilter): KeptFilter {
    const kept = { number: this.lastFilter++ };
    this.filters.set(kept.number, filter);
    this.forgottenFilters.register(kept, kept.number);
    return kept;
  }
  /** True if a pair filter threw during the last call, which then has to rethrow. */
  get filterHasThrown(): boolean {
    return this.filterThrown !== null;
  }
  /** Throws what a pair filter threw during the last call. */
  rethrowOfFilter(): void {
    if (this.filterThrown === null) return;
    const { value } = this.filterThrown;
    this.filterThrown = null;
    throw value;
  }
  private mayTouch(number: number, first: number, second: number): boolean {
    if (this.filterThrown !== null) return true;
    ++this.filtering;
    try {
      const may: unknown = this.filters.get(number)!(first, second);
      refusePromise(may, "pair filter");
      if (typeof may !== "boolean") throw new TypeError(`pair filter: the result must be a boolean, but is ${shown(may)}`);
      return may;
    } catch (value) {
      this.filterThrown = { value };
      return true;
    } finally {
      --this.filtering;
    }
  }

  /** Makes a call with callbacks, which may not free the objects at these addresses. Rethrows what a callback threw. */
  callWith(callbacks: Partial<Callbacks>, addresses: readonly number[], name: string, ...values: number[]): number {
    this.asking.push({ callbacks, addresses });
    const before = this.thrown;
    this.thrown = null;
    try {
      const result = this.call(name, ...values);
      const thrown = this.thrown as { value: unknown } | null;
      if (thrown !== null) throw thrown.value;
      return result;
    } finally {
      this.asking.pop();
      this.thrown = before;
    }
  }

  /** True if the object is, or may be, in the middle of a call. */
  isInUse(address: number): boolean {
    return this.filtering > 0 || this.asking.some(({ addresses }) => addresses.includes(address));
  }

  /** Returns the error of the last failed call. World::change() of C++ is several functions here. */
  error(): KinesphereError {
    const body = this.call("error_body");
    return new KinesphereError(
      this.text(this.call("error_message")).replace(/^change(?=:)/, callOf(this.called)),
      this.text(this.call("error_code")) as ErrorCode,
      this.text(this.call("error_argument")),
      body < 0 ? null : body,
    );
  }
  /** Throws the error of a call that returned 0 or false. */
  require(result: number): number {
    if (result === 0) throw this.error();
    return result;
  }

  with<T>(action: (scratch: Scratch) => T): T {
    const scratch = new Scratch(this);
    try {
      return action(scratch);
    } finally {
      scratch.release();
    }
  }

  /** Returns a view that is valid until the module is called again. */
  numbersAt(address: number, count: number): Float64Array {
    return new Float64Array(this.memory.buffer, address, count);
  }
  /** Returns a copy of the last call's answer. */
  answer(): Float64Array {
    return this.numbersAt(this.call("answer_numbers"), this.call("answer_count")).slice();
  }
  bytes(): Uint8Array {
    return new Uint8Array(this.memory.buffer, this.call("bytes"), this.call("byte_count")).slice();
  }
  text(address: number): string {
    const bytes = new Uint8Array(this.memory.buffer, address);
    return this.decoder.decode(bytes.subarray(0, bytes.indexOf(0)));
  }
  textOfBytes(): string {
    return this.decoder.decode(this.bytes());
  }

  private write(pieces: number, count: number, size: number): number {
    const view = new DataView(this.memory.buffer);
    let sum = 0;
    for (let k = 0; k < count; ++k) {
      const address = view.getUint32(pieces + 8 * k, true);
      const length = view.getUint32(pieces + 8 * k + 4, true);
      this.written += this.decoder.decode(new Uint8Array(this.memory.buffer, address, length));
      sum += length;
    }
    view.setUint32(size, sum, true);
    return 0;
  }
}

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
  return module.text(module.call("library_version"));
}

/** Returns true if the build with SIMD was loaded. Its results are equal. */
export function usesSimd(): boolean {
  return theModule().simd;
}

/** Frees objects without a call of free() when they are collected. */
const forgotten = new FinalizationRegistry<{ free: string; address: number }>(({ free, address }) => {
  loaded?.call(free, address);
});

/** An object in the module's memory. It is freed by free(), by `using`, or when it is collected. */
export abstract class Owned {
  #address: number;
  readonly #free: string;
  protected constructor(address: number, free: string) {
    this.#address = address;
    this.#free = free;
    if (address !== 0) forgotten.register(this, { free, address }, this);
  }
  /** @internal */
  get address(): number {
    if (this.#address === 0) throw new Error(`kinesphere: the ${this.constructor.name} has been freed`);
    return this.#address;
  }
  /**
   * @internal Returns the address of an argument, which must be an object of this kind: the module would take the
   * address of any other for one.
   */
  static addressOf(object: Owned, kind: "World" | "Motion", what: string, call: string): number {
    if (!(object instanceof Owned) || object.#free !== `${kind.toLowerCase()}_free`)
      throw new TypeError(`${call}: ${what} must be a ${kind}, but is ${shown(object)}`);
    return object.address;
  }
  /** Frees its memory. The object must not be used afterwards. */
  free(): void {
    if (this.#address === 0) return;
    if (theModule().isInUse(this.#address))
      throw new Error("kinesphere: an object cannot be freed while it asks for states or answers");
    forgotten.unregister(this);
    theModule().call(this.#free, this.#address);
    this.#address = 0;
  }
  /** Releases the memory at the end of a block that declares it with `using`. */
  [Symbol.dispose](): void {
    this.free();
  }
}
