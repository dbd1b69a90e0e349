// Filters, and their numbers for the module.
import { checkKeys, type Keys, shown, whole } from "./options.js";

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

/** Returns numbers in the order of filter_at() in browser/module/world.cpp. */
export function filterNumbers(filter: Filter, call: string): [category: number, mask: number, group: number] {
  checkKeys(filter, filterKeys, "filter", call);
  const { category = 1, mask = -1, group = 0 } = filter;
  if (!Number.isInteger(group) || Math.abs(group) >= 2 ** 31)
    throw new RangeError(`${call}: filter.group must be a whole number of 32 bits, but is ${shown(group)}`);
  return [whole(category, 2 ** 53, "filter.category", call), maskNumber(mask, "filter.mask", call), group];
}

export function maskNumber(mask: number, what: string, call: string): number {
  return mask === -1 ? -1 : whole(mask, 2 ** 53, what, call);
}

/** Returns the filter of these numbers. */
export function filterFrom(numbers: ArrayLike<number>, at: number): Required<Filter> {
  return { category: numbers[at]!, mask: numbers[at + 1]!, group: numbers[at + 2]! };
}
