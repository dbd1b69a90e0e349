// Upper limits of errors.
import type { Memory, Place } from "./memory.js";
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

/** Writes a ks_error_bound: its kind, and its limits in the plane and along the vertical. */
export function putBound(to: Memory, at: number, bound: ErrorBound, what: string, call: string): void {
  const isBall = typeof bound === "number";
  if (!isBall && typeof bound !== "object")
    throw new TypeError(`${call}: ${what} must be a number or an object, but is ${shown(bound)}`);
  if (!isBall) checkKeys(bound, boundKeys, what, call);
  to.putWord(at, isBall ? 0 : 1);
  to.putNumber(at + 8, isBall ? bound : numberOf(bound.horizontal, `${what}.horizontal`, call));
  to.putNumber(at + 16, isBall ? bound : numberOf(bound.vertical, `${what}.vertical`, call));
}

export function boundOf(from: Place, at: number): ErrorBound {
  return from.word(at) === 0 ? from.number(at + 8) : { horizontal: from.number(at + 8), vertical: from.number(at + 16) };
}
