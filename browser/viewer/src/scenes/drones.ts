// Drones that fly from place to place and report with errors. A drone in a warning climbs or sinks.
import { type BodyId, type Box, type Event, SteeredMotion, type Vec3, World } from "kinesphere";
import type { AlarmDistances, LiveScene, SceneChoice, Setup } from "./live_scene.ts";
import { randomNumbers } from "./numbers.ts";

/** Metres and seconds. */
const radius = 1.5;
const agility = 5;
const positionError = 1;
const alarms: AlarmDistances = { warning: 20, alarm: 6 };
const sensorClass = 1;
const tick = 0.25;
/** Seconds for which a drone climbs or sinks after a warning. */
const evasion = 2;

/** A drone's next actions; copied with the scene. */
interface Plan {
  target: Float64Array;
  /** Number of places to which it has been sent. */
  places: number;
  /** It climbs (1) or sinks (-1) until `until`. */
  side: number;
  evadesUntil: number;
}

class Airspace implements LiveScene {
  constructor(readonly world: World, private readonly motion: SteeredMotion, private readonly plans: Plan[],
              private readonly air: Box, private readonly seed: number, private nextTick: number) {}

  run(until: number, deliver: (event: Event) => void): void {
    while (this.world.time < until) {
      if (this.world.time >= this.nextTick) this.steerAll();
      for (const event of this.world.events(Math.min(until, this.nextTick), this.report)) {
        if (event.kind === "sensor_enter" && event.distance === alarms.warning) this.evade(event);
        deliver(event);
      }
    }
  }
  states(): Float64Array {
    return this.motion.states(this.world.time);
  }
  setVelocity(drone: BodyId, velocity: Vec3): void {
    this.motion.setVelocity(drone, this.world.time, velocity);
    this.world.setVelocity(drone, velocity);
  }
  clone(): Airspace {
    const plans = this.plans.map((plan) => ({ ...plan, target: plan.target.slice() }));
    return new Airspace(this.world.clone(), this.motion.clone(), plans, this.air, this.seed, this.nextTick);
  }
  free(): void {
    this.world.free();
    this.motion.free();
  }

  /** Reports of the drones: up to positionError from the truth. Equal times of a drone have equal reports. */
  private readonly report = (ids: Float64Array, time: number, states: Float64Array): void => {
    states.set(this.motion.states(time, ids));
    const most = (0.95 * positionError) / Math.sqrt(3);
    for (let k = 0; k < ids.length; ++k)
      for (let axis = 0; axis < 3; ++axis)
        states[6 * k + axis]! += most * Math.sin((37 + 11 * axis) * time + 1.7 * ids[k]! + axis);
  };

  private steerAll(): void {
    const states = this.states();
    for (const [drone, plan] of this.plans.entries()) {
      const state = states.subarray(6 * drone, 6 * drone + 6);
      if (distance(plan.target, state) < 15) this.sendOn(drone, plan);
      this.steer(drone, plan, state);
    }
    this.nextTick += tick;
  }
  /** Sends a drone to a place that depends on the drone and on its number of places so far. */
  private sendOn(drone: number, plan: Plan): void {
    plan.places += 1;
    const random = randomNumbers(this.seed + 7919 * drone + 104729 * plan.places);
    plan.target = randomPlace(this.air, random);
  }
  private steer(drone: BodyId, plan: Plan, state: Float64Array): void {
    const wish = [0, 1, 2].map((axis) => 0.12 * (plan.target[axis]! - state[axis]!) - 0.7 * state[3 + axis]!);
    if (this.world.time < plan.evadesUntil) wish[2] = plan.side * agility;
    const scale = Math.min(1, agility / Math.hypot(...wish));
    this.motion.steer(drone, this.world.time, wish.map((part) => scale * part));
  }
  private evade({ first, second, firstState, secondState, time }: Event): void {
    const firstIsHigher = firstState.position[2]! > secondState.position[2]!;
    for (const [drone, isHigher] of [[first, firstIsHigher], [second!, !firstIsHigher]] as const) {
      const plan = this.plans[drone]!;
      plan.side = isHigher ? 1 : -1;
      plan.evadesUntil = time + evasion;
      this.steer(drone, plan, this.motion.states(time, [drone]));
    }
  }
}

function distance(a: Float64Array, b: Float64Array): number {
  return Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!);
}

function randomPlace({ lower, upper }: Box, random: () => number): Float64Array {
  return Float64Array.from([0, 1, 2], (axis) => lower[axis]! + (upper[axis]! - lower[axis]!) * random());
}

export function drones({ bodies, seed }: SceneChoice): Setup {
  const random = randomNumbers(seed);
  const perSide = Math.ceil(Math.sqrt(bodies));
  const side = 40 * perSide;
  const air: Box = { lower: [0, 0, 20], upper: [side, side, 80] };
  const positions = new Float64Array(3 * bodies);
  const plans: Plan[] = [];
  for (let drone = 0; drone < bodies; ++drone) {
    const column = drone % perSide;
    const row = Math.floor(drone / perSide);
    positions.set([40 * (column + 0.5), 40 * (row + 0.5), 30 + 40 * random()], 3 * drone);
    plans.push({ target: randomPlace(air, random), places: 0, side: 0, evadesUntil: -Infinity });
  }
  const motion = new SteeredMotion({ positions }, { accelerationLimits: agility });
  const world = new World({ contactTolerance: 1e-3, separationDistance: 5 * positionError });
  world.setSensor(sensorClass, [alarms.warning, alarms.alarm]);
  const { accelerationLimit } = motion.definition(0, 0);
  world.addAll({ positions, radii: radius, accelerationLimits: accelerationLimit, positionError, sensorClass });
  const region: Box = { lower: [0, 0, 0], upper: [side, side, 100] };
  return {
    scene: new Airspace(world, motion, plans, air, seed, 0), radii: new Float64Array(bodies).fill(radius), alarms, region,
  };
}
