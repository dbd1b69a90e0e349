// The world: moving spheres with unknown trajectories, and every contact among them, in time order.
import {
  type AnswerOptions, answerKeys, type Limits, noProbe, type PairOptions, pairKeys, queryNumbers, type QueryOptions,
} from "./answers.js";
import { asking, moving, type Probe, responded, runKeys, type RunOptions } from "./asking.js";
import {
  batchKeys, type BodyBatch, type BodyDefinition, bodyKeys, limitKeys, movedKeys, type MovedOptions, type Shape,
  type ShapeCarrier, shapeCarrierKeys, shapeFrom, shapeNumbers, staticKeys, type StaticOptions, zoneKeys, type ZoneOptions,
} from "./body.js";
import { BodyMap } from "./body_map.js";
import {
  type Box, boxKeys, type Definition, definitionAt, definitionNumbers, type WorldDefinition,
} from "./definition.js";
import { Event, Events } from "./event.js";
import { type Filter, filterFrom, filterNumbers, maskNumber, type PairFilter } from "./filter.js";
import { type KeptFilter, Owned, type Scratch, theModule } from "./module.js";
import { Motion, type MotionDefinition } from "./motion.js";
import { checkKeys, requireBytes, requireNumbers, shown, whole } from "./options.js";
import {
  bodyAt, bodySize, type EventKind, eventKinds, type MotionLimits, motionLimitsSize, type ProbeReason, probeReasons, putBodyFields,
  putMotionLimits, type Wall, wallOf,
} from "./records.js";
import {
  numbersOfRotation, partsFrom, rigidArguments, type RigidBodyDefinition, type RigidPart, type Rotation, rotationFrom,
  type RotationProbeFunction,
} from "./rigid_body.js";
import {
  type BodyId, countOf, each, pairStateOf, type PerBody, requireAsMany, sixOf, type State, type Vec3, vector,
} from "./state.js";

/** What the world knows of a body now. */
export interface BodyView {
  id: BodyId;
  /** The centre of the bound now, and its radius: the bound contains the body. */
  centre: Float64Array;
  boundRadius: number;
  radius: number;
  /** Time of the body's last report, and its state in it. */
  reportTime: number;
  reported: State;
  /** Contains the body until boxEnd. */
  box: { lower: Float64Array; upper: Float64Array };
  boxEnd: number;
  enabled: boolean;
  isStatic: boolean;
  sleeping: boolean;
  accelerationLimit: number;
  sensorClass: number;
  userData: number;
  /** In periodic space: the number of periods between the body and the first box. */
  image: Float64Array;
  solid: boolean;
  mass: number;
  filter: Required<Filter>;
  /** WorldView.partsOf() and rotation() say more of a rigid body. */
  isRigid: boolean;
}

/** The first possible contact or approach, and the partner. */
export interface Earliest {
  /** No contact or approach comes before this time; infinite if none can come. */
  time: number;
  partner: BodyId | null;
  wall: Wall | null;
  /** The contact or approach exists already. */
  now: boolean;
}

/** A body that a query found, and whether that is certain. */
export interface Certain { body: BodyId; certainly: boolean }
/** A body with limits of its distance. */
export interface Located extends Certain { lower: number; upper: number }

/** Counts of the work so far. */
export interface Counters {
  events: Record<EventKind, number>;
  probes: number;
  windowEnds: number;
  starts: number;
  restarts: number;
  pairChecks: number;
  wallChecks: number;
  searches: number;
  candidates: number;
  hotPairs: number;
  certificates: number;
  zenoSteps: number;
  repeatedContacts: number;
  /** Contacts that are `jammed`: a bounce parts their bodies without speed, so energy is lost. */
  jammedContacts: number;
}

/** A body that was probed while profiling was on, and why. */
export interface BusyBody {
  body: BodyId;
  reason: ProbeReason;
  /** For a person: what the reason means, and what makes such a body cheaper. */
  advice: string;
  /** Probed states of the body; the sum of the next five. */
  probes: number;
  /** For a body or wall that it touches. */
  touching: number;
  /** For a body, wall or sensor distance that it may reach or leave. */
  near: number;
  /** At ends of its windows of time. */
  windows: number;
  /** After changes and violated bounds. */
  changes: number;
  /** For queries and predictions with a probe. */
  queries: number;
  /** Events contact_begin and wall_begin of the body. */
  contacts: number;
  accelerationLimit: number;
  /** Largest deviation from the planned acceleration that reported velocities prove. */
  largestAcceleration: number;
}

const viewNumbers = 34;
const busyNumbers = 11;

