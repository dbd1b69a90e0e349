// Rigid bodies in a box: dumbbells, rods and jacks, which turn, and turn each other.
import { Ballistic, type BodyId, BodyMap, type Box, type Event, type RigidPart, type Vec3, World } from "kinesphere";
import type { LiveScene, SceneChoice, Setup } from "./live_scene.ts";
import { randomNumbers } from "./random_numbers.ts";

const box: Box = { lower: [0, 0, 0], upper: [12, 12, 12] };

/** Parts about the centre of mass, half the length, and moments of inertia for a mass of 1: its axes are principal. */
interface Kind {
  parts: readonly RigidPart[];
  inertia: Vec3;
}

function kindsOf(half: number): Kind[] {
  const thick = 0.35 * half;
  const rod = (end: [number, number, number], radius: number): RigidPart => ({ capsule: { a: end.map((x) => -x) as [number, number, number], b: end, radius } });
  const ball = (x: number): RigidPart => ({ ball: { centre: [x, 0, 0], radius: 1.4 * thick } });
  const inner = half - thick;
  const across = inner ** 2 / 3;
  return [
    // Two masses of a half at the ends of a light rod.
    { parts: [ball(-inner), ball(inner), rod([inner, 0, 0], 0.3 * thick)], inertia: [0, inner ** 2, inner ** 2] },
    { parts: [rod([inner, 0, 0], thick)], inertia: [0, across, across] },
    // Three rods of a third.
    { parts: [rod([inner, 0, 0], 0.6 * thick), rod([0, inner, 0], 0.6 * thick), rod([0, 0, inner], 0.6 * thick)],
      inertia: [2 / 3 * across, 2 / 3 * across, 2 / 3 * across] },
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
  const perSide = Math.ceil(Math.cbrt(count));
  const pitch = box.upper[0]! / perSide;
  const positions = new Float64Array(3 * count);
  const velocities = new Float64Array(3 * count);
  for (let body = 0; body < count; ++body) {
    [body % perSide, Math.floor(body / perSide) % perSide, Math.floor(body / perSide ** 2)].forEach((cell, axis) => {
      positions[3 * body + axis] = (cell + 0.5) * pitch;
      velocities[3 * body + axis] = 4 * (2 * random() - 1);
    });
  }
  const world = new World({ box, contacts: "impacts", zenoInterval: 1e-4 });
  const flight = new Ballistic({ positions, velocities });
  const bodies = new BodyMap();
  // Balls of this radius around the bodies do not overlap at the start.
  const kinds = kindsOf(0.45 * pitch);
  for (let body = 0; body < count; ++body) {
    const { parts, inertia } = kinds[body % kinds.length]!;
    const orientation = Array.from({ length: 4 }, () => 2 * random() - 1);
    const length = Math.hypot(...orientation);
    // A dumbbell and a rod do not spin about themselves, so that all keep their angular velocities between contacts.
    bodies.addRigidBody(world, flight, body, parts, { inertia, orientation: orientation.map((part) => part / length) });
  }
  return { scene: new Tumbling(world, flight, bodies), radii: Float64Array.from(world.bodyViews(), ({ radius }) => radius) };
}
