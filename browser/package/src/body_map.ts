// BodyMap: which body of a world is which body of which motion.
import {
  type MovedBodyDefinition, movedBodyKeys, movedKeys, type MovedOptions, movedRecord, type Shape, shapeRecord,
} from "./body.js";
import { type Argument, Id, Ids, Owned, theModule, type Value } from "./module.js";
import { type FrameMotion, type Motion, numberIn, timeAndRotations } from "./motion.js";
import { checkKeys, requireNumbers } from "./options.js";
import { movedRigidRecords, type MovedRigidBodyDefinition, type RigidPart } from "./rigid_body.js";
import { type BodyId, countOf, each, type PerBody, sixOf, type State, type Vec3, vector } from "./state.js";
import type { World } from "./world.js";

const existing = Symbol("existing");

/**
 * Relates the bodies of a world to the bodies of one or several motions, where several move them or bodies come and go.
 * It serves wherever a world asks for a probe or a motion, keeps its motions alive, and may serve clones of a world.
 *
 *     const bodies = new BodyMap();
 *     const balls = bodies.addAll(world, frames, 0.2);
 *     const bullet = bodies.add(world, flight, flight.add(world.time, muzzle), { radius: 0.01 });
 *     for (const event of world.events(frames.latestTime, bodies))
 *       if (event.second === bullet) bodies.remove(world, bullet);
 *
 * A call that throws has changed neither the motion nor the world.
 */
export class BodyMap extends Owned {
  /** The motions in the order in which the module has them. */
  readonly #motions: Motion[];
  constructor();
  /** @internal */
  constructor(map: typeof existing, address: number, motions: readonly Motion[]);
  constructor(map?: typeof existing, address = 0, motions: readonly Motion[] = []) {
    super(map === existing ? address : theModule().call("map_create"), "map_free");
    this.#motions = [...motions];
  }