/** Read access to a world, which may be that of a replay. */
export class WorldView extends Owned {
  get time(): number {
    return theModule().call("world_time", this.address);
  }
  /** Number of bodies. */
  get size(): number {
    return theModule().call("world_size", this.address);
  }
  get definition(): Definition {
    const module = theModule();
    return definitionAt(module, module.call("world_definition", this.address));
  }
  /** True if this world issued the id and the body has not been removed. */
  contains(body: BodyId): boolean {
    return theModule().call("world_contains", this.address, body) !== 0;
  }
  /** Returns all present bodies, by index. */
  bodies(): Float64Array {
    const module = theModule();
    module.call("world_bodies", this.address);
    return module.answer();
  }
  /** What the world knows of a body now. */
  body(id: BodyId): BodyView {
    return this.bodyViews([id])[0]!;
  }
  /** Without `ids`, for all bodies. */
  bodyViews(ids: ArrayLike<number> = this.bodies()): BodyView[] {
    requireNumbers(ids, "ids", "bodyViews");
    const module = theModule();
    const all = module.with((scratch) => {
      module.require(module.call("world_views", this.address, ids.length, scratch.numbers(ids)));
      return module.answer();
    });
    return Array.from(ids, (id, k) => {
      const numbers = all.subarray(k * viewNumbers, (k + 1) * viewNumbers);
      return {
        id,
        centre: numbers.subarray(0, 3),
        boundRadius: numbers[3]!,
        radius: numbers[4]!,
        reportTime: numbers[5]!,
        reported: { position: numbers.subarray(6, 9), velocity: numbers.subarray(9, 12) },
        box: { lower: numbers.subarray(12, 15), upper: numbers.subarray(15, 18) },
        boxEnd: numbers[18]!,
        enabled: numbers[19] === 1,
        isStatic: numbers[20] === 1,
        sleeping: numbers[21] === 1,
        accelerationLimit: numbers[22]!,
        sensorClass: numbers[23]!,
        userData: numbers[24]!,
        image: numbers.subarray(25, 28),
        solid: numbers[28] === 1,
        mass: numbers[29]!,
        filter: filterFrom(numbers, 30),
        isRigid: numbers[33] === 1,
      };
    });
  }
  /**
   * Returns the shape of a static body, that of a moving shape relative to its position, or, for any other body, a ball at
   * the position of its last report.
   */
  shapeOf(body: BodyId): Shape {
    const module = theModule();
    module.require(module.call("world_shape_of", this.address, body));
    return shapeFrom(Array.from(module.answer()));
  }
  /** Returns the rotation of a rigid body at its last report. */
  rotation(body: BodyId): Rotation {
    const module = theModule();
    module.require(module.call("world_rotation", this.address, body));
    return rotationFrom(module.answer());
  }
  /** Returns the parts of a rigid body, as it was added. */
  partsOf(body: BodyId): RigidPart[] {
    const module = theModule();
    module.require(module.call("world_parts_of", this.address, body));
    return partsFrom(module.answer());
  }
  /** Returns the bodies that the body touches, in order of their begins. */
  touching(body: BodyId): Float64Array {
    const module = theModule();
    module.require(module.call("world_touching", this.address, body));
    return module.answer();
  }
  /** Returns the sensor distances that the body is within, by partner, and for each from the largest to the smallest. */
  sensorOverlaps(body: BodyId): { body: BodyId; distance: number }[] {
    const module = theModule();
    module.require(module.call("world_sensor_overlaps", this.address, body));
    const numbers = module.answer();
    return Array.from({ length: numbers.length / 2 }, (_, k) => ({ body: numbers[2 * k]!, distance: numbers[2 * k + 1]! }));
  }
  get counters(): Counters {
    const module = theModule();
    module.call("world_counters", this.address);
    const numbers = module.answer();
    const after = eventKinds.length;
    return {
      events: Object.fromEntries(eventKinds.map((kind, k) => [kind, numbers[k]!])) as Record<EventKind, number>,
      probes: numbers[after]!,
      windowEnds: numbers[after + 1]!,
      starts: numbers[after + 2]!,
      restarts: numbers[after + 3]!,
      pairChecks: numbers[after + 4]!,
      wallChecks: numbers[after + 5]!,
      searches: numbers[after + 6]!,
      candidates: numbers[after + 7]!,
      hotPairs: numbers[after + 8]!,
      certificates: numbers[after + 9]!,
      zenoSteps: numbers[after + 10]!,
      repeatedContacts: numbers[after + 11]!,
      jammedContacts: numbers[after + 12]!,
    };
  }
  /**
   * Returns the bodies that were probed most often while profiling was on (World.setProfiling), at most `count`, the most
   * probed first. Throws KinesphereError (not_profiling) if profiling was never on.
   */
  busiest(count = 10): BusyBody[] {
    const module = theModule();
    module.require(module.call("world_busiest", this.address, whole(count, 2 ** 32 - 1, "count", "busiest")));
    const all = module.answer();
    return Array.from({ length: all.length / busyNumbers }, (_, k) => {
      const numbers = all.subarray(k * busyNumbers, (k + 1) * busyNumbers);
      module.call("advice", numbers[1]!);
      return {
        body: numbers[0]!,
        reason: probeReasons[numbers[1]!]!,
        advice: module.textOfBytes(),
        probes: numbers[2]!,
        touching: numbers[3]!,
        near: numbers[4]!,
        windows: numbers[5]!,
        changes: numbers[6]!,
        queries: numbers[7]!,
        contacts: numbers[8]!,
        accelerationLimit: numbers[9]!,
        largestAcceleration: numbers[10]!,
      };
    });
  }
  /** Returns three numbers for each certificate: two ids, -1 for the walls, and its failure time. */
  certificates(): Float64Array {
    const module = theModule();
    module.call("world_certificates", this.address);
    return module.answer();
  }
  /** Returns seven numbers for each occupied cell: two corners, and the number of bodies. */
  cells(): Float64Array {
    const module = theModule();
    module.call("world_cells", this.address);
    return module.answer();
  }

