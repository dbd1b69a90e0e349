// Upper limits of errors, and their numbers for the module.
import { checkKeys, type Keys, numberOf, shown } from "./options.js";
import type { PerBody } from "./state.js";

/**
 * An upper limit of an error: a number is a ball of that radius; otherwise the limits in the horizontal plane (x, y) and
 * along the vertical (z), which hold at the same time.
 */
export type ErrorBound = number | { horizontal: number; vertical: number };
/** Upper limits of the errors of many reports. */
export type ErrorBounds = PerBody | { horizontal: PerBody; vertical: PerBody };

export const boundKeys: Keys<{ horizontal: PerBody; vertical: PerBody }> = { horizontal: true, vertical: true };

/** Returns three numbers: 0 and a radius, or 1, the horizontal and the vertical limit. */
export function boundNumbers(bound: ErrorBound, what: string, call: string): [number, number, number] {
  if (typeof bound === "number") return [0, bound, bound];
  if (typeof bound !== "object") throw new TypeError(`${call}: ${what} must be a number or an object, but is ${shown(bound)}`);
  checkKeys(bound, boundKeys, what, call);
  return [1, numberOf(bound.horizontal, `${what}.horizontal`, call), numberOf(bound.vertical, `${what}.vertical`, call)];
}

/** Reads an error bound from its three numbers. */
export function boundOf(numbers: ArrayLike<number>): ErrorBound {
  return numbers[0] === 0 ? numbers[1]! : { horizontal: numbers[1]!, vertical: numbers[2]! };
}