  /** Adds a body of a motion to the world, with the motion's state and limits at world.time. Returns its id. */
  add(world: World, motion: Motion, number: number, body: MovedBodyDefinition = {}): BodyId {
    const call = "BodyMap.add";
    checkKeys(body, movedBodyKeys, "body", call);
    return this.added("map_add", world, motion, number, call, movedRecord(body, call));
  }
  /** Adds a body of a motion that carries a box, a triangle or a mesh: see World.addMovingShape(). Returns its id. */
  addMovingShape(world: World, motion: Motion, number: number, shape: Shape, options: MovedOptions = {}): BodyId {
    const call = "BodyMap.addMovingShape";
    checkKeys(options, movedKeys, "options", call);
    return this.added("map_add_moving_shape", world, motion, number, call, shapeRecord(shape, call), movedRecord(options, call));
  }
  /** Adds a body of a motion as the position of a rigid body: see World.addRigidBody(). Returns its id. */
  addRigidBody(
    world: World, motion: Motion, number: number, parts: readonly RigidPart[], body: MovedRigidBodyDefinition = {},
  ): BodyId {
    const call = "BodyMap.addRigidBody";
    return this.added("map_add_rigid_body", world, motion, number, call, ...movedRigidRecords(parts, body, call));
  }
  /**
   * Adds all bodies of the motion in the order of their numbers or, after an error, none. Returns their ids. Radii are
   * by number in the motion.
   */
  addAll(world: World, motion: Motion, radii: PerBody = 1, options: MovedOptions = {}): Float64Array {
    const call = "BodyMap.addAll";
    checkKeys(options, movedKeys, "options", call);
    const addresses = addressesOf(world, motion, call);
    const sizes = each(radii, motion.size, "radii", call);
    const module = theModule();
    const ids = module.with(() => {
      const found = module.room(12 * sizes.length);
      const added = this.word("map_add_all", ...addresses, sizes.length, sizes, movedRecord(options, call), found);
      return module.idsAt(found, added);
    });
    this.keep(motion);
    return ids;
  }
  /** Sets the velocity at world.time, in the motion and in the world. */
  setVelocity(world: World, body: BodyId, velocity: Vec3): void {
    const call = "BodyMap.setVelocity";
    this.change("map_set_velocity", world, body, call, vector(velocity, "velocity", call));
  }
  /** Sets the state at world.time, in the motion and in the world. */
  teleport(world: World, body: BodyId, state: State): void {
    this.change("map_teleport", world, body, "BodyMap.teleport", sixOf(state, "BodyMap.teleport"));
  }
  /** Removes the body. A motion that does not support removal keeps it, but is no longer asked for it. */
  remove(world: World, body: BodyId): void {
    this.change("map_remove", world, body, "BodyMap.remove");
  }
  /**
   * Adds the next frame of a FrameMotion, three numbers for each of its bodies. The world learns all new velocities, so
   * that no contact is missed; world.time must be frames.latestTime. `time` must be later than that; without it the
   * frame comes the interval of the frames after the latest one, so give it where frames differ in length. `rotations`
   * has four numbers w, x, y, z for each body, if the motion was made with rotations.
   */
  push(
    world: World, frames: FrameMotion, positions: ArrayLike<number>, time?: number, rotations?: ArrayLike<number>,
  ): void {
    const call = "BodyMap.push";
    const count = countOf(positions, call);
    this.check("map_push", ...addressesOf(world, frames, call), count, positions, ...timeAndRotations(time, rotations, call));
  }
  /**
   * Returns seven numbers for each: orientation w, x, y, z and angular velocity, as a RotationProbeFunction sets them.
   * Needed in World.setRotationProbe() where rigid bodies have an angular acceleration limit:
   *
   *     world.setRotationProbe((ids, time, rotations) => rotations.set(bodies.rotations(time, ids)));
   */
  rotations(time: number, bodies: ArrayLike<BodyId>): Float64Array {
    requireNumbers(bodies, "bodies", "BodyMap.rotations");
    return this.read({ size: 56 * bodies.length }, "map_rotations", time, bodies.length, new Ids(bodies)).numbers;
  }
  /** Returns the motion and the number of the body there; null if this map does not know it. */
  find(body: BodyId): { motion: Motion; number: number } | null {
    const module = theModule();
    return module.with(() => {
      const number = module.room(8);
      const place = module.call("map_find", this.address, new Id(body), number);
      return place < 0 ? null : { motion: this.#motions[place]!, number: module.i32[number >> 2]! };
    });
  }
  /** Returns six numbers for each: position and velocity, as Motion.states() does; NaN for unknown bodies. */
  states(time: number, bodies: ArrayLike<BodyId>): Float64Array {
    requireNumbers(bodies, "bodies", "BodyMap.states");
    return this.read({ size: 48 * bodies.length }, "map_states", time, bodies.length, new Ids(bodies)).numbers;
  }
  /**
   * Returns a map of the same bodies, in which the motion to[k] stands for from[k]: for clones of a world and of its
   * motions.
   */
  withMotions(from: readonly Motion[], to: readonly Motion[]): BodyMap {
    if (from.length !== to.length)
      throw new RangeError(`withMotions: to must have as many motions as from, ${from.length}, but has ${to.length}`);
    const addresses = (motions: readonly Motion[]): Argument => (module) =>
      module.words(motions.map((motion) => Number(Owned.addressOf(motion, "Motion", "motion", "withMotions"))));
    return new BodyMap(existing, this.word("map_with_motions", from.length, addresses(from), addresses(to)), to);
  }

  private keep(motion: Motion): void {
    if (!this.#motions.includes(motion)) this.#motions.push(motion);
  }
  /** Adds a body of a motion by this function of the module. */
  private added(name: string, world: World, motion: Motion, number: number, call: string, ...body: Argument[]): BodyId {
    const id = this.read({ size: 16 }, name, ...addressesOf(world, motion, call), numberIn(number), ...body).id(0);
    this.keep(motion);
    return id;
  }
  private change(name: string, world: World, body: BodyId, call: string, ...numbers: number[][]): void {
    this.check(name, Owned.addressOf(world, "World", "world", call), new Id(body), ...numbers);
  }
}

function addressesOf(world: World, motion: Motion, call: string): [world: Value, motion: Value] {
  return [Owned.addressOf(world, "World", "world", call), Owned.addressOf(motion, "Motion", "motion", call)];
}