  // Predictions and queries. They answer from what the world knows; with a probe in the options, as well as fresh reports
  // of undecided bodies allow.

  /** Returns a time before which no contact begins in the whole world. */
  safeUntil(options?: AnswerOptions): number;
  /**
   * Returns a time before which no contact of the two bodies begins; with a distance in the options, one before which the
   * two surfaces do not come that near.
   */
  safeUntil(first: BodyId, second: BodyId, options?: PairOptions): number;
  safeUntil(first: BodyId | AnswerOptions = {}, second?: BodyId, options: PairOptions = {}): number {
    const call = "safeUntil";
    if (typeof first === "object") {
      checkKeys(first, answerKeys, "options", call);
      return this.earliest("world_safe_until", call, first).time;
    }
    checkKeys(options, pairKeys, "options", call);
    return this.earliest("world_safe_until_of_pair", call, options, first, second!, options.distance ?? NaN).time;
  }
  /** Returns the first possible contact of the body. */
  earliestContact(body: BodyId, options: AnswerOptions = {}): Earliest {
    checkKeys(options, answerKeys, "options", "earliestContact");
    return this.earliest("world_earliest_contact", "earliestContact", options, body);
  }
  /**
   * Returns the first time at which another body may be within `distance` (length >= 0) of the body, between surfaces.
   */
  earliestApproach(body: BodyId, distance: number, options: AnswerOptions = {}): Earliest {
    checkKeys(options, answerKeys, "options", "earliestApproach");
    return this.earliest("world_earliest_approach", "earliestApproach", options, body, distance);
  }
  /** Returns limits of the distance between the surfaces of two bodies now or at a later time; negative where they overlap. */
  distanceLimits(first: BodyId, second: BodyId, time = this.time, options: AnswerOptions = {}): Limits {
    checkKeys(options, answerKeys, "options", "distanceLimits");
    const [lower, upper] = this.ask("world_distance_limits", "distanceLimits", options.probe, first, second, time);
    return { lower: lower!, upper: upper! };
  }
  /** Returns all bodies that may be among the `count` nearest to a point. */
  nearest(point: Vec3, count: number, options: QueryOptions = {}): Located[] {
    const call = "nearest";
    return this.located("world_nearest", call, options, [vector(point, "point", call)],
                        whole(count, 2 ** 32 - 1, "count", call));
  }
  /** Returns all bodies that may be the first on a way. */
  rayCast(origin: Vec3, direction: Vec3, length: number, options: QueryOptions = {}): Located[] {
    const call = "rayCast";
    return this.located("world_ray_cast", call, options,
                        [vector(origin, "origin", call), vector(direction, "direction", call)], length);
  }
  /** Returns all bodies that a sphere of this radius may hit first on its way. */
  sphereCast(origin: Vec3, radius: number, direction: Vec3, length: number, options: QueryOptions = {}): Located[] {
    const call = "sphereCast";
    return this.located("world_sphere_cast", call, options,
                        [vector(origin, "origin", call), vector(direction, "direction", call)], length, radius);
  }
  /** Returns the bodies that may overlap a sphere. */
  overlapping(centre: Vec3, radius: number, options: QueryOptions = {}): Certain[] {
    const call = "overlapping";
    return this.overlaps("world_overlapping", call, options, vector(centre, "centre", call), radius);
  }
  /** Returns the bodies that may overlap a box. */
  overlappingBox(box: Box, options: QueryOptions = {}): Certain[] {
    const call = "overlappingBox";
    checkKeys(box, boxKeys, "box", call);
    return this.overlaps("world_overlapping_box", call, options,
                         [...vector(box.lower, "box.lower", call), ...vector(box.upper, "box.upper", call)]);
  }
  /** Checks all invariants from scratch; returns the first defect, or null. For tests: it takes long. */
  audit(): string | null {
    const module = theModule();
    module.call("world_audit", this.address);
    return module.textOfBytes() || null;
  }
  /** Returns the whole world, for World.restore() in any process, including native ones. */
  save(): Uint8Array {
    const module = theModule();
    module.require(module.call(this.named("world_save"), this.address));
    return module.bytes();
  }
  /** @internal Returns the export of the module that does for this object what this one does for worlds. */
  protected named(name: string): string {
    return name;
  }
  /** Returns a copy with an equal future. */
  clone(): World {
    const module = theModule();
    return World.at(module.require(module.call("world_clone", this.address)));
  }

