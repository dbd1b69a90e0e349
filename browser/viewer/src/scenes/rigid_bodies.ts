// Rigid bodies in a box: dumbbells, rods, jacks, crates and octahedra, which turn each other.
import { Ballistic, type BodyId, BodyMap, type Box, type Event, type RigidPart, type Vec3, World } from "kinesphere";
import type { LiveScene, SceneChoice, Setup } from "./live_scene.ts";
import { cellsPerSide, randomNumbers } from "./numbers.ts";

const box: Box = { lower: [0, 0, 0], upper: [12, 12, 12] };

/** Parts about the centre of mass, and moments of inertia for a mass of 1: the axes of the body are principal. */
interface Kind {
  parts: readonly RigidPart[];
  inertia: Vec3;
}

const crossed = (length: number): Vec3[] => [[length, 0, 0], [0, length, 0], [0, 0, length]];
const opposite = (point: Vec3): Vec3 => Array.from(point as ArrayLike<number>, (x) => -x) as [number, number, number];
const rod = (end: Vec3, radius: number): RigidPart => ({ capsule: { a: opposite(end), b: end, radius } });
const alike = (moment: number): Vec3 => [moment, moment, moment];

/** Each fits into a ball of radius `size`, or a smaller one: colours tell kinds by their sizes. */
function kindsOf(size: number): Kind[] {
  const thick = 0.3 * size;
  const ends = 0.7 * size;
  const [thin, length] = [0.2 * size, 0.6 * size];
  const [edge, tip] = [0.45 * size, 0.85 * size];
  const rounding = 0.02 * size;
  return [
    // A dumbbell: two masses of a half at the ends of a light rod.
    { parts: [{ ball: { centre: [ends, 0, 0], radius: thick } }, { ball: { centre: [-ends, 0, 0], radius: thick } },
              rod([ends, 0, 0], 0.3 * thick)], inertia: [0, ends ** 2, ends ** 2] },
    { parts: [rod([0.65 * size, 0, 0], thick)], inertia: [0, (0.65 * size) ** 2 / 3, (0.65 * size) ** 2 / 3] },
    // A jack: three rods of a third, each of which turns about two of the axes.
    { parts: crossed(length).map((end) => rod(end, thin)), inertia: alike((2 / 9) * length ** 2) },
    // A crate, and an octahedron.
    { parts: [{ box: { lower: [-edge, -edge, -edge], upper: [edge, edge, edge], radius: rounding } }], inertia: alike((2 / 3) * edge ** 2) },
    { parts: [{ hull: { points: [...crossed(tip), ...crossed(-tip)], radius: rounding } }], inertia: alike(tip ** 2 / 5) },
  ];
}

class Tumbling implements LiveScene {
  constructor(readonly world: World, private readonly flight: Ballistic, private readonly bodies: BodyMap) {}

  run(until: number, deliver: (event: Event) => void): void {
    this.world.run(until, { motion: this.bodies, respond: {} }, (events) => {
      for (const event of events) deliver(event);
    });
  }
  states(): Float64Array {
    return this.bodies.states(this.world.time, this.world.bodies());
  }
  setVelocity(body: BodyId, velocity: Vec3): void {
    this.bodies.setVelocity(this.world, body, velocity);
  }
  clone(): Tumbling {
    const flight = this.flight.clone();
    return new Tumbling(this.world.clone(), flight, this.bodies.withMotions([this.flight], [flight]));
  }
  free(): void {
    this.world.free();
    this.bodies.free();
    this.flight.free();
  }
}

export function rigidBodies({ bodies: count, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const perSide = cellsPerSide(count);
  const pitch = box.upper[0]! / perSide;
  const positions = new Float64Array(3 * count);
  const velocities = new Float64Array(3 * count);
  for (let body = 0; body < count; ++body) {
    [body % perSide, Math.floor(body / perSide) % perSide, Math.floor(body / (perSide * perSide))].forEach((cell, axis) => {
      positions[3 * body + axis] = (cell + 0.5) * pitch;
      velocities[3 * body + axis] = 4 * (2 * random() - 1);
    });
  }
  const world = new World({ box, contacts: "impacts", zenoInterval: 1e-4 });
  const flight = new Ballistic({ positions, velocities });
  const bodies = new BodyMap();
  const kinds = kindsOf(0.48 * pitch);
  for (let body = 0; body < count; ++body) {
    const { parts, inertia } = kinds[Math.floor(kinds.length * random())]!;
    const orientation = Array.from({ length: 4 }, () => 2 * random() - 1);
    const length = Math.sqrt(orientation.reduce((sum, part) => sum + part * part, 0));
    // All keep their angular velocities between contacts, since nothing spins a dumbbell or a rod about itself.
    bodies.addRigidBody(world, flight, body, parts, { inertia, orientation: orientation.map((part) => part / length) });
  }
  return { scene: new Tumbling(world, flight, bodies), radii: Float64Array.from(world.bodyViews(), ({ radius }) => radius) };
}
