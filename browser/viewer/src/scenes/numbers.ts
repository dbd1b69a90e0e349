/** Returns numbers in [0, 1), equal for equal seeds. */
export function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Returns how many cells a cube takes along each side to have `count` cells at least. */
export function cellsPerSide(count: number): number {
  let side = 1;
  while (side * side * side < count) ++side;
  return side;
}