  /** @internal Calls an export with this probe, if there is one, and returns its answer. */
  protected ask(name: string, call: string, probe: Probe | undefined, ...values: number[]): Float64Array {
    if (probe !== undefined) throw new TypeError(`${call}: the world of a replay cannot ask a probe`);
    const module = theModule();
    module.require(module.call(name, this.address, ...values, ...noProbe));
    return module.answer();
  }
  private earliest(name: string, call: string, { probe }: AnswerOptions, ...values: number[]): Earliest {
    const numbers = this.ask(name, call, probe, ...values);
    return {
      time: numbers[0]!,
      partner: numbers[1]! < 0 ? null : numbers[1]!,
      wall: wallOf(numbers[2]!),
      now: numbers[3] === 1,
    };
  }
  private overlaps(name: string, call: string, options: QueryOptions, region: number[], ...values: number[]): Certain[] {
    const found = queryNumbers(options, call);
    const numbers = theModule().with((scratch) =>
      this.ask(name, call, options.probe, scratch.numbers(region), scratch.numbers(found), ...values));
    return Array.from({ length: numbers.length / 2 }, (_, k) =>
      ({ body: numbers[2 * k]!, certainly: numbers[2 * k + 1] === 1 }));
  }
  private located(name: string, call: string, options: QueryOptions, points: number[][], ...values: number[]): Located[] {
    const found = queryNumbers(options, call);
    const numbers = theModule().with((scratch) =>
      this.ask(name, call, options.probe, ...points.map((point) => scratch.numbers(point)), scratch.numbers(found), ...values));
    return Array.from({ length: numbers.length / 4 }, (_, k) => ({
      body: numbers[4 * k]!,
      certainly: numbers[4 * k + 1] === 1,
      lower: numbers[4 * k + 2]!,
      upper: numbers[4 * k + 3]!,
    }));
  }
}

export class World extends WorldView {
  #rotationProbe: RotationProbeFunction | null = null;
  #pairFilter: KeptFilter | null = null;
  /** An event at which the pair filter threw: the next advance returns it. */
  #kept: Event | null = null;
  #warnedOfHops = false;
  #warnedOfJams = false;

