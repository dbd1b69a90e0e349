// The scenes that can be chosen: those of the library, and bullets that fly through a thin zone.
import { Ballistic, type BodyId, type Box, type Motion, type RunOptions, Scene, World } from "kinesphere";

export interface SceneChoice {
  name: string;
  bodies: number;
  seed: number;
}

/** A world at its start, with what moves its bodies and what answers its events. */
export interface Setup {
  world: World;
  motion: Motion;
  respond: NonNullable<RunOptions["respond"]>;
  radii: Float64Array;
  zone: { id: BodyId; box: Box } | null;
}

export interface SceneAbout {
  name: string;
  title: string;
  about: string;
  bodies: number;
  /** Simulated seconds per second at first. */
  speed: number;
}

export const scenes: readonly SceneAbout[] = [
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
  { name: "bullets", title: "Bullets through a thin zone", bodies: 120, speed: 0.1,
    about: "The zone is 0.05 thick. A loop of 60 Hz overlooks most flights through it; here each is told." },
];

export function sceneAbout(name: string): SceneAbout {
  const found = scenes.find((scene) => scene.name === name);
  if (found === undefined) throw new RangeError(`There is no scene ${name}`);
  return found;
}

export function setUp(choice: SceneChoice): Setup {
  if (choice.name === "bullets") return bullets(choice);
  const scene = new Scene(choice.name, { bodies: choice.bodies, seed: choice.seed });
  const world = new World(scene.definition);
  const motion = scene.motion();
  const radii = scene.radii;
  world.addMotion(motion, radii);
  return { world, motion, respond: scene, radii, zone: null };
}

/** Numbers in [0, 1), the same for the same seed. */
function randomNumbers(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

function bullets({ bodies, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const box: Box = { lower: [0, 0, 0], upper: [60, 30, 30] };
  const radius = 0.25;
  const positions = new Float64Array(3 * bodies);
  const velocities = new Float64Array(3 * bodies);
  // One bullet in each cell of a grid on the left side, so that none overlap at the start.
  const perSide = Math.ceil(Math.cbrt(bodies));
  for (let k = 0; k < bodies; ++k) {
    const cell = [k % perSide, Math.floor(k / perSide) % perSide, Math.floor(k / perSide ** 2)];
    const room = [24, 29, 29];
    for (let axis = 0; axis < 3; ++axis) {
      const size = room[axis]! / perSide;
      const slack = Math.max(size - 2.1 * radius, 0);
      positions[3 * k + axis] = 0.5 + size / 2 + cell[axis]! * size + (random() - 0.5) * slack;
    }
    const speed = 100 + 300 * random();
    velocities.set([speed, 20 * (random() - 0.5), 20 * (random() - 0.5)], 3 * k);
  }
  const zoneBox: Box = { lower: [39.975, 3, 3], upper: [40.025, 27, 27] };
  const world = new World({ box, contacts: "impacts", zenoInterval: 1e-6 });
  const motion = new Ballistic({ positions, velocities });
  const radii = new Float64Array(bodies).fill(radius);
  world.addMotion(motion, radii);
  const zone = { id: world.addZone({ box: zoneBox }), box: zoneBox };
  return { world, motion, respond: { restitution: 1 }, radii, zone };
}
