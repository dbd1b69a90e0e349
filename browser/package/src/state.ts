// Vectors and states, of one body or of many, and checks of those that callers give.
import { checkKeys, type Keys, requireNumbers, shown } from "./options.js";

/** Three numbers; a typed array is possible. */
export type Vec3 = ArrayLike<number>;

/** A body's id: a whole number, valid in its own world alone; usable as a key. */
export type BodyId = number;

/** Position (length) and velocity (length / time). */
export interface State {
  position: Vec3;
  velocity: Vec3;
}

/** States of many bodies: three numbers for each in `positions`, and in `velocities` if they move. */
export interface States {
  positions: ArrayLike<number>;
  velocities?: ArrayLike<number>;
}

/** One number for all bodies, or one for each. */
export type PerBody = number | ArrayLike<number>;

export function countOf(positions: ArrayLike<number>, call: string): number {
  requireNumbers(positions, "positions", call);
  if (positions.length % 3 !== 0)
    throw new RangeError(`${call}: positions must have three numbers for each body, but has ${positions.length}`);
  return positions.length / 3;
}

export function each(values: PerBody, count: number, what: string, call: string): ArrayLike<number> {
  if (typeof values === "number") return new Float64Array(count).fill(values);
  if (typeof values?.length !== "number")
    throw new TypeError(`${call}: ${what} must be a number or an array, but is ${shown(values)}`);
  requireNumbers(values, what, call);
  if (values.length !== count)
    throw new RangeError(`${call}: ${what} must have a number for each of ${count} bodies, but has ${values.length}`);
  return values;
}

export function vector(values: Vec3, what: string, call: string): [number, number, number] {
  if (typeof values?.length !== "number")
    throw new TypeError(`${call}: ${what} must be an array of three numbers, but is ${shown(values)}`);
  if (values.length !== 3)
    throw new RangeError(`${call}: ${what} must have three numbers, but has ${values.length}`);
  requireNumbers(values, what, call);
  return [values[0]!, values[1]!, values[2]!];
}

/** Throws unless there are no velocities, or three numbers for each body. */
export function requireAsMany(velocities: ArrayLike<number> | undefined, positions: ArrayLike<number>, call: string): void {
  if (velocities === undefined) return;
  if (velocities.length !== positions.length)
    throw new RangeError(
      `${call}: velocities must have as many numbers as positions, ${positions.length}, but has ${velocities.length}`);
  requireNumbers(velocities, "velocities", call);
}

const stateKeys: Keys<States> = { positions: true, velocities: true };

export function sixes(states: States, call: string): Float64Array {
  checkKeys(states, stateKeys, "start", call);
  const count = countOf(states.positions, call);
  const { positions, velocities } = states;
  requireAsMany(velocities, positions, call);
  const numbers = new Float64Array(6 * count);
  for (let k = 0; k < count; ++k) {
    for (let axis = 0; axis < 3; ++axis) {
      numbers[6 * k + axis] = positions[3 * k + axis]!;
      numbers[6 * k + 3 + axis] = velocities?.[3 * k + axis] ?? 0;
    }
  }
  return numbers;
}

export function sixOf(state: State, call: string): number[] {
  if (typeof state !== "object" || state === null)
    throw new TypeError(`${call}: state must be an object with position and velocity, but is ${shown(state)}`);
  return [...vector(state.position, "position", call), ...vector(state.velocity, "velocity", call)];
}

/** Returns the state of a pair. Throws RangeError unless it is a whole number of 32 bits. */
export function pairStateOf(state: number, what: string, call: string): number {
  if (Number.isInteger(state) && Math.abs(state) < 2 ** 31) return state;
  throw new RangeError(`${call}: ${what} must be a whole number of 32 bits, but is ${shown(state)}`);
}
