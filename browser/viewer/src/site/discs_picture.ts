// The discs at a time: their bounds, what was asked just now, contacts, and where a loop looks.
import { loopRate } from "../missed.ts";
import type { Simulation } from "../simulation.ts";
import type { FlatPicture } from "../flat_picture.ts";
import { placeInterval, placesPerLook, type WholeRun } from "./whole_run.ts";

/** Simulated seconds for which a probe shows, and in which the ring of a contact grows. */
const [probeShown, contactShown] = [0.02, 0.06];
/** Looks of the loop that trails go back. */
const looksShown = 4;

export function drawDiscs(picture: FlatPicture, simulation: Simulation, run: WholeRun): void {
  const { time } = simulation;
  picture.begin();
  picture.rectangle(0, 0, picture.extent.right, picture.extent.top, { fill: "paper", stroke: "frame" });
  drawTrails(picture, run, simulation.trails, time);
  const radii = simulation.radii();
  const positions = simulation.positions();
  const fast = new Set(simulation.trails);
  const views = simulation.views();
  for (const [body, { centre, boundRadius }] of views.entries()) {
    const ink = fast.has(body) ? "other" : "body";
    picture.disc(centre[0]!, centre[1]!, boundRadius, { fill: ink, opacity: 0.14 });
    picture.disc(centre[0]!, centre[1]!, boundRadius, { stroke: ink, opacity: 0.9 });
  }
  for (const [body, { reportTime }] of views.entries()) {
    const [x, y] = [positions[3 * body]!, positions[3 * body + 1]!];
    picture.disc(x, y, radii[body]!, { fill: fast.has(body) ? "other" : "body" });
    const age = (time - reportTime) / probeShown;
    if (age < 1) picture.ring(x, y, fast.has(body) ? 4 : 7, { fill: "probe", opacity: 1 - age });
  }
  drawContacts(picture, run, time);
}

/** The same time as a loop of 60 Hz sees it: discs stand still from look to look, and what is in between is not there. */
export function drawAsLoop(picture: FlatPicture, simulation: Simulation, run: WholeRun): void {
  const { time } = simulation;
  picture.begin();
  picture.rectangle(0, 0, picture.extent.right, picture.extent.top, { fill: "paper", stroke: "frame", dash: [10, 6] });
  const look = lookAt(time);
  const radii = simulation.radii();
  const fast = new Set(simulation.trails);
  for (const [body, places] of run.places.entries())
    picture.disc(...places[look * placesPerLook]!, radii[body]!, { fill: fast.has(body) ? "other" : "body" });
  for (const { time: begin, x, y, missed, ofTwo } of run.contacts) {
    const seen = Math.ceil(begin * loopRate);
    if (!missed && ofTwo && seen <= look) drawRing(picture, x, y, (look - seen) / (loopRate * contactShown), "contact", ofTwo);
  }
}

/** The number of the loop's last look at a time. */
function lookAt(time: number): number {
  return Math.floor(time * loopRate + placeInterval / 2);
}

/** A ring that grows and vanishes, of an age from 0 to 1. */
function drawRing(picture: FlatPicture, x: number, y: number, age: number, ink: "contact" | "missed", ofTwo: boolean): void {
  if (age < 1) picture.ring(x, y, (ofTwo ? 8 : 3) + (ofTwo ? 22 : 7) * age, { stroke: ink, width: 3, opacity: 1 - age });
}

function drawTrails(picture: FlatPicture, { places }: WholeRun, bodies: readonly number[], time: number): void {
  const last = Math.floor(time * loopRate * placesPerLook);
  const first = Math.max(last - looksShown * placesPerLook, 0);
  for (const body of bodies) {
    const trail = places[body]!;
    picture.line(trail.slice(first, last + 1), { stroke: "other", width: 1.5, opacity: 0.5 });
    for (let k = first; k <= last; ++k)
      if (k % placesPerLook === 0) picture.square(...trail[k]!, 7, { stroke: "quiet", fill: "paper", width: 1.5 });
  }
}

/** Contacts that a loop sees are rings that grow and vanish; those that it misses stay, as a ring with a cross. */
function drawContacts(picture: FlatPicture, { contacts }: WholeRun, time: number): void {
  for (const { time: begin, x, y, missed, ofTwo } of contacts) {
    if (begin > time) break;
    const age = (time - begin) / contactShown;
    if (missed) {
      const opacity = Math.max(1 - 0.1 * age, 0.45);
      picture.ring(x, y, 11, { stroke: "missed", width: 2.5, opacity });
      picture.cross(x, y, 6, { stroke: "missed", width: 2.5, opacity });
    }
    drawRing(picture, x, y, age, missed ? "missed" : "contact", ofTwo);
  }
}

/** Looks of a loop of 60 Hz at all discs up to a time. */
export function looksUntil(time: number, discCount: number): number {
  return discCount * (lookAt(time) + 1);
}
