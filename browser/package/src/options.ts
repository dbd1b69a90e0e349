// Keys and kinds of values of option objects: a misspelled key is refused, since its value would silently be the default,
// and so is a text where a number belongs, since JavaScript would convert it. Data without optional keys, such as states
// and tracks, may have more keys.

/** What a value must be for `typeof`; true: it is checked where it is used. */
type Kind = "number" | "boolean" | true;
type KindOf<Value> = [Value] extends [number] ? "number" : [Value] extends [boolean] ? "boolean" : true;
/** All keys of an option object, and the kinds of their values. A list that lacks one does not compile. */
export type Keys<Options> = { readonly [Key in keyof Options]-?: KindOf<NonNullable<Options[Key]>> };

/** Returns a value as an error shows it. */
export function shown(value: unknown): string {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value === "bigint") return `${value}n`;
  if (typeof value === "function") return "a function";
  if (typeof value !== "object" || value === null) return String(value);
  if (Array.isArray(value)) return "an array";
  const name = value.constructor?.name;
  return name === undefined || name === "Object" ? "an object" : `an object of class ${name}`;
}

/** Returns the number. Throws TypeError for anything else. */
export function numberOf(value: number, what: string, call: string): number {
  if (typeof value !== "number") throw new TypeError(`${call}: ${what} must be a number, but is ${shown(value)}`);
  return value;
}

/** Returns the number. Throws RangeError unless it is a whole one from 0 to `most`. */
export function whole(value: number, most: number, what: string, call: string): number {
  if (!Number.isInteger(value) || value < 0 || value > most)
    throw new RangeError(`${call}: ${what} must be a whole number from 0 to ${most}, but is ${shown(value)}`);
  return value;
}

/**
 * Throws TypeError unless all values are numbers, and names the first other one: a typed array of the module would take a
 * text, null or a list for a number.
 */
export function requireNumbers(values: ArrayLike<number>, what: string, call: string): void {
  if (typeof values?.length !== "number")
    throw new TypeError(`${call}: ${what} must be an array, but is ${shown(values)}`);
  const isTyped = ArrayBuffer.isView(values) && !(values instanceof BigInt64Array || values instanceof BigUint64Array);
  for (let k = 0; !isTyped && k < values.length; ++k) {
    if (typeof values[k] === "number") continue;
    const hint = Array.isArray(values[k]) ? ": all numbers stand in one array, x, y and z of one after the other" : "";
    throw new TypeError(`${call}: ${what}[${k}] must be a number, but is ${shown(values[k])}${hint}`);
  }
}

/** Throws TypeError for anything but bytes, also for the ArrayBuffer of a file or a response. */
export function requireBytes(values: Uint8Array, what: string, call: string): void {
  if (!(values instanceof Uint8Array))
    throw new TypeError(`${call}: ${what} must be a Uint8Array, but is ${shown(values)}`);
}

/** Spellings of other languages count as equal: contact_tolerance is contactTolerance. */
function plain(key: string): string {
  return key.replaceAll("_", "").toLowerCase();
}

/** Returns the least number of letters to insert, remove or replace. */
function editDistance(one: string, other: string): number {
  let row = Array.from({ length: other.length + 1 }, (_, k) => k);
  for (let i = 1; i <= one.length; ++i) {
    const next = [i];
    for (let k = 1; k <= other.length; ++k)
      next.push(Math.min(row[k]! + 1, next[k - 1]! + 1, row[k - 1]! + (one[i - 1] === other[k - 1] ? 0 : 1)));
    row = next;
  }
  return row[other.length]!;
}

/** Option objects that are an argument, whose keys need no name before them in an error. */
const wholes: ReadonlySet<string> = new Set([
  "answer", "bodies", "body", "definition", "limits", "options", "part", "report", "reports", "settings", "shape", "start",
]);

/**
 * The one place where option objects are checked. Throws TypeError for a key that is not known, with the nearest known
 * one; for a value of another kind; for null and undefined, as of a misspelled `settings.raduis`; and for what is no object.
 */
export function checkKeys<Options extends object>(
  given: Options, known: Keys<Options>, what: string, call: string, mayBeUndefined = false,
): void {
  if (typeof given !== "object" || given === null || Array.isArray(given))
    throw new TypeError(
      `${call}: ${what} must be an object with the keys ${Object.keys(known).join(", ")}, but is ${shown(given)}`);
  for (const [key, value] of Object.entries(given)) {
    if (!Object.hasOwn(known, key)) {
      const distance = (name: string) => editDistance(plain(key), plain(name));
      const nearest = Object.keys(known).reduce((best, name) => (distance(name) < distance(best) ? name : best));
      throw new TypeError(`${call}: ${what} has no key ${key}; the nearest is ${nearest}`);
    }
    const kind = (known as Readonly<Record<string, Kind>>)[key];
    if (value === undefined && mayBeUndefined) continue;
    const name = wholes.has(what) ? key : `${what}.${key}`;
    if (value === null || value === undefined)
      throw new TypeError(`${call}: ${name} must not be ${value}: leave it out instead`);
    if (kind !== true && typeof value !== kind)
      throw new TypeError(`${call}: ${name} must be a ${kind}, but is ${shown(value)}`);
  }
}

/** Throws TypeError for the answer of an async function: the library needs it at once. */
export function refusePromise(answer: unknown, what: string): void {
  if (answer instanceof Promise) {
    answer.catch(() => {});
    throw new TypeError(`${what} must not be an async function: its answer is needed at once`);
  }
}
