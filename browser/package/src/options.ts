// Keys of option objects: a misspelled one is refused, since its value would silently be the default. Data without
// optional keys, such as states and tracks, may have more.

/** All keys of an option object. A list that lacks one does not compile. */
export type Keys<Options> = Readonly<Record<keyof Options, true>>;

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

/**
 * The one place where option objects are checked. Throws TypeError for a key that is not known, with the nearest known one; and for what is no
 * object.
 */
export function checkKeys<Options extends object>(given: Options, known: Keys<Options>, what: string, call: string): void {
  if (typeof given !== "object" || given === null)
    throw new TypeError(`${call}: ${what} must be an object with the keys ${Object.keys(known).join(", ")}, but is ${given}`);
  for (const key of Object.keys(given)) {
    if (Object.hasOwn(known, key)) continue;
    const distance = (name: string) => editDistance(plain(key), plain(name));
    const nearest = Object.keys(known).reduce((best, name) => (distance(name) < distance(best) ? name : best));
    throw new TypeError(`${call}: ${what} has no key ${key}; the nearest is ${nearest}`);
  }
}
