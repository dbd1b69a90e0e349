// All that happens in a run of the discs, known in advance, since runs are equal to the last bit.
import { loopRate } from "../missed.ts";
import { discs, type DiscsChoice, discsEnd } from "../scenes/discs.ts";
import { Simulation } from "../simulation.ts";

export interface ContactMark {
  time: number;
  x: number;
  y: number;
  /** Whether a loop of 60 Hz would miss it. */
  missed: boolean;
  /** Whether two discs touch, not one the wall. */
  ofTwo: boolean;
}

/** Places are noted so many times between two looks of the loop. */
export const placesPerLook = 4;
/** Seconds between two noted places. */
export const placeInterval = 1 / (loopRate * placesPerLook);

export interface WholeRun {
  contacts: readonly ContactMark[];
  /** Of each disc, the places at multiples of placeInterval. */
  places: readonly (readonly (readonly [number, number])[])[];
  /** Of all events, as EventHash of the library has it. */
  hash: string;
  /** States asked for in the whole run. */
  probes: number;
}

export function newSimulation(choice: DiscsChoice): Simulation {
  return new Simulation(discs(choice), { title: "Discs", about: "" });
}

export function wholeRun(choice: DiscsChoice): WholeRun {
  const simulation = newSimulation(choice);
  const contacts: ContactMark[] = [];
  const places: [number, number][][] = Array.from(simulation.radii(), () => []);
  for (let k = 0; k * placeInterval <= discsEnd; ++k) {
    for (const { event, missed } of simulation.run(k * placeInterval)) {
      if (event.kind !== "contact_begin" && event.kind !== "wall_begin") continue;
      const [x, y] = event.point as unknown as [number, number];
      contacts.push({ time: event.time, x, y, missed, ofTwo: event.kind === "contact_begin" });
    }
    const now = simulation.positions();
    places.forEach((ofBody, body) => ofBody.push([now[3 * body]!, now[3 * body + 1]!]));
  }
  const { hash } = simulation;
  const { probes } = simulation.view.counters;
  simulation.free();
  return { contacts, places, hash, probes };
}
