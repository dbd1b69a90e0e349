// The world: moving spheres with unknown trajectories, and every contact among them, in time order.
import {
  type AnswerOptions, answerKeys, type Limits, type PairOptions, pairKeys, type QueriesOptions, queriesKeys, queryKeys,
  type QueryOptions,
} from "./answers.js";
import { answeringOf, answeringRecord, type Probe, probing, rotating, runKeys, type RunOptions } from "./asking.js";
import {
  batchKeys, type BodyBatch, type BodyDefinition, bodyKeys, bodyRecord, limitKeys, movedKeys, type MovedOptions,
  type Shape, type ShapeCarrier, shapeCarrierKeys, shapeFrom, shapeRecord, staticKeys, type StaticOptions, zoneKeys,
  type ZoneOptions,
} from "./body.js";
import { BodyMap } from "./body_map.js";
import { type Box, boxKeys, type Definition, definitionOf, definitionRecord, type WorldDefinition } from "./definition.js";
import { type Event, eventFrom, eventRoom, Events } from "./event.js";
import { type Filter, filterArguments, filterFrom, keptFilter, maskNumber, type PairFilter, putFilter } from "./filter.js";
import { Place } from "./memory.js";
import { type Argument, Id, Ids, type Kept, Owned, theModule, type Value } from "./module.js";
import { Motion } from "./motion.js";
import { checkKeys, numberOf, refusePromise, requireBytes, requireNumbers, whole } from "./options.js";
import {
  bodyAt, bodyViewAt, busyBodyAt, busyBodyOf, type BusyFields, eventAt, type EventKind, eventKinds, eventListAt, hitAt,
  type MotionLimits, motionLimitsAt, predictionAt, putMotionLimits, rayAt, runAt, sensorOverlapAt, shapeAt, sphereAt,
  staticAt, type Timings, timingsAt, timingsOf, type Wall, wallOf, worldAt,
} from "./records.js";
import { eventRecord } from "./response.js";
import {
  numbersOfRotation, partsFrom, type RigidBodyDefinition, type RigidPart, rigidRecords, type Rotation, rotationFrom,
  rotationNumbers, type RotationProbeFunction,
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

/** Counts of the work so far, in the order of the module; jammedContacts are those whose bodies a bounce parts without speed. */
const counterNames = [
  "probes", "windowEnds", "starts", "restarts", "pairChecks", "wallChecks", "searches", "candidates", "hotPairs",
  "certificates", "zenoSteps", "repeatedContacts", "jammedContacts",
] as const;
/** Counts of the work so far. */
export interface Counters extends Record<(typeof counterNames)[number], number> {
  events: Record<EventKind, number>;
}

/** A body that was probed while profiling was on, and why. */
export interface BusyBody extends BusyFields {
  /** For a person: what the reason means, and what makes such a body cheaper. */
  advice: string;
}

/** What world_views() in browser/module/looking.cpp writes: a ks_body_view, and five numbers. */
const viewAt = {
  size: bodyViewAt.size + 40, centre: bodyViewAt.size, boundRadius: bodyViewAt.size + 24, isRigid: bodyViewAt.size + 32,
};
/** The definition in a ks_body_view. */
const definitionAt = (field: keyof typeof bodyAt) => bodyViewAt.definition + bodyAt[field];

/** Read access to a world, which may be that of a replay. */
export class WorldView extends Owned {
  /** @internal */
  constructor(address: Value, free: string) {
    super(address, free);
  }
  get time(): number {
    return this.number("ks_world_time");
  }
  /** Number of bodies. */
  get size(): number {
    return this.word("ks_world_size");
  }
  get definition(): Definition {
    return definitionOf(this.read(worldAt, "world_definition"));
  }
  /** True if this world issued the id and the body has not been removed. */
  contains(body: BodyId): boolean {
    return this.word("ks_world_contains", new Id(body)) !== 0;
  }
  /** Returns all present bodies, by index. */
  bodies(): Float64Array {
    return this.idsBy("ks_world_bodies");
  }
  /** What the world knows of a body now. */
  body(id: BodyId): BodyView {
    return this.bodyViews([id])[0]!;
  }
  /** Without `ids`, for all bodies. */
  bodyViews(ids: ArrayLike<number> = this.bodies()): BodyView[] {
    requireNumbers(ids, "ids", "bodyViews");
    const all = this.read({ size: viewAt.size * ids.length }, "world_views", ids.length, new Ids(ids));
    return Array.from(ids, (id, k) => {
      const view = new Place(all.numbers, all.words, viewAt.size * k);
      return {
        id,
        centre: view.vector(viewAt.centre),
        boundRadius: view.number(viewAt.boundRadius),
        radius: view.number(definitionAt("radius")),
        reportTime: view.number(bodyViewAt.reportTime),
        reported: view.state(definitionAt("position")),
        box: { lower: view.vector(bodyViewAt.box), upper: view.vector(bodyViewAt.box + 24) },
        boxEnd: view.number(bodyViewAt.boxEnd),
        enabled: view.word(bodyViewAt.enabled) !== 0,
        isStatic: view.word(bodyViewAt.isStatic) !== 0,
        sleeping: view.word(bodyViewAt.sleeping) !== 0,
        accelerationLimit: view.number(definitionAt("accelerationLimit")),
        sensorClass: view.word(definitionAt("sensorClass")),
        userData: view.whole(definitionAt("userData")),
        image: Float64Array.of(
          view.signed(bodyViewAt.image), view.signed(bodyViewAt.image + 8), view.signed(bodyViewAt.image + 16)),
        solid: view.word(definitionAt("solid")) !== 0,
        mass: view.number(definitionAt("mass")),
        filter: filterFrom(view, definitionAt("filter")),
        isRigid: view.number(viewAt.isRigid) !== 0,
      };
    });
  }
  /**
   * Returns the shape of a static body, that of a moving shape relative to its position, or, for any other body, a ball at
   * the position of its last report.
   */
  shapeOf(body: BodyId): Shape {
    return shapeFrom(Array.from(this.told("world_shape_of", new Id(body))));
  }
  /** Returns the rotation of a rigid body at its last report. */
  rotation(body: BodyId): Rotation {
    return rotationFrom(this.read({ size: 8 * rotationNumbers }, "ks_world_rotation", new Id(body)).numbers);
  }
  /** Returns the parts of a rigid body, as it was added. */
  partsOf(body: BodyId): RigidPart[] {
    return partsFrom(this.told("world_parts_of", new Id(body)));
  }
  /** Returns the bodies that the body touches, in order of their begins. */
  touching(body: BodyId): Float64Array {
    return this.idsBy("ks_world_touching", new Id(body));
  }
  /** Returns the sensor distances that the body is within, by partner, and for each from the largest to the smallest. */
  sensorOverlaps(body: BodyId): { body: BodyId; distance: number }[] {
    const { size, body: at, distance } = sensorOverlapAt;
    return this.rows(size, (row) => ({ body: row.id(at), distance: row.number(distance) }), "ks_world_sensor_overlaps", new Id(body));
  }
  private idsBy(name: string, ...values: Argument[]): Float64Array {
    const module = theModule();
    return module.fill(12, (address, count) => module.idsAt(address, count), name, this.address, ...values);
  }
  get counters(): Counters {
    const numbers = this.told("world_counters");
    const named = <Name extends string>(names: readonly Name[], from: number) =>
      Object.fromEntries(names.map((name, k) => [name, numbers[from + k]!])) as Record<Name, number>;
    return { ...named(counterNames, eventKinds.length), events: named(eventKinds, 0) };
  }
  /**
   * Returns the bodies that were probed most often while profiling was on (World.setProfiling), at most `count`, the most
   * probed first. Throws KinesphereError (not_profiling) if profiling was never on.
   */
  busiest(count = 10): BusyBody[] {
    const module = theModule();
    const most = whole(count, 2 ** 32 - 1, "count", "busiest");
    return this.rows(busyBodyAt.size, (row) => ({
      ...busyBodyOf(row), advice: module.text(module.call("ks_probe_reason_advice", row.word(busyBodyAt.reason))),
    }), "ks_world_busiest", most);
  }
  /** Where the time went since profiling was switched on (World.setProfiling). */
  get timings(): Timings {
    return timingsOf(this.read(timingsAt, "ks_world_timings"));
  }
  /** Returns three numbers for each certificate: two ids, -1 for the walls, and its failure time. */
  certificates(): Float64Array {
    return this.told("world_certificates");
  }
  /** Returns seven numbers for each occupied cell: two corners, and the number of bodies. */
  cells(): Float64Array {
    return this.told("world_cells");
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
      return this.earliest("ks_world_safe_until", call, first, []).time;
    }
    checkKeys(options, pairKeys, "options", call);
    const [name, more] = options.distance === undefined ? ["world_pair_safe_until", []] as const
      : ["ks_world_pair_safe_until", [options.distance]] as const;
    return this.earliest(name, call, options, [first, second!], ...more).time;
  }
  /** Returns the first possible contact of the body. */
  earliestContact(body: BodyId, options: AnswerOptions = {}): Earliest {
    checkKeys(options, answerKeys, "options", "earliestContact");
    return this.earliest("ks_world_earliest_contact", "earliestContact", options, [body]);
  }
  /**
   * Returns the first time at which another body may be within `distance` (length >= 0) of the body, between surfaces.
   */
  earliestApproach(body: BodyId, distance: number, options: AnswerOptions = {}): Earliest {
    checkKeys(options, answerKeys, "options", "earliestApproach");
    return this.earliest("ks_world_earliest_approach", "earliestApproach", options, [body], distance);
  }
  /** Returns limits of the distance between the surfaces of two bodies now or at a later time; negative where they overlap. */
  distanceLimits(first: BodyId, second: BodyId, time = this.time, options: AnswerOptions = {}): Limits {
    checkKeys(options, answerKeys, "options", "distanceLimits");
    const module = theModule();
    return module.with(() => {
      const at = module.room(16);
      this.check("ks_world_distance_limits", new Id(first), new Id(second), time,
                 ...this.probing(options.probe, "distanceLimits"), at, at + 8);
      return { lower: module.f64[at >> 3]!, upper: module.f64[(at + 8) >> 3]! };
    });
  }
  /** Returns all bodies that may be among the `count` nearest to a point. */
  nearest(point: Vec3, count: number, options: QueryOptions = {}): Located[] {
    const call = "nearest";
    const bodies = whole(count, 2 ** 32 - 1, "count", call);
    return this.query({ call, one: "ks_world_nearest", all: "ks_world_nearest_all", options, before: [bodies] },
                      vector(point, "point", call), located);
  }
  /** Returns all bodies that may be the first on a way. */
  rayCast(origin: Vec3, direction: Vec3, length: number, options: QueryOptions = {}): Located[] {
    return this.cast(origin, direction, length, 0, "rayCast", options);
  }
  /** Returns all bodies that a sphere of this radius may hit first on its way. */
  sphereCast(origin: Vec3, radius: number, direction: Vec3, length: number, options: QueryOptions = {}): Located[] {
    return this.cast(origin, direction, length, radius, "sphereCast", options);
  }
  /** Returns the bodies that may overlap a sphere. */
  overlapping(centre: Vec3, radius: number, options: QueryOptions = {}): Certain[] {
    const call = "overlapping";
    const sphere = [...vector(centre, "centre", call), numberOf(radius, "radius", call)];
    return this.query({ call, one: "ks_world_overlapping_sphere", all: "ks_world_overlapping_all", options }, sphere, certain);
  }
  /** Returns the bodies that may overlap a box. */
  overlappingBox(box: Box, options: QueryOptions = {}): Certain[] {
    const call = "overlappingBox";
    checkKeys(box, boxKeys, "box", call);
    checkKeys(options, queryKeys, "options", call);
    const corners = [...vector(box.lower, "box.lower", call), ...vector(box.upper, "box.upper", call)];
    const found = this.told("world_overlapping_box", corners, new Id(options.except ?? -1), filtering(options.filter, call),
                            ...this.probing(options.probe, call));
    return Array.from({ length: found.length / 2 }, (_, k) => ({ body: found[2 * k]!, certainly: found[2 * k + 1] === 1 }));
  }

  // Many queries at once: with a probe, one call of it serves all that are open.

  /** Returns for each point, three numbers in `points`, what nearest() does. */
  nearestAll(points: ArrayLike<number>, count: number, options: QueriesOptions = {}): Located[][] {
    const call = "nearestAll";
    const bodies = whole(count, 2 ** 32 - 1, "count", call);
    const queries = columns(call, ["points", points, 3]);
    return this.queries("ks_world_nearest_all", call, queries, 3, options, located, bodies);
  }
  /**
   * Returns for each ray what rayCast() does or, with radii, sphereCast(): three numbers each in `origins` and in
   * `directions`.
   */
  rayCastAll(
    origins: ArrayLike<number>, directions: ArrayLike<number>, lengths: PerBody, options: QueriesOptions = {},
    radii: PerBody = 0,
  ): Located[][] {
    const call = "rayCastAll";
    const rays = columns(
      call, ["origins", origins, 3], ["directions", directions, 3], ["lengths", lengths, 1], ["radii", radii, 1]);
    return this.queries("ks_world_cast_all", call, rays, rayAt.size / 8, options, located);
  }
  /** Returns for each sphere, three numbers in `centres` and a radius, what overlapping() does. */
  overlappingAll(centres: ArrayLike<number>, radii: PerBody, options: QueriesOptions = {}): Certain[][] {
    const call = "overlappingAll";
    const spheres = columns(call, ["centres", centres, 3], ["radii", radii, 1]);
    return this.queries("ks_world_overlapping_all", call, spheres, sphereAt.size / 8, options, certain);
  }
  /** Checks all invariants from scratch; returns the first defect, or null. For tests: it takes long. */
  audit(): string | null {
    return theModule().text(this.word("world_audit")) || null;
  }
  /** Returns the whole world, for World.restore() in any process, including native ones. */
  save(): Uint8Array {
    return this.filled("ks_world_save");
  }
  /** Returns a copy with an equal future. */
  clone(): World {
    return World.at(this.handle("ks_world_clone"));
  }

  /** @internal Returns the arguments of C for a probe. */
  protected probing(probe: Probe | undefined, call: string): Argument[] {
    if (probe !== undefined) throw new TypeError(`${call}: the world of a replay cannot ask a probe`);
    return [0, 0];
  }
  private earliest(name: string, call: string, { probe }: AnswerOptions, bodies: BodyId[], ...values: number[]): Earliest {
    const ids = bodies.map((body) => new Id(body));
    const from = this.read(predictionAt, name, ...ids, ...values, ...this.probing(probe, call));
    const partner = from.id(predictionAt.partner);
    return {
      time: from.number(predictionAt.time),
      partner: partner < 0 ? null : partner,
      wall: wallOf(from.word(predictionAt.wall)),
      now: from.word(predictionAt.happens) !== 0,
    };
  }
  private cast(
    origin: Vec3, direction: Vec3, length: number, radius: number, call: string, options: QueryOptions,
  ): Located[] {
    const ray = [
      ...vector(origin, "origin", call), ...vector(direction, "direction", call), numberOf(length, "length", call),
      numberOf(radius, "radius", call),
    ];
    return this.query({ call, one: "ks_world_cast", all: "ks_world_cast_all", options }, ray, located);
  }
  /**
   * Answers a query by the function `one`, which takes vectors by their addresses, or, as that takes no options, as the
   * only one of many.
   */
  private query<Hit>({ call, one, all, options, before = [] }: Query, numbers: number[], hit: (row: Place) => Hit): Hit[] {
    checkKeys(options, queryKeys, "options", call);
    const { filter, except, probe } = options;
    if (filter !== undefined || except !== undefined) {
      const { except: _, ...rest } = options;
      const queries = except === undefined ? rest : { ...rest, except: [except] };
      return this.queries(all, call, Float64Array.from(numbers), numbers.length, queries, hit, ...before)[0]!;
    }
    const vectors = Array.from({ length: Math.floor(numbers.length / 3) }, (_, k) => numbers.slice(3 * k, 3 * k + 3));
    return this.rows(
      hitAt.size, hit, one, ...vectors, ...numbers.slice(3 * vectors.length), ...before, ...this.probing(probe, call));
  }
  private queries<Hit>(
    name: string, call: string, numbers: Float64Array, width: number, options: QueriesOptions, hit: (row: Place) => Hit,
    ...before: number[]
  ): Hit[][] {
    checkKeys(options, queriesKeys, "options", call);
    const { filter, except, probe } = options;
    const count = numbers.length / width;
    if (except !== undefined) each(except, count, "except", call);
    const module = theModule();
    return module.with(() => {
      const ends = module.room(4 * count);
      const hits = this.rows(hitAt.size, hit, name, numbers, except === undefined ? 0 : new Ids(except), count, ...before,
                             filtering(filter, call), ...this.probing(probe, call), ends);
      const end = (k: number) => (k < 0 ? 0 : module.i32[(ends >> 2) + k]!);
      return Array.from({ length: count }, (_, k) => hits.slice(end(k - 1), end(k)));
    });
  }
}