  /** Throws KinesphereError for an invalid definition. */
  constructor(definition?: WorldDefinition);
  /** @internal The object at this address. */
  constructor(address: number, free: string);
  constructor(definition: WorldDefinition | number = {}, free = "world_free") {
    super(typeof definition === "number" ? definition : create(definition), free);
  }
  /** @internal */
  static at(address: number): World {
    return new World(address, "world_free");
  }
  /** @internal What the world has of JavaScript. */
  protected kept(): [KeptFilter | null, RotationProbeFunction | null] {
    return [this.#pairFilter, this.#rotationProbe];
  }
  /** @internal */
  protected keep(filter: KeptFilter | null, rotationProbe: RotationProbeFunction | null): void {
    this.#pairFilter = filter;
    this.#rotationProbe = rotationProbe;
  }
  /**
   * Restores a world from save(), called here or in any other program. A world that had a pair filter needs the same one.
   */
  static restore(snapshot: Uint8Array, pairFilter: PairFilter | null = null): World {
    requireBytes(snapshot, "snapshot", "World.restore");
    if (pairFilter !== null && typeof pairFilter !== "function")
      throw new TypeError(`World.restore: pairFilter must be a function or null, but is ${shown(pairFilter)}`);
    const module = theModule();
    const kept = pairFilter === null ? null : module.keepFilter(pairFilter);
    const world = World.at(module.with((scratch) => module.require(
      module.call("world_restore", scratch.bytes(snapshot), snapshot.length, kept?.number ?? -1))));
    world.#pairFilter = kept;
    return world;
  }

  /** Adds a body at the current time. */
  add(body: BodyDefinition): BodyId {
    checkKeys(body, bodyKeys, "body", "add");
    const numbers = new Float64Array(bodySize);
    putBodyFields(numbers, 0, body, "add");
    return this.addNumbers(numbers)[0]!;
  }
  /** Adds all bodies or, after an error, none. Returns their ids. */
  addAll(bodies: BodyBatch): Float64Array {
    const call = "addAll";
    checkKeys(bodies, batchKeys, "bodies", call);
    const count = countOf(bodies.positions, call);
    const radii = each(bodies.radii ?? 1, count, "radii", call);
    const limits = each(bodies.accelerationLimits ?? 0, count, "accelerationLimits", call);
    const userData = each(bodies.userData ?? 0, count, "userData", call);
    const masses = each(bodies.masses ?? 1, count, "masses", call);
    const { positions, velocities } = bodies;
    requireAsMany(velocities, positions, call);
    const numbers = new Float64Array(count * bodySize);
    const common = new Float64Array(bodySize);
    const { userData: _, ...options } = bodies;
    putBodyFields(common, 0, { ...options, position: [0, 0, 0] }, call);
    for (let k = 0; k < count; ++k) {
      const at = k * bodySize;
      numbers.set(common, at);
      for (let axis = 0; axis < 3; ++axis) {
        numbers[at + bodyAt.position + axis] = positions[3 * k + axis]!;
        numbers[at + bodyAt.velocity + axis] = velocities?.[3 * k + axis] ?? 0;
      }
      numbers[at + bodyAt.radius] = radii[k]!;
      numbers[at + bodyAt.accelerationLimit] = limits[k]!;
      numbers[at + bodyAt.userData] = whole(userData[k]!, 2 ** 53, "userData", call);
      numbers[at + bodyAt.mass] = masses[k]!;
    }
    return this.addNumbers(numbers);
  }
  /**
   * Adds all bodies of a motion, with these radii, to a world that never had bodies: their ids are then their numbers in
   * the motion, which can be the probe. Static bodies and others come after it, or a BodyMap relates ids to numbers.
   */
  addMotion(motion: Motion, radii: PerBody = 1, options: MovedOptions = {}): Float64Array {
    const call = "addMotion";
    checkKeys(options, movedKeys, "options", call);
    Owned.addressOf(motion, "Motion", "motion", call);
    if (this.size > 0)
      throw new RangeError(`${call}: motion must be added to a world without bodies, so that its numbers are ids; there are ` +
                           `${this.size} (a BodyMap has no such need)`);
    const count = motion.size;
    const sizes = each(radii, count, "radii", call);
    const numbers = new Float64Array(count * bodySize);
    for (let k = 0; k < count; ++k) {
      const known: MotionDefinition = motion.definition(k, this.time);
      putBodyFields(numbers, k * bodySize, { ...options, ...known, radius: sizes[k]! }, call);
    }
    const ids = this.addNumbers(numbers);
    if (ids.every((id, k) => id === k)) return ids;
    for (const id of ids) this.remove(id);
    throw new RangeError(`${call}: motion must be added to a world that never had bodies, so that its numbers are ids ` +
                         "(a BodyMap has no such need)");
  }
  /**
   * Adds a body that carries a box, a triangle or a mesh, given relative to its position, without turning it: a lift, a
   * door, a piston. It meets all bodies, static ones and other moving shapes too, but no walls of the world. A mass of
   * Infinity makes a body that no contact turns.
   */
  addMovingShape(shape: Shape, body: ShapeCarrier): BodyId {
    const call = "addMovingShape";
    checkKeys(body, shapeCarrierKeys, "body", call);
    const module = theModule();
    const [kind, parts] = shapeNumbers(shape, call);
    const numbers = new Float64Array(bodySize);
    putBodyFields(numbers, 0, body, call);
    const id = module.with((scratch) =>
      module.call(this.named("world_add_moving_shape"), this.address, kind, scratch.numbers(parts), scratch.numbers(numbers)));
    if (id < 0) throw module.error();
    return id;
  }
  /**
   * Adds a rigid body: parts that move and turn together, about its position. It is one body, with one state
   * in a probe; events name its parts. Its limits are those of the motion of its position.
   */
  addRigidBody(parts: readonly RigidPart[], body: RigidBodyDefinition): BodyId {
    const module = theModule();
    const id = module.with((scratch) =>
      module.call(this.named("world_add_rigid_body"), this.address, ...rigidArguments(scratch, parts, body, "addRigidBody")));
    if (id < 0) throw module.error();
    return id;
  }
  /** Adds a static body. */
  addStatic(shape: Shape, options: StaticOptions = {}): BodyId {
    const call = "addStatic";
    checkKeys(options, staticKeys, "options", call);
    return this.addSurroundings("world_add_static", shape, options, call, options.solid === false ? 0 : 1,
                                whole(options.sensorClass ?? 0, 255, "sensorClass", call));
  }
  /** Adds a surface of triangles as one static body: addStatic({ mesh: { vertices, corners } }). */
  addMesh(vertices: ArrayLike<number>, corners: ArrayLike<number>, options: StaticOptions = {}): BodyId {
    return this.addStatic({ mesh: { vertices, corners } }, options);
  }
  /**
   * Adds a zone, which touches no body and reports entering and leaving bodies: sensor_enter and sensor_leave at
   * distance 0.
   */
  addZone(shape: Shape, options: ZoneOptions = {}): BodyId {
    checkKeys(options, zoneKeys, "options", "addZone");
    return this.addSurroundings("world_add_zone", shape, options, "addZone");
  }
  /** Removes a body. Its contacts end with events; its id is stale for ever. */
  remove(body: BodyId): void {
    this.change("world_remove", body);
  }
  /**
   * Sets the velocity from now on; later probes must agree with it. So a Motion that moves the body has to be told, too:
   * BodyMap.setVelocity() does both.
   */
  setVelocity(body: BodyId, velocity: Vec3): void {
    this.change("world_set_velocity", body, vector(velocity, "velocity", "setVelocity"));
  }
  /** Sets the velocities of all these bodies, three numbers for each, or on an error of none. */
  setVelocityAll(bodies: ArrayLike<BodyId>, velocities: ArrayLike<number>): void {
    const call = "setVelocityAll";
    requireNumbers(bodies, "bodies", call);
    requireNumbers(velocities, "velocities", call);
    if (velocities.length !== 3 * bodies.length)
      throw new RangeError(`${call}: velocities must have three numbers for each of ${bodies.length} bodies, ` +
                           `but has ${velocities.length}`);
    const module = theModule();
    module.with((scratch) =>
      module.require(module.call(this.named("world_set_velocity_all"), this.address, bodies.length, scratch.numbers(bodies),
                                 scratch.numbers(velocities))));
  }
  /** Sets the angular velocity (radians / time) of a rigid body from now on; a rotation probe must agree with it. */
  setAngularVelocity(body: BodyId, angularVelocity: Vec3): void {
    this.change("world_set_angular_velocity", body, vector(angularVelocity, "angularVelocity", "setAngularVelocity"));
  }
  /** Turns a rigid body at once, as teleport() moves it. */
  setRotation(body: BodyId, rotation: Rotation): void {
    this.change("world_set_rotation", body, numbersOfRotation(rotation, "setRotation"));
  }
  /**
   * Sets the function that gives the rotations of rigid bodies, directly after the probe; null removes it. Without one,
   * only bodies that keep their angular velocity can be probed. Clones have it, too, but not snapshots. What it throws
   * comes out of the call that asked.
   */
  setRotationProbe(probe: RotationProbeFunction | null): void {
    if (probe !== null && typeof probe !== "function")
      throw new TypeError("setRotationProbe: probe must be a function or null");
    const module = theModule();
    module.require(module.call("world_set_rotation_probe", this.address, probe === null ? 0 : 1));
    this.#rotationProbe = probe;
  }
  override clone(): World {
    const copy = super.clone();
    copy.keep(...this.kept());
    copy.#kept = this.#kept;
    return copy;
  }
  /** Puts a body elsewhere; later probes must agree with it. BodyMap.teleport() tells the motion, too. */
  teleport(body: BodyId, state: State): void {
    this.change("world_teleport", body, sixOf(state, "teleport"));
  }
  /** Gives a body another radius (length, >= 0) from now on. */
  setRadius(body: BodyId, radius: number): void {
    const module = theModule();
    module.require(module.call("world_set_radius", this.address, body, radius));
  }
  /**
   * Lets the radius of a ball change at this rate (length / time) from now on; negative for one that shrinks, which
   * stays a point once it is one. Events have the speed at which the surfaces approach.
   */
  setRadiusRate(body: BodyId, rate: number): void {
    const module = theModule();
    module.require(module.call("world_set_radius_rate", this.address, body, rate));
  }
  /** Gives a static body or a zone another shape: those that stay in contact with it or inside it get no event. */
  setShape(body: BodyId, shape: Shape): void {
    const module = theModule();
    const [kind, numbers] = shapeNumbers(shape, "setShape");
    module.with((scratch) =>
      module.require(module.call("world_set_shape", this.address, body, kind, scratch.numbers(numbers))));
  }
  /** Sets the mass (>= 0) that events have from now on. */
  setMass(body: BodyId, mass: number): void {
    const module = theModule();
    module.require(module.call("world_set_mass", this.address, body, mass));
  }
  /** Gives a body other motion limits from now on. */
  setMotionLimits(body: BodyId, limits: MotionLimits): void {
    checkKeys(limits, limitKeys, "limits", "setMotionLimits");
    const numbers = new Float64Array(motionLimitsSize);
    putMotionLimits(numbers, 0, limits, "setMotionLimits");
    this.change("world_set_motion_limits", body, Array.from(numbers));
  }
  /** Disables the body: it touches no other and is never probed. */
  disable(body: BodyId): void {
    this.change("world_disable", body);
  }
  /** Brings a disabled body back, in this state. */
  enable(body: BodyId, state: State): void {
    this.change("world_enable", body, sixOf(state, "enable"));
  }
  /** Puts the body to sleep: it stays in place, and is not probed, until something wakes it. */
  sleep(body: BodyId): void {
    this.change("world_sleep", body);
  }
  /** Wakes a sleeping body. */
  wake(body: BodyId): void {
    this.change("world_wake", body);
  }
  /** Sets which bodies it may touch. Contacts that the filter excludes end; overlaps that it newly admits begin at once. */
  setFilter(body: BodyId, filter: Filter): void {
    this.change("world_set_filter", body, filterNumbers(filter, "setFilter"));
  }
  /**
   * Sets a predicate of your own for pairs whose filters let them touch; null removes it. Clones have it, too, and
   * restore() takes it. What it throws comes out of the call that asked, after which the world goes on, and the pair may touch until
   * refreshFilter() or another pair filter.
   */
  setPairFilter(filter: PairFilter | null): void {
    if (filter !== null && typeof filter !== "function")
      throw new TypeError(`setPairFilter: filter must be a function or null, but is ${shown(filter)}`);
    const module = theModule();
    const kept = filter === null ? null : module.keepFilter(filter);
    const before = this.#pairFilter;
    this.#pairFilter = kept;
    // Throws what the filter threw about a pair in touch; the world has it all the same.
    if (module.call("world_set_pair_filter", this.address, kept?.number ?? -1) !== 0) return;
    this.#pairFilter = before;
    throw module.error();
  }
  /** Says that the results of the pair filter for this body have changed. */
  refreshFilter(body: BodyId): void {
    this.change("world_refresh_filter", body);
  }
  /** Sets whether the body has contacts from now on. */
  setSolid(body: BodyId, solid: boolean): void {
    const module = theModule();
    module.require(module.call("world_set_solid", this.address, body, solid ? 1 : 0));
  }
  /**
   * Sets the distances (length >= 0) at which all bodies of the class sense others with a category bit in the mask, by
   * default all.
   */
  setSensor(sensorClass: number, distances: ArrayLike<number>, mask = -1): void {
    const module = theModule();
    const call = "setSensor";
    requireNumbers(distances, "distances", call);
    const number = whole(sensorClass, 255, "sensorClass", call);
    const sensed = maskNumber(mask, "mask", call);
    module.with((scratch) => module.require(module.call(
      "world_set_sensor", this.address, number, distances.length, scratch.numbers(distances), sensed)));
  }
  /** Gives a body the sensor of another class from now on. */
  setSensorClass(body: BodyId, sensorClass: number): void {
    const module = theModule();
    const number = whole(sensorClass, 255, "sensorClass", "setSensorClass");
    module.require(module.call("world_set_sensor_class", this.address, body, number));
  }
  /**
   * Gives two bodies a state, a whole number of the caller's own that their events have, until it is set to 0 or one of
   * the two is removed.
   */
  setPairState(first: BodyId, second: BodyId, state: number): void {
    const module = theModule();
    const number = pairStateOf(state, "state", "setPairState");
    module.require(module.call("world_set_pair_state", this.address, first, second, number));
  }
  /** Returns the state of two bodies; 0 if it was never set. */
  pairState(first: BodyId, second: BodyId): number {
    const module = theModule();
    module.require(module.call("world_pair_state", this.address, first, second));
    return module.answer()[0]!;
  }
  /**
   * To be called at a sensor_enter or sensor_leave: velocities of the caller have turned the two back there, so they have
   * not crossed the distance. The event comes again if they do.
   */
  turnBack(crossing: Event): void {
    const module = theModule();
    module.with((scratch) => module.require(module.call(
      "world_turn_back", this.address, scratch.numbers(crossing.numbers))));
  }
  /** Schedules an event "timer" at a time that has not passed, and, if the period is not 0, again after each period. */
  schedule(time: number, userData = 0, period = 0): void {
    const module = theModule();
    const data = whole(userData, 2 ** 53, "userData", "schedule");
    module.require(module.call("world_schedule", this.address, time, data, period));
  }
  /** Removes all timers with these data. Returns how many there were. */
  unschedule(userData: number): number {
    const module = theModule();
    const data = whole(userData, 2 ** 53, "userData", "unschedule");
    module.require(module.call("world_unschedule", this.address, data));
    return module.answer()[0]!;
  }
  /** Stores a whole number for the caller: events have it. */
  setUserData(body: BodyId, userData: number): void {
    const module = theModule();
    const data = whole(userData, 2 ** 53, "userData", "setUserData");
    module.require(module.call("world_set_user_data", this.address, body, data));
  }

  /** @internal */
  protected override ask(name: string, call: string, probe: Probe | undefined, ...values: number[]): Float64Array {
    if (probe === undefined) return super.ask(name, call, probe, ...values);
    const module = theModule();
    module.require(this.callWith(probe, call, (addresses) => [name, ...values, 1, ...addresses]));
    return module.answer();
  }
  /** Makes a call with a probe, whose addresses the arguments contain. */
  private callWith(probe: Probe, call: string, made: (addresses: number[]) => [name: string, ...values: number[]]): number {
    const module = theModule();
    if (!(probe instanceof Motion) && !(probe instanceof BodyMap) && typeof probe !== "function")
      throw new TypeError(`${call}: probe must be a function, a Motion or a BodyMap`);
    const addresses = moving(probe);
    const [name, ...values] = made(addresses);
    const callbacks = asking(module, typeof probe === "function" ? probe : null, null, this.#rotationProbe);
    return module.callWith(callbacks, [this.address, ...addresses], name, this.address, ...values);
  }

  /** Advances to the next event and returns it, or to `until`, and returns null. */
  advance(until: number, probe: Probe): Event | null {
    const module = theModule();
    if (this.#kept !== null) {
      const event = this.#kept;
      this.#kept = null;
      return event;
    }
    const result = this.callWith(probe, "advance", (addresses) => ["world_advance", until, ...addresses]);
    if (module.filterHasThrown && result > 0) this.#kept = new Event(module.answer());
    module.rethrowOfFilter();
    if (result < 0) throw module.error();
    return result === 0 ? null : new Event(module.answer());
  }
  /**
   * Yields the events up to `until`, for a loop in which bodies may be changed. After an early exit the world stands at
   * the last event.
   */
  *events(until: number, probe: Probe): Generator<Event, void, undefined> {
    for (let event = this.advance(until, probe); event !== null; event = this.advance(until, probe)) yield event;
  }
  /**
   * Advances to `until` by itself, for bouncing bodies inside the module: the fastest way. Returns all events, and
   * passes them to `sink` if there is one; after an error, those that came before. A body that an answer removes leaves a
   * BodyMap and its motion, too.
   */
  run(until: number, options: RunOptions, sink?: (events: Events) => void): Events {
    const module = theModule();
    if (!(options?.motion instanceof Motion) && !(options?.motion instanceof BodyMap))
      throw new TypeError("run: motion must be a Motion or a BodyMap");
    checkKeys(options, runKeys, "options", "run");
    if (this.#kept !== null) throw new Error("run: the pair filter threw at an event, which advance() has yet to return");
    if (options.atStop !== undefined && typeof options.atStop !== "function")
      throw new TypeError("run: atStop must be a function of an event");
    const [responding, bounces, scene, asked] = responded(options.respond);
    return module.with((scratch) => {
      const masses = bounces.masses ?? [];
      const addresses = moving(options.motion);
      const values = [until, ...addresses, responding, scratch.numbers(masses), masses.length,
                      bounces.restitution ?? 1, bounces.restingSpeed ?? 0, scene];
      let failure: { value: unknown } | null = null;
      try {
        const callbacks = asking(module, null, asked, this.#rotationProbe, options.atStop);
        if (module.callWith(callbacks, [this.address, ...addresses], "world_run", this.address, ...values) === 0)
          failure = { value: module.error() };
      } catch (value) {
        failure = { value };
      }
      const events = new Events(module.answer());
      sink?.(events);
      if (failure !== null) throw failure.value;
      if ((bounces.restitution ?? 1) < 1 && !bounces.restingSpeed) this.warnOfHops();
      if (options.respond !== undefined && !bounces.restingSpeed) this.warnOfJams();
      return events;
    });
  }

  /**
   * Switches profiling on, from zero, or off. It is off at first, and also in clones and restored worlds. busiest() tells
   * which bodies have cost most probes since.
   */
  setProfiling(on: boolean): void {
    const module = theModule();
    module.require(module.call("world_set_profiling", this.address, on ? 1 : 0));
  }
  /** Records all inputs and outputs of this world from now on. */
  startRecording(): void {
    const module = theModule();
    module.require(module.call("world_start_recording", this.address));
  }
  /** Returns the recording, for Replay here or in any other program. */
  stopRecording(): Uint8Array {
    const module = theModule();
    module.require(module.call("world_stop_recording", this.address));
    return module.bytes();
  }

  /** Warns once of a world nearly all of whose contacts were repeated, of bodies that hop upon each other. */
  private warnOfHops(): void {
    if (this.#warnedOfHops) return;
    const { events, repeatedContacts } = this.counters;
    const contacts = events.contact_begin + events.wall_begin;
    if (repeatedContacts < 10000 || 10 * repeatedContacts < 9 * contacts) return;
    this.#warnedOfHops = true;
    console.warn(`run: ${repeatedContacts} of ${contacts} contacts followed another one at once, as those of bodies that ` +
                 "lie upon each other, and took no energy: respond: { restitution, restingSpeed } lets stacks settle");
  }
  /** Warns once of contacts without room, in which bodies lose their energy. */
  private warnOfJams(): void {
    const { jammedContacts } = this.counters;
    if (this.#warnedOfJams || jammedContacts === 0) return;
    this.#warnedOfJams = true;
    console.warn(`run: ${jammedContacts} contacts were jammed: their bodies had no room beyond the contactTolerance, and ` +
                 "parted without speed, whatever the restitution: a contactTolerance below the gaps keeps their energy");
  }
  protected change(name: string, body: BodyId, numbers?: number[]): void {
    const module = theModule();
    module.with((scratch: Scratch) =>
      module.require(module.call(this.named(name), this.address, body, ...(numbers === undefined ? [] : [scratch.numbers(numbers)]))));
  }
  private addNumbers(numbers: Float64Array): Float64Array {
    const module = theModule();
    return module.with((scratch) => {
      module.require(module.call(this.named("world_add_all"), this.address, numbers.length / bodySize, scratch.numbers(numbers)));
      return module.answer();
    });
  }
  private addSurroundings(name: string, shape: Shape, options: ZoneOptions, call: string, ...values: number[]): BodyId {
    const module = theModule();
    const [kind, numbers] = shapeNumbers(shape, call);
    const filter = filterNumbers(options.filter ?? {}, call);
    const id = module.with((scratch) =>
      module.call(name, this.address, kind, scratch.numbers(numbers), scratch.numbers(filter), ...values,
                  whole(options.userData ?? 0, 2 ** 53, "userData", call)));
    if (id < 0) throw module.error();
    return id;
  }
}

function create(definition: WorldDefinition): number {
  const module = theModule();
  return module.with((scratch) =>
    module.require(module.call("world_create", scratch.numbers(definitionNumbers(definition)))));
}
