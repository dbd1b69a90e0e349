// A game at 60 frames a second. It moves its balls as games do, v += g dt, x += v dt, and hands each frame over;
// contacts come with their exact times between the last two frames, and are answered there.
import { type BodyId, bounce, type Box, type Event, FrameMotion, type Vec3, World } from "kinesphere";
import type { LiveScene, SceneChoice, Setup } from "./live_scene.ts";
import { cellsPerSide, randomNumbers } from "./numbers.ts";

const interval = 1 / 60;
const gravity = 9.81;
const room: Box = { lower: [0, 0, 0], upper: [10, 10, 10] };
const fastest = 60;

class GameLoop implements LiveScene {
  /** `velocities` are the game's own, three numbers for each ball. Its positions are those of the latest frame. */
  constructor(readonly world: World, private readonly frames: FrameMotion, private readonly velocities: Float64Array) {}

  run(until: number, deliver: (event: Event) => void): void {
    while (this.world.time < until) {
      if (this.world.time >= this.frames.latestTime) this.moveBalls();
      for (const event of this.world.events(Math.min(until, this.frames.latestTime), this.frames)) {
        this.answer(event);
        deliver(event);
      }
    }
  }
  states(): Float64Array {
    return this.frames.states(this.world.time);
  }
  setVelocity(ball: BodyId, velocity: Vec3): void {
    this.frames.setVelocity(ball, this.world.time, velocity);
    this.world.setVelocity(ball, velocity);
    this.velocities.set(velocity, 3 * ball);
  }
  clone(): GameLoop {
    return new GameLoop(this.world.clone(), this.frames.clone(), this.velocities.slice());
  }
  free(): void {
    this.world.free();
    this.frames.free();
  }

  private moveBalls(): void {
    const positions = this.frames.latest();
    for (let at = 0; at < positions.length; ++at) {
      if (at % 3 === 2) this.velocities[at]! -= gravity * interval;
      positions[at]! += this.velocities[at]! * interval;
    }
    this.frames.push(this.world, positions);
  }
  private answer(event: Event): void {
    if (event.kind !== "contact_begin" && event.kind !== "wall_begin") return;
    const after = bounce(event);
    this.setVelocity(event.first, after.first);
    if (event.second !== null) this.setVelocity(event.second, after.second);
  }
}

export function game({ bodies, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const perSide = cellsPerSide(bodies);
  const pitch = (room.upper[0]! - room.lower[0]!) / perSide;
  const radius = Math.min(0.25, 0.35 * pitch);
  const positions = new Float64Array(3 * bodies);
  const velocities = new Float64Array(3 * bodies);
  for (let k = 0; k < bodies; ++k) {
    const cell = [k % perSide, Math.floor(k / perSide) % perSide, Math.floor(k / (perSide * perSide))];
    for (let axis = 0; axis < 3; ++axis) {
      positions[3 * k + axis] = (cell[axis]! + 0.5) * pitch;
      velocities[3 * k + axis] = fastest * (2 * random() - 1) / Math.sqrt(3);
    }
  }
  const frames = new FrameMotion({ positions, velocities }, { interval });
  const world = new World({ box: room, contactTolerance: 1e-4, contacts: "impacts", zenoInterval: 1e-4 });
  const radii = new Float64Array(bodies).fill(radius);
  world.addMotion(frames, radii);
  return { scene: new GameLoop(world, frames, velocities), radii };
}