/** A query by one of two functions of C; `before` stands before the probe. */
interface Query {
  call: string;
  one: string;
  all: string;
  options: QueryOptions;
  before?: number[];
}

const certain = (row: Place): Certain => ({ body: row.id(hitAt.body), certainly: row.word(hitAt.certain) !== 0 });
const located = (row: Place): Located =>
  ({ ...certain(row), lower: row.number(hitAt.lower), upper: row.number(hitAt.upper) });

/** Returns the argument of C for a filter, which is 0 without one. */
function filtering(filter: Filter | undefined, call: string): Argument {
  if (filter === undefined) return 0;
  return (module) => {
    const at = module.room(24);
    putFilter(module, at, filter, call);
    return at;
  };
}

/** Joins columns to rows: of each its name, its values, and how many of them each row has. */
function columns(call: string, ...all: [what: string, values: PerBody, width: number][]): Float64Array {
  const [[what, first, firstWidth]] = all as [[string, ArrayLike<number>, number]];
  requireNumbers(first, what, call);
  if (first.length % firstWidth !== 0)
    throw new RangeError(`${call}: ${what} must have ${firstWidth} numbers for each query, but has ${first.length}`);
  const count = first.length / firstWidth;
  const size = all.reduce((sum, [, , width]) => sum + width, 0);
  const joined = new Float64Array(size * count);
  let at = 0;
  for (const [what, values, width] of all) {
    const given = each(values, count * width, what, call);
    for (let k = 0; k < given.length; ++k) joined[Math.floor(k / width) * size + at + (k % width)] = given[k]!;
    at += width;
  }
  return joined;
}

