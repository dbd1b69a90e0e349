// Discs in a plane: large ones that are pushed at random, and small fast ones that pass between two looks of a loop.
import { type Event, SteeredMotion, World } from "kinesphere";
import { MovedScene, type Setup } from "./live_scene.ts";
import { randomNumbers } from "./numbers.ts";

/** The size of the box, and the seed of places, velocities and forces. */
export interface DiscsChoice {
  width: number;
  height: number;
  seed: number;
}

/** Simulated seconds that the scene lasts. */
export const discsEnd = 4;
/** Length of the cells of a grid, one for each disc, so that none overlap at the start. */
const [cellWidth, cellHeight] = [4, 4.5];
/** Every fourth disc is small and fast. */
const isFast = (body: number) => body % 4 === 1;
const largeSpeed = 6;
const [leastFastSpeed, mostFastSpeed] = [60, 80];
/** Limits of the acceleration, and how long each force lasts. */
const [largeLimit, fastLimit, pushInterval] = [16, 16, 0.2];

export function discs({ width, height, seed }: DiscsChoice): Setup {
  const random = randomNumbers(seed);
  const columns = Math.round(width / cellWidth);
  const rows = Math.round(height / cellHeight);
  const count = columns * rows;
  const radii = new Float64Array(count);
  const positions = new Float64Array(3 * count);
  const velocities = new Float64Array(3 * count);
  for (let body = 0; body < count; ++body) {
    radii[body] = isFast(body) ? 0.14 : 0.6 + 0.6 * random();
    const [x, y] = directionIn(random);
    const speed = isFast(body) ? leastFastSpeed + (mostFastSpeed - leastFastSpeed) * random() : largeSpeed * random();
    const sizes = [width / columns, height / rows];
    const cell = [body % columns, Math.floor(body / columns)];
    for (const axis of [0, 1]) {
      const slack = sizes[axis]! - 2.1 * radii[body]!;
      positions[3 * body + axis] = (cell[axis]! + 0.5) * sizes[axis]! + (random() - 0.5) * slack;
    }
    velocities.set([speed * x, speed * y, 0], 3 * body);
  }
  const world = new World({ box: { lower: [0, 0, -1], upper: [width, height, 1] }, dimensions: 2, contacts: "impacts" });
  const limits = radii.map((_, body) => isFast(body) ? fastLimit : largeLimit);
  const motion = new SteeredMotion({ positions, velocities }, { accelerationLimits: limits });
  world.addMotion(motion, radii);
  // Large discs are heavy, so that those that are fast stay so.
  const masses = radii.map((radius) => radius * radius * radius);
  const trails = Array.from({ length: count }, (_, body) => body).filter(isFast);
  return { scene: new PushedDiscs(world, motion, masses, limits, seed), radii, trails, endTime: discsEnd };
}

/** Each disc is pushed in another direction at each multiple of an interval. */
class PushedDiscs extends MovedScene {
  constructor(world: World, private readonly steered: SteeredMotion, private readonly masses: Float64Array,
              private readonly limits: Float64Array, private readonly seed: number, private pushes = 0) {
    super(world, steered, { restitution: 1, masses });
  }

  override run(until: number, deliver: (event: Event) => void): void {
    for (let time = this.pushes * pushInterval; time <= until; time = ++this.pushes * pushInterval) {
      super.run(time, deliver);
      this.push(time);
    }
    super.run(until, deliver);
  }
  override clone(): PushedDiscs {
    return new PushedDiscs(this.world.clone(), this.steered.clone(), this.masses, this.limits, this.seed, this.pushes);
  }

  private push(time: number): void {
    const random = randomNumbers(1000 * this.seed + this.pushes);
    this.limits.forEach((limit, body) => {
      const [x, y] = directionIn(random);
      this.steered.steer(body, time, [limit * x, limit * y, 0]);
    });
  }
}

/** Returns a unit vector. Sums, products and roots are rounded alike in all browsers, sines and powers are not. */
function directionIn(random: () => number): [number, number] {
  for (;;) {
    const [x, y] = [2 * random() - 1, 2 * random() - 1];
    const length = Math.sqrt(x * x + y * y);
    if (length > 0.1 && length <= 1) return [x / length, y / length];
  }
}
