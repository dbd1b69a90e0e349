// Bullets that fly through a thin zone.
import { Ballistic, type Box, World } from "kinesphere";
import { MovedScene, type SceneChoice, type Setup } from "./live_scene.ts";
import { cellsPerSide, randomNumbers } from "./numbers.ts";

export function bullets({ bodies, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const box: Box = { lower: [0, 0, 0], upper: [60, 30, 30] };
  const radius = 0.25;
  const positions = new Float64Array(3 * bodies);
  const velocities = new Float64Array(3 * bodies);
  // One bullet in each cell of a grid on the left side, so that none overlap at the start.
  const perSide = cellsPerSide(bodies);
  for (let k = 0; k < bodies; ++k) {
    const cell = [k % perSide, Math.floor(k / perSide) % perSide, Math.floor(k / (perSide * perSide))];
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
  return { scene: new MovedScene(world, motion, { restitution: 1 }), radii, zone, trails: Array.from(radii.keys()) };
}
