// Contacts that a loop with overlap tests at fixed times would miss.
import type { Event } from "kinesphere";

/** Overlap tests per second of the loop for comparison. */
export const loopRate = 60;

export function loopLooksWithin(from: number, to: number): boolean {
  return Math.ceil(from * loopRate) <= Math.floor(to * loopRate);
}

/**
 * Returns true if the two bodies, with their velocities at the touch, as in a loop that has not yet noticed it, are
 * apart again at the next test. They overlap while the length of d + w s is less than the sum of their radii.
 */
export function isMissedByLoop(event: Event, radiusSum: number): boolean {
  const { position: p, velocity: v } = event.firstState;
  const { position: q, velocity: u } = event.secondState;
  let distanceSquared = 0;
  let approach = 0;
  let speedSquared = 0;
  for (let axis = 0; axis < 3; ++axis) {
    const d = q[axis]! - p[axis]!;
    const w = u[axis]! - v[axis]!;
    distanceSquared += d * d;
    approach += d * w;
    speedSquared += w * w;
  }
  if (speedSquared === 0) return false;
  const discriminant = approach ** 2 - speedSquared * (distanceSquared - radiusSum ** 2);
  if (discriminant <= 0) return true;
  const half = Math.sqrt(discriminant);
  const begin = event.time + Math.max(0, (-approach - half) / speedSquared);
  const end = event.time + (-approach + half) / speedSquared;
  return !loopLooksWithin(begin, end);
}