export class World extends WorldView {
  #rotationProbe: Kept | null = null;
  #pairFilter: Kept | null = null;
  /** An event at which the pair filter threw: the next advance returns it. */
  #kept: Event | null = null;
  /** A motion was seen to move bodies here. */
  #isMoved = false;
  #warnedOfHops = false;
  #warnedOfJams = false;

  /** Throws KinesphereError for an invalid definition. */
  constructor(definition?: WorldDefinition);
  /** @internal The object of this handle. */
  constructor(handle: Value);
  constructor(definition: WorldDefinition | Value = {}) {
    super(typeof definition === "object" ? create(definition) : definition, "ks_world_destroy");
  }
  /** @internal */
  static at(handle: Value): World {
    return new World(handle);
  }
  /** @internal */
  protected override get kind(): string {
    return "World";
  }
  /** @internal What the world has of JavaScript. */
  protected kept(): [filter: Kept | null, rotationProbe: Kept | null] {
    return [this.#pairFilter, this.#rotationProbe];
  }
  /** @internal */
  protected keep(filter: Kept | null, rotationProbe: Kept | null): void {
    this.#pairFilter = filter;
    this.#rotationProbe = rotationProbe;
  }
  /**
   * Restores a world from save(), called here or in any other program. A world that had a pair filter needs the same one.
   */
  static restore(snapshot: Uint8Array, pairFilter: PairFilter | null = null): World {
    const call = "World.restore";
    requireBytes(snapshot, "snapshot", call);
    const module = theModule();
    const kept = keptFilter(module, pairFilter, "pairFilter", call);
    const world = World.at(module.handle("ks_world_restore", snapshot, snapshot.length, ...filterArguments(module, kept)));
    world.#pairFilter = kept;
    return world;
  }

  /** Adds a body at the current time. */
  add(body: BodyDefinition): BodyId {
    checkKeys(body, bodyKeys, "body", "add");
    return this.added("ks_world_add", bodyRecord(body, "add"), 1);
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
    const { userData: _, ...options } = bodies;
    const module = theModule();
    return this.addEach(count, { ...options, position: [0, 0, 0] }, call, (at, k) => {
      for (let axis = 0; axis < 3; ++axis) {
        module.f64[((at + bodyAt.position) >> 3) + axis] = positions[3 * k + axis]!;
        module.f64[((at + bodyAt.velocity) >> 3) + axis] = velocities?.[3 * k + axis] ?? 0;
      }
      module.putNumber(at + bodyAt.radius, radii[k]!);
      module.putNumber(at + bodyAt.accelerationLimit, limits[k]!);
      module.putNumber(at + bodyAt.mass, masses[k]!);
      module.putWhole(at + bodyAt.userData, whole(userData[k]!, 2 ** 53, "userData", call));
    });
  }
  /** Adds bodies that are all as `like` but for what change(address of the definition, k) writes. */
  private addEach(count: number, like: BodyDefinition, call: string, change: (at: number, k: number) => void): Float64Array {
    const module = theModule();
    return module.with(() => {
      const { size } = bodyAt;
      const first = bodyRecord(like, call)(module), all = module.room(size * count), ids = module.room(12 * count);
      for (let k = 0; k < count; ++k) {
        const at = all + size * k;
        module.bytes.copyWithin(at, first, first + size);
        change(at, k);
      }
      this.check("ks_world_add", all, count, ids);
      return module.idsAt(ids, count);
    });
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
    const { time } = this;
    const module = theModule();
    const ids = this.addEach(count, { ...options, position: [0, 0, 0] }, call, (at, k) => {
      const known = motion.definition(k, time);
      module.putNumber(at + bodyAt.radius, sizes[k]!);
      module.putNumber(at + bodyAt.accelerationLimit, known.accelerationLimit);
      module.putNumber(at + bodyAt.positionError, known.positionError);
      module.putNumber(at + bodyAt.velocityError, known.velocityError);
      module.putVector(at + bodyAt.plannedAcceleration, known.plannedAcceleration);
      module.putVector(at + bodyAt.position, known.position);
      module.putVector(at + bodyAt.velocity, known.velocity);
    });
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
    return this.added("ks_world_add_moving_shape", bodyRecord(body, call), shapeRecord(shape, call));
  }
  /**
   * Adds a rigid body: parts that move and turn together, about its position. It is one body, with one state
   * in a probe; events name its parts. Its limits are those of the motion of its position.
   */
  addRigidBody(parts: readonly RigidPart[], body: RigidBodyDefinition): BodyId {
    return this.added("ks_world_add_rigid_body", ...rigidRecords(parts, body, "addRigidBody"));
  }
  /** Adds a static body. */
  addStatic(shape: Shape, options: StaticOptions = {}): BodyId {
    const call = "addStatic";
    checkKeys(options, staticKeys, "options", call);
    return this.added("ks_world_add_static", (module) => {
      const made = shapeRecord(shape, call)(module), at = module.record(staticAt);
      module.putWord(at + staticAt.solid, options.solid === false ? 0 : 1);
      module.putWord(at + staticAt.sensorClass, whole(options.sensorClass ?? 0, 255, "sensorClass", call));
      module.bytes.copyWithin(at + staticAt.shape, made, made + shapeAt.size);
      putFilter(module, at + staticAt.filter, options.filter ?? {}, call);
      module.putWhole(at + staticAt.userData, whole(options.userData ?? 0, 2 ** 53, "userData", call));
      return at;
    }, 1);
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
    const call = "addZone";
    checkKeys(options, zoneKeys, "options", call);
    const data = BigInt(whole(options.userData ?? 0, 2 ** 53, "userData", call));
    const zone = this.added("ks_world_add_zone", shapeRecord(shape, call), data);
    if (options.filter !== undefined) this.setFilter(zone, options.filter);
    return zone;
  }
  /** Calls a function that writes the id of a body, and returns the id. */
  private added(name: string, ...values: Argument[]): BodyId {
    return this.read({ size: 16 }, name, ...values).id(0);
  }
  /** Reserves memory for this number of bodies in total. */
  reserve(bodies: number): void {
    this.check("ks_world_reserve", whole(bodies, 2 ** 32 - 1, "bodies", "reserve"));
  }
  /** Removes a body. Its contacts end with events; its id is stale for ever. */
  remove(body: BodyId): void {
    this.check("ks_world_remove", new Id(body), 1);
  }
  /**
   * Sets the velocity from now on; later probes must agree with it. So a Motion that moves the body has to be told, too:
   * BodyMap.setVelocity() does both.
   */
  setVelocity(body: BodyId, velocity: Vec3): void {
    this.check("ks_world_set_velocity", new Id(body), vector(velocity, "velocity", "setVelocity"));
  }
  /** Sets the velocities of all these bodies, three numbers for each, or on an error of none. */
  setVelocityAll(bodies: ArrayLike<BodyId>, velocities: ArrayLike<number>): void {
    const call = "setVelocityAll";
    requireNumbers(bodies, "bodies", call);
    requireNumbers(velocities, "velocities", call);
    if (velocities.length !== 3 * bodies.length)
      throw new RangeError(`${call}: velocities must have three numbers for each of ${bodies.length} bodies, ` +
                           `but has ${velocities.length}`);
    this.check("ks_world_set_velocities", new Ids(bodies), velocities, bodies.length);
  }
  /** Sets the angular velocity (radians / time) of a rigid body from now on; a rotation probe must agree with it. */
  setAngularVelocity(body: BodyId, angularVelocity: Vec3): void {
    this.check("ks_world_set_angular_velocity", new Id(body), vector(angularVelocity, "angularVelocity", "setAngularVelocity"));
  }
  /** Turns a rigid body at once, as teleport() moves it. */
  setRotation(body: BodyId, rotation: Rotation): void {
    this.check("ks_world_set_rotation", new Id(body), numbersOfRotation(rotation, "setRotation"));
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
    const kept = probe === null ? null : module.keep(rotating(module, probe));
    this.check("ks_world_set_rotation_probe", kept === null ? 0 : module.pointer("rotate"), kept?.number ?? 0);
    this.#rotationProbe = kept;
  }
  override clone(): World {
    const copy = super.clone();
    copy.keep(...this.kept());
    copy.#kept = this.#kept;
    return copy;
  }
  /** Puts a body elsewhere; later probes must agree with it. BodyMap.teleport() tells the motion, too. */
  teleport(body: BodyId, state: State): void {
    this.check("ks_world_teleport", new Id(body), sixOf(state, "teleport"));
  }
  /** Gives a body another radius (length, >= 0) from now on. */
  setRadius(body: BodyId, radius: number): void {
    this.check("ks_world_set_radius", new Id(body), radius);
  }
  /**
   * Lets the radius of a ball change at this rate (length / time) from now on; negative for one that shrinks, which
   * stays a point once it is one. Events have the speed at which the surfaces approach.
   */
  setRadiusRate(body: BodyId, rate: number): void {
    this.check("ks_world_set_radius_rate", new Id(body), rate);
  }
  /** Gives a static body or a zone another shape: those that stay in contact with it or inside it get no event. */
  setShape(body: BodyId, shape: Shape): void {
    this.check("ks_world_set_shape", new Id(body), shapeRecord(shape, "setShape"));
  }
  /** Sets the mass (>= 0) that events have from now on. */
  setMass(body: BodyId, mass: number): void {
    this.check("ks_world_set_mass", new Id(body), mass);
  }
  /** Gives a body other motion limits from now on. */
  setMotionLimits(body: BodyId, limits: MotionLimits): void {
    const call = "setMotionLimits";
    checkKeys(limits, limitKeys, "limits", call);
    this.check("ks_world_set_motion_limits", new Id(body), (module) => {
      const at = module.room(motionLimitsAt.size);
      putMotionLimits(module, at, limits, call);
      return at;
    });
  }
  /** Disables the body: it touches no other and is never probed. */
  disable(body: BodyId): void {
    this.check("ks_world_disable", new Id(body));
  }
  /** Brings a disabled body back, in this state. */
  enable(body: BodyId, state: State): void {
    this.check("ks_world_enable", new Id(body), sixOf(state, "enable"));
  }
  /** Puts the body to sleep: it stays in place, and is not probed, until something wakes it. */
  sleep(body: BodyId): void {
    this.check("ks_world_sleep", new Id(body));
  }
  /** Wakes a sleeping body. */
  wake(body: BodyId): void {
    this.check("ks_world_wake", new Id(body));
  }
  /** Sets which bodies it may touch. Contacts that the filter excludes end; overlaps that it newly admits begin at once. */
  setFilter(body: BodyId, filter: Filter): void {
    this.check("ks_world_set_filter", new Id(body), filtering(filter, "setFilter"));
  }
  /**
   * Sets a predicate of your own for pairs whose filters let them touch; null removes it. Clones have it, too, and
   * restore() takes it. What it throws comes out of the call that asked, after which the world goes on, and the pair may touch until
   * refreshFilter() or another pair filter.
   */
  setPairFilter(filter: PairFilter | null): void {
    const module = theModule();
    const kept = keptFilter(module, filter, "filter", "setPairFilter");
    const name = "ks_world_set_pair_filter";
    const status = module.status(name, this.address, ...filterArguments(module, kept));
    const error = status === 0 ? null : module.error(status, name);
    if (error === null) this.#pairFilter = kept;
    // Throws what the filter threw about a pair in touch; the world has it all the same.
    module.rethrow();
    if (error !== null) throw error;
  }
  /** Says that the results of the pair filter for this body have changed. */
  refreshFilter(body: BodyId): void {
    this.check("ks_world_refresh_filter", new Id(body));
  }
  /** Sets whether the body has contacts from now on. */
  setSolid(body: BodyId, solid: boolean): void {
    this.check("ks_world_set_solid", new Id(body), solid ? 1 : 0);
  }
  /**
   * Sets the distances (length >= 0) at which all bodies of the class sense others with a category bit in the mask, by
   * default all.
   */
  setSensor(sensorClass: number, distances: ArrayLike<number>, mask = -1): void {
    const call = "setSensor";
    requireNumbers(distances, "distances", call);
    const number = whole(sensorClass, 255, "sensorClass", call);
    const sensed = BigInt(maskNumber(mask, "mask", call));
    this.check("ks_world_set_sensor", number, distances, distances.length, sensed);
  }
  /** Gives a body the sensor of another class from now on. */
  setSensorClass(body: BodyId, sensorClass: number): void {
    this.check("ks_world_set_sensor_class", new Id(body), whole(sensorClass, 255, "sensorClass", "setSensorClass"));
  }
  /**
   * Gives two bodies a state, a whole number of the caller's own that their events have, until it is set to 0 or one of
   * the two is removed.
   */
  setPairState(first: BodyId, second: BodyId, state: number): void {
    this.check("ks_world_set_pair_state", new Id(first), new Id(second), pairStateOf(state, "state", "setPairState"));
  }
  /** Returns the state of two bodies; 0 if it was never set. */
  pairState(first: BodyId, second: BodyId): number {
    return this.word("ks_world_pair_state", new Id(first), new Id(second));
  }
  /**
   * To be called at a sensor_enter or sensor_leave: velocities of the caller have turned the two back there, so they have
   * not crossed the distance. The event comes again if they do.
   */
  turnBack(crossing: Event): void {
    this.check("ks_world_turn_back", eventRecord(crossing));
  }
  /** Schedules an event "timer" at a time that has not passed, and, if the period is not 0, again after each period. */
  schedule(time: number, userData = 0, period = 0): void {
    const data = BigInt(whole(userData, 2 ** 53, "userData", "schedule"));
    this.check("ks_world_schedule", time, data, period);
  }
  /** Removes all timers with these data. Returns how many there were. */
  unschedule(userData: number): number {
    return this.word("ks_world_unschedule", BigInt(whole(userData, 2 ** 53, "userData", "unschedule")));
  }
  /** Stores a whole number for the caller: events have it. */
  setUserData(body: BodyId, userData: number): void {
    this.check("ks_world_set_user_data", new Id(body), BigInt(whole(userData, 2 ** 53, "userData", "setUserData")));
  }

  /** @internal */
  protected override probing(probe: Probe | undefined, call: string): Argument[] {
    return probe === undefined ? [0, 0] : probing(probe, call);
  }
  /** Refuses a motion whose bodies the caller forgot to add. */
  private requireMoved(motion: Probe): void {
    if (this.#isMoved || !(motion instanceof Motion)) return;
    this.check("world_check_motion", motion.address);
    this.#isMoved = true;
  }
  /** @internal Advances to the next event with a probe of C. */
  protected next(until: number, ...probe: Argument[]): Event | null {
    const module = theModule();
    const name = "ks_world_advance";
    // It is written as the last thing, so that a call inside of a probe may have used the same memory.
    const at = eventRoom(module);
    module.putWord(at, eventAt.size);
    const status = module.status(name, this.address, until, ...probe, at);
    const event = status === 0 && module.i32[(at + eventAt.kind) >> 2] !== 0 ? eventFrom(module, at) : null;
    if (module.hasThrown) this.#kept = event;
    module.rethrow();
    if (status !== 0) throw module.error(status, name);
    return event;
  }

  /** Advances to the next event and returns it, or to `until`, and returns null. */
  advance(until: number, probe: Probe): Event | null {
    if (this.#kept !== null) {
      const event = this.#kept;
      this.#kept = null;
      return event;
    }
    this.requireMoved(probe);
    return this.next(until, ...probing(probe, "advance"));
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
    const call = "run";
    if (!(options?.motion instanceof Motion) && !(options?.motion instanceof BodyMap))
      throw new TypeError("run: motion must be a Motion or a BodyMap");
    checkKeys(options, runKeys, "options", call);
    if (this.#kept !== null) throw new Error("run: the pair filter threw at an event, which advance() has yet to return");
    const { motion, respond, atStop } = options;
    if (atStop !== undefined && typeof atStop !== "function") throw new TypeError("run: atStop must be a function of an event");
    this.requireMoved(motion);
    const mover: Argument = (to) => to.use(motion.address);
    const atEvent = (event: number) => refusePromise(atStop!(eventFrom(module, event)), "atStop");
    return module.with(() => {
      const told = module.room(eventListAt.size);
      module.putWord(told + eventListAt.count, 0);
      const answering = answeringOf(module, respond, call, atStop !== undefined, (size) => module.room(size));
      const user = answering.callback === null ? 0 : module.hold(answering.callback);
      const definition = answeringRecord(module, runAt, answering, user);
      module.putWord(definition + runAt.sink, module.pointer("sink"));
      module.putWord(definition + runAt.sinkUser, module.hold(atEvent));
      const movers = motion instanceof Motion ? [mover, 0] : [0, mover];
      const status = module.status("world_run", this.address, until, ...movers, definition, answering.scene,
                                   answering.masses, answering.masses.length, told);
      const failure = module.takeThrown() ?? (status === 0 ? null : { value: module.error(status, "world_run") });
      const count = module.i32[(told + eventListAt.count) >> 2]!;
      const events = new Events(module.copy(module.i32[(told + eventListAt.events) >> 2]!, count * eventAt.size));
      sink?.(events);
      if (failure !== null) throw failure.value;
      if (answering.restitution < 1 && !answering.restingSpeed) this.warnOfHops();
      if (respond !== undefined && !answering.restingSpeed) this.warnOfJams();
      return events;
    });
  }

  /**
   * Switches profiling on, from zero, or off. It is off at first, and also in clones and restored worlds. busiest() tells
   * which bodies have cost most probes since.
   */
  setProfiling(on: boolean): void {
    this.check("ks_world_set_profiling", on ? 1 : 0);
  }
  /** Records all inputs and outputs of this world from now on. */
  startRecording(): void {
    this.check("ks_world_start_recording");
  }
  /** Returns the recording, for Replay here or in any other program. */
  stopRecording(): Uint8Array {
    this.check("ks_world_stop_recording");
    return this.filled("ks_world_recording");
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
}

function create(definition: WorldDefinition): bigint {
  return theModule().handle("ks_world_create", definitionRecord(definition));
}
