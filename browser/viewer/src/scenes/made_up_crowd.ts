// A crowd for a page that was given none: two streams of walkers that cross, and evade no one.
import type { TrackTable } from "./track_table.ts";
import { randomNumbers } from "./numbers.ts";

const walkers = 200;
/** Sides of the square, in metres, and seconds between two samples. */
const side = 20;
const interval = 0.4;

export function madeUpCrowd(seed: number): TrackTable {
  const random = randomNumbers(seed);
  const tracks = Array.from({ length: walkers }, (_, k) => {
    const start = 60 * random();
    const speed = 1 + 0.6 * random();
    const lane = side * (0.25 + 0.5 * random());
    const phase = 2 * Math.PI * random();
    const times: number[] = [];
    const positions: number[] = [];
    for (let along = 0; along <= side; along += speed * interval) {
      const aside = lane + 0.8 * Math.sin(0.3 * along + phase);
      times.push(start + times.length * interval);
      positions.push(...(k % 2 === 0 ? [along, aside] : [aside, side - along]), 0);
    }
    return { id: `${k}`, times, positions };
  });
  return { name: "A crowd", plane: true, unit: "m", tracks };
}
