// A gas between a wall and a piston, which is a moving shape: the world knows how strongly it may accelerate, no more.
import { type BodyId, bounce, type Box, type Event, type ProbeFunction, type Vec3, World } from "kinesphere";
import type { LiveScene, SceneChoice, Setup } from "./live_scene.ts";
import { cellsPerSide, randomNumbers } from "./numbers.ts";

const room: Box = { lower: [0, 0, 0], upper: [10, 10, 16] };
const plate: Box = { lower: [-4.95, -4.95, -0.2], upper: [4.95, 4.95, 0.2] };
/** Middle, stroke and angular speed of the piston. */
const [middle, stroke, turn] = [11, 4, 2];

class Piston implements LiveScene {
  /** `thrown` has of each ball the time and the state after its last impact, seven numbers; the piston is the last body. */
  constructor(readonly world: World, private readonly piston: BodyId, private readonly thrown: Float64Array) {}

  run(until: number, deliver: (event: Event) => void): void {
    for (const event of this.world.events(until, this.probe)) {
      if (event.kind === "contact_begin" || event.kind === "wall_begin") {
        const after = bounce(event, { restitution: 0.9 });
        this.setVelocity(event.first, after.first);
        if (event.second !== null) this.setVelocity(event.second, after.second);
      }
      deliver(event);
    }
  }
  states(): Float64Array {
    const states = new Float64Array(6 * (this.piston + 1));
    this.probe(Float64Array.from({ length: this.piston + 1 }, (_, body) => body), this.world.time, states);
    return states;
  }
  /** The piston keeps to its course. */
  setVelocity(ball: BodyId, velocity: Vec3): void {
    if (ball === this.piston) return;
    const state = new Float64Array(6);
    this.probe(Float64Array.of(ball), this.world.time, state);
    this.thrown.set([this.world.time, state[0]!, state[1]!, state[2]!, velocity[0]!, velocity[1]!, velocity[2]!], 7 * ball);
    this.world.setVelocity(ball, velocity);
  }
  clone(): Piston {
    return new Piston(this.world.clone(), this.piston, this.thrown.slice());
  }
  free(): void {
    this.world.free();
  }

  private readonly probe: ProbeFunction = (ids, time, states) => {
    for (let k = 0; k < ids.length; ++k) {
      if (ids[k] === this.piston) {
        states.set([5, 5, middle + stroke * Math.sin(turn * time), 0, 0, stroke * turn * Math.cos(turn * time)], 6 * k);
        continue;
      }
      const [since, ...state] = Array.from(this.thrown.subarray(7 * ids[k]!, 7 * ids[k]! + 7));
      for (let axis = 0; axis < 3; ++axis) state[axis]! += state[axis + 3]! * (time - since!);
      states.set(state, 6 * k);
    }
  };
}

export function piston({ bodies, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const world = new World({ box: room, contacts: "impacts", zenoInterval: 1e-4 });
  const balls = bodies - 1;
  const perSide = cellsPerSide(balls);
  // Below the lowest place of the piston.
  const sizes = [10 / perSide, 10 / perSide, 6.5 / perSide];
  const radius = Math.min(0.35, 0.4 * sizes[2]!);
  const thrown = new Float64Array(7 * balls);
  for (let ball = 0; ball < balls; ++ball) {
    const cell = [ball % perSide, Math.floor(ball / perSide) % perSide, Math.floor(ball / (perSide * perSide))];
    const position = [0, 1, 2].map((axis) => (cell[axis]! + 0.5) * sizes[axis]!) as [number, number, number];
    const velocity = position.map(() => 8 * (2 * random() - 1)) as [number, number, number];
    thrown.set([0, ...position, ...velocity], 7 * ball);
    world.add({ position, velocity, radius });
  }
  const piston = world.addMovingShape({ box: plate }, {
    position: [5, 5, middle], velocity: [0, 0, stroke * turn], accelerationLimit: 1.001 * stroke * turn ** 2, mass: Infinity,
  });
  // The piston is drawn as its shape, which stands for its radius.
  const radii = new Float64Array(bodies).fill(radius);
  return { scene: new Piston(world, piston, thrown), radii };
}
