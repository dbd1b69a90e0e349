// Small fast bodies among large slow ones: most of their contacts lie between two looks of a loop of 60 Hz.
import { Ballistic, type Box, World } from "kinesphere";
import { MovedScene, type SceneChoice, type Setup } from "./live_scene.ts";
import { cellsPerSide, randomNumbers } from "./numbers.ts";

const box: Box = { lower: [0, 0, 0], upper: [40, 30, 30] };
/** Every fourth body is fast. */
const isFast = (body: number) => body % 4 === 1;

export function missed({ bodies, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const positions = new Float64Array(3 * bodies);
  const velocities = new Float64Array(3 * bodies);
  const radii = new Float64Array(bodies);
  // One body in each cell of a grid, so that none overlap at the start.
  const perSide = cellsPerSide(bodies);
  for (let body = 0; body < bodies; ++body) {
    const cell = [body % perSide, Math.floor(body / perSide) % perSide, Math.floor(body / (perSide * perSide))];
    const sizes = [0, 1, 2].map((axis) => box.upper[axis]! / perSide);
    radii[body] = Math.min(isFast(body) ? 0.16 : 0.6 + 0.6 * random(), 0.3 * Math.min(...sizes));
    const direction = randomDirection(random);
    const speed = isFast(body) ? 150 + 150 * random() : 2 * random();
    for (let axis = 0; axis < 3; ++axis) {
      const slack = sizes[axis]! - 2.1 * radii[body]!;
      positions[3 * body + axis] = (cell[axis]! + 0.5) * sizes[axis]! + (random() - 0.5) * slack;
      velocities[3 * body + axis] = speed * direction[axis]!;
    }
  }
  const world = new World({ box, contacts: "impacts", zenoInterval: 1e-6 });
  const motion = new Ballistic({ positions, velocities });
  world.addMotion(motion, radii);
  // Large bodies are heavy, so that those that are fast stay so.
  const masses = radii.map((radius) => radius * radius * radius);
  const trails = Array.from({ length: bodies }, (_, body) => body).filter(isFast);
  return { scene: new MovedScene(world, motion, { restitution: 1, masses }), radii, trails };
}

/** Returns a unit vector. Sums, products and roots are rounded alike in all browsers, sines and powers are not. */
function randomDirection(random: () => number): [number, number, number] {
  for (;;) {
    const [x, y, z] = [2 * random() - 1, 2 * random() - 1, 2 * random() - 1];
    const length = Math.sqrt(x * x + y * y + z * z);
    if (length > 0.1 && length <= 1) return [x / length, y / length, z / length];
  }
}
