/** Returns how many cells a cube takes along each side to have `count` cells at least. */
export function cellsPerSide(count: number): number {
  let side = 1;
  while (side * side * side < count) ++side;
  return side;
}
