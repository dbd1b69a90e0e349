// Filters of bodies, and of pairs of them.
import type { Memory, Place } from "./memory.js";
import type { Kept, Module } from "./module.js";
import { checkKeys, type Keys, refusePromise, shown, whole } from "./options.js";

/**
 * Which bodies a body may touch: two of one group may if it is positive, and may not if it is negative; any other pair
 * may if the category of each has a bit in the mask of the other. Static bodies and zones have one, too, and
 * walls may have one (WorldDefinition.wallFilter).
 */
export interface Filter {
  /** Bits, up to 2^53; by default 1. */
  category?: number;
  /** Bits, up to 2^53; by default -1, the mask of all. */
  mask?: number;
  /** Of 32 bits; by default 0, no group. */
  group?: number;
}

/**
 * Returns whether two bodies whose filters let them touch may do so: the same for both orders, and for the same two until
 * World.setPairFilter() or refreshFilter() is called. It may read the world that asks (body, touching, contains, time and
 * the like), and call nothing else of it.
 */
export type PairFilter = (first: number, second: number) => boolean;

const filterKeys: Keys<Filter> = { category: "number", mask: "number", group: "number" };

/** Writes a ks_filter. */
export function putFilter(to: Memory, at: number, filter: Filter, call: string): void {
  checkKeys(filter, filterKeys, "filter", call);
  const { category = 1, mask = -1, group = 0 } = filter;
  if (!Number.isInteger(group) || Math.abs(group) >= 2 ** 31)
    throw new RangeError(`${call}: filter.group must be a whole number of 32 bits, but is ${shown(group)}`);
  to.putWhole(at, whole(category, 2 ** 53, "filter.category", call));
  to.putWhole(at + 8, maskNumber(mask, "filter.mask", call));
  to.putWord(at + 16, group);
}

export function maskNumber(mask: number, what: string, call: string): number {
  return mask === -1 ? -1 : whole(mask, 2 ** 53, what, call);
}

export function filterFrom(from: Place, at: number): Required<Filter> {
  return { category: from.whole(at), mask: from.whole(at + 8), group: from.word(at + 16) };
}

/** Gives the module a pair filter. Throws TypeError for anything but a function or null. */
export function keptFilter(module: Module, filter: PairFilter | null, what: string, call: string): Kept | null {
  if (filter === null) return null;
  if (typeof filter !== "function")
    throw new TypeError(`${call}: ${what} must be a function or null, but is ${shown(filter)}`);
  return module.keep((first, second) => {
    // The pair may touch until the running call throws what the filter threw.
    if (module.hasThrown) return 1;
    const may: unknown = filter(module.at(first!).id(0), module.at(second!).id(0));
    refusePromise(may, "pair filter");
    if (typeof may !== "boolean") throw new TypeError(`pair filter: the result must be a boolean, but is ${shown(may)}`);
    return may ? 1 : 0;
  });
}
/** Returns the arguments of C for a pair filter: the function and its number. */
export function filterArguments(module: Module, kept: Kept | null): [filter: number, user: number] {
  return kept === null ? [0, 0] : [module.pointer("filter"), kept.number];
}
