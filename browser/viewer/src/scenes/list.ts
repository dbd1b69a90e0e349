// The list of scenes to choose from.
import { bullets } from "./bullets.ts";
import { crowd } from "./crowd.ts";
import { drones } from "./drones.ts";
import { game } from "./game.ts";
import { ofLibrary } from "./library.ts";
import type { SceneChoice, Setup } from "./live_scene.ts";
import { madeUpCrowd } from "./made_up_crowd.ts";
import { missed } from "./missed.ts";
import { piston } from "./piston.ts";
import { rigidBodies } from "./rigid_bodies.ts";
import type { TrackTable } from "./track_table.ts";

export interface SceneAbout {
  name: string;
  title: string;
  about: string;
  bodies: number;
  /** Initial speed, in simulated seconds per second. */
  speed: number;
  /** True if it shows what a loop misses. */
  evidence?: true;
}

export const scenes: readonly SceneAbout[] = [
  { name: "missed", title: "What 60 Hz misses", bodies: 160, speed: 0.1, evidence: true,
    about: "Slow motion. A loop of 60 Hz looks at the squares alone, and misses each contact with a cross. Kinesphere finds all." },
  { name: "paper1", title: "Random forces", bodies: 500, speed: 2,
    about: "Sizes 1 to 100, pushed by forces that nobody knows in advance: only their limits are promised." },
  { name: "paper2", title: "Strong forces, from rest", bodies: 500, speed: 1,
    about: "Larger forces, and sizes that differ less." },
  { name: "gas", title: "Gas in a box", bodies: 600, speed: 2,
    about: "Equal spheres that fly freely: hardly any of them has to be asked between two contacts." },
  { name: "periodic_gas", title: "Dense gas, periodic", bodies: 400, speed: 0.5,
    about: "Space repeats on all axes: what leaves on one side comes in on the other." },
  { name: "rain", title: "Rain", bodies: 500, speed: 1, about: "Drops fall, and bounce off the floor." },
  { name: "pile", title: "Pile", bodies: 300, speed: 1, about: "Spheres fall on a heap, and lose speed in each contact." },
  { name: "bullets", title: "Bullets through a thin zone", bodies: 120, speed: 0.1, evidence: true,
    about: "The zone is 0.05 thick. A loop of 60 Hz overlooks most flights through it; here each is reported." },
  { name: "drones", title: "Drones with alarms", bodies: 60, speed: 2,
    about: "They report where they are with errors of a metre. Two that may be within 20 m are warned, and climb or sink; at 6 m there is an alarm." },
  { name: "game", title: "A game loop", bodies: 200, speed: 0.25,
    about: "A game moves its balls 60 times a second, up to a unit each time, and hands each frame over. None passes through another." },
  { name: "piston", title: "A piston", bodies: 151, speed: 0.5,
    about: "A moving shape. The world knows how strongly the piston may accelerate, and nothing else of its course." },
  { name: "crowd", title: "A crowd", bodies: 10_000, speed: 2,
    about: "Two that come within half a metre are reported. kinesphere view FILE shows people as they were recorded." },
  { name: "rigid", title: "Things that turn", bodies: 90, speed: 0.5,
    about: "Rigid bodies of balls, capsules, boxes and convex hulls. Each contact comes at its exact time, and turns them." },
];

export function sceneAbout(name: string): SceneAbout {
  const found = scenes.find((scene) => scene.name === name);
  if (found === undefined) throw new RangeError(`There is no scene ${name}`);
  return found;
}

/** The key of a scene, by its place in the list. */
export const sceneKeys = "1234567890-=[";

/** `opened` are the tracks that the server was given, if any. */
export function setUp(choice: SceneChoice, opened: TrackTable | null): Setup {
  switch (choice.name) {
    case "missed":
      return missed(choice);
    case "bullets":
      return bullets(choice);
    case "drones":
      return drones(choice);
    case "game":
      return game(choice);
    case "piston":
      return piston(choice);
    case "rigid":
      return rigidBodies(choice);
    case "crowd":
      return opened === null ? { ...crowd(choice, madeUpCrowd(choice.seed)), about: sceneAbout(choice.name).about } : crowd(choice, opened);
    default:
      return ofLibrary(choice);
  }
}
