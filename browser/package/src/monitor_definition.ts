// Definitions of monitors: classes, separations, levels.
import { boundOf, type ErrorBound, putBound } from "./error_bound.js";
import type { Place } from "./memory.js";
import type { Module } from "./module.js";
import { checkKeys, type Keys, shown, whole } from "./options.js";
import {
  classAt, monitorAt, monitorFieldKeys, type MonitorFields, monitorFieldsOf, putMonitorFields, separationAt, separationRuleAt,
} from "./records.js";
import { type Vec3, vector } from "./state.js";

/** Motion limits that hold for all tracks of a class. At least one of the two limits has to be finite. */
export interface TrackClass {
  /** Largest difference of the acceleration from `plannedAcceleration` (length / time^2); by default Infinity. */
  accelerationLimit?: ErrorBound;
  plannedAcceleration?: Vec3;
  /** Largest speed (length / time); by default Infinity. */
  largestSpeed?: ErrorBound;
}

/** The part of a separation that all shapes have. */
export interface LookAhead {
  /**
   * >= 0 (time): closest approaches within the separation that come in this time, if both go straight on, are
   * `predicted`; for wellClear, losses of well clear. By default 0: nothing is predicted.
   */
  lookAhead?: number;
}
export interface SphereSeparation extends LookAhead {
  distance: number;
}
export interface VolumeSeparation extends LookAhead {
  /** > 0 (length). */
  horizontal: number;
  /** > 0 (length); ignored in two dimensions. */
  vertical: number;
}
/** Loss of well clear with the modified tau of RTCA DO-365; see kinesphere/monitor/separation.hpp. */
export interface WellClearSeparation extends VolumeSeparation {
  /** >= 0 (time). */
  modifiedTau: number;
}

/** Two tracks are within a separation if one is in this region around the other. It has one of these keys. */
export type Separation =
  | { sphere: SphereSeparation }
  | { ellipsoid: VolumeSeparation }
  | { cylinder: VolumeSeparation }
  | { wellClear: WellClearSeparation };

/** The separations between the tracks of two classes. */
export interface SeparationRule {
  /** Indices into the classes of the definition; by default 0. */
  firstClass?: number;
  secondClass?: number;
  /** Each level has its own verdicts. The first one is the widest, for example a caution, the last one an alarm. */
  levels: readonly Separation[];
}

/** The part of all pairs that one monitor watches; see `Shard` in kinesphere/monitor/monitor.hpp. */
export interface Shard {
  of?: number;
  first?: number;
  count?: number;
}

/** The definition of a monitor; kinesphere/monitor/monitor.hpp documents each field. */
export interface MonitorDefinition extends MonitorFields {
  classes: readonly TrackClass[];
  /** Pairs of classes that no rule names are not watched. */
  separations?: readonly SeparationRule[];
  /** Start of the clock; by default the first timestamp, or the first time passed to advance(). */
  startTime?: number;
  shard?: Shard;
}

/** A definition with all defaults filled in. */
export type FullMonitorDefinition =
  Required<Omit<MonitorDefinition, "startTime" | "classes" | "separations" | "shard">> &
  Pick<MonitorDefinition, "startTime"> & {
    classes: Required<TrackClass>[];
    separations: Required<SeparationRule>[];
    shard: Required<Shard>;
  };

const monitorKeys: Keys<MonitorDefinition> = {
  classes: true, separations: true, ...monitorFieldKeys, startTime: "number", shard: true,
};
const classKeys: Keys<TrackClass> = { accelerationLimit: true, plannedAcceleration: true, largestSpeed: true };
const ruleKeys: Keys<SeparationRule> = { firstClass: "number", secondClass: "number", levels: true };
const shardKeys: Keys<Shard> = { of: "number", first: "number", count: "number" };
const sphereKeys: Keys<SphereSeparation> = { distance: "number", lookAhead: "number" };
const volumeKeys: Keys<VolumeSeparation> = { horizontal: "number", vertical: "number", lookAhead: "number" };
const wellClearKeys: Keys<WellClearSeparation> = { ...volumeKeys, modifiedTau: "number" };
type ShapeName = "sphere" | "ellipsoid" | "cylinder" | "wellClear";
const levelKeys: Readonly<Record<ShapeName, true>> = { sphere: true, ellipsoid: true, cylinder: true, wellClear: true };
/** The shapes of the library, by number. */
const shapes = ["ellipsoid", "cylinder", "wellClear"] as const;

/** Returns the shape and the numbers of a ks_separation. */
function levelNumbers(level: Separation, what: string): number[] {
  const call = "Monitor";
  checkKeys<Partial<Record<ShapeName, object>>>(level, levelKeys, what, call);
  if (Object.keys(level).length !== 1)
    throw new TypeError(`${call}: ${what} must have exactly one of the keys ${Object.keys(levelKeys).join(", ")}`);
  if ("sphere" in level) {
    checkKeys(level.sphere, sphereKeys, `${what}.sphere`, call);
    const { distance, lookAhead = 0 } = level.sphere;
    return [0, distance, distance, lookAhead, 0];
  }
  if ("wellClear" in level) {
    checkKeys(level.wellClear, wellClearKeys, `${what}.wellClear`, call);
    const { horizontal, vertical, modifiedTau, lookAhead = 0 } = level.wellClear;
    return [2, horizontal, vertical, lookAhead, modifiedTau];
  }
  const [shape, name, volume] = "cylinder" in level ? [1, "cylinder", level.cylinder] : [0, "ellipsoid", level.ellipsoid];
  checkKeys(volume, volumeKeys, `${what}.${name}`, call);
  return [shape, volume.horizontal, volume.vertical, volume.lookAhead ?? 0, 0];
}

function separationOf(from: Place): Separation {
  const name = shapes[from.word(separationAt.shape)]!;
  const horizontal = from.number(separationAt.horizontal), vertical = from.number(separationAt.vertical);
  const lookAhead = from.number(separationAt.lookAhead), modifiedTau = from.number(separationAt.modifiedTau);
  if (name === "wellClear") return { wellClear: { horizontal, vertical, lookAhead, modifiedTau } };
  if (name === "cylinder") return { cylinder: { horizontal, vertical, lookAhead } };
  return horizontal === vertical ? { sphere: { distance: horizontal, lookAhead } }
                                 : { ellipsoid: { horizontal, vertical, lookAhead } };
}

function list<T>(values: readonly T[], what: string): readonly T[] {
  if (!Array.isArray(values)) throw new TypeError(`Monitor: ${what} must be an array, but is ${shown(values)}`);
  return values;
}

/** Returns the address of a ks_monitor_definition, for the duration of a call. */
export function monitorRecord(module: Module, definition: MonitorDefinition): number {
  const call = "Monitor";
  checkKeys(definition, monitorKeys, "definition", call);
  const { startTime, shard = {} } = definition;
  checkKeys(shard, shardKeys, "shard", call);
  const classes = list(definition.classes, "classes");
  const separations = list(definition.separations ?? [], "separations");
  const share = (value: number, what: string) => whole(value, Number.MAX_SAFE_INTEGER, `shard.${what}`, call);
  whole(definition.dimensions ?? 3, 3, "dimensions", call);
  const at = module.record(monitorAt);
  putMonitorFields(module, at, definition, call);
  module.putWord(at + monitorAt.hasStartTime, startTime === undefined ? 0 : 1);
  module.putNumber(at + monitorAt.startTime, startTime ?? 0);
  module.putWhole(at + monitorAt.shardOf, share(shard.of ?? 1, "of"));
  module.putWhole(at + monitorAt.shardFirst, share(shard.first ?? 0, "first"));
  module.putWhole(at + monitorAt.shardCount, share(shard.count ?? 1, "count"));
  const first = module.room(classAt.size * classes.length);
  for (const [k, one] of classes.entries()) {
    const own = first + classAt.size * k, what = `classes[${k}]`;
    checkKeys(one, classKeys, what, call);
    putBound(module, own + classAt.accelerationLimit, one.accelerationLimit ?? Infinity, `${what}.accelerationLimit`, call);
    putBound(module, own + classAt.largestSpeed, one.largestSpeed ?? Infinity, `${what}.largestSpeed`, call);
    module.putVector(own + classAt.plannedAcceleration,
                     vector(one.plannedAcceleration ?? [0, 0, 0], `${what}.plannedAcceleration`, call));
  }
  module.putWord(at + monitorAt.classes, first);
  module.putWord(at + monitorAt.classCount, classes.length);
  const rules = module.room(separationRuleAt.size * separations.length);
  for (const [k, rule] of separations.entries()) {
    const own = rules + separationRuleAt.size * k, what = `separations[${k}]`;
    checkKeys(rule, ruleKeys, what, call);
    const levels = list(rule.levels, `${what}.levels`);
    module.putWord(own + separationRuleAt.firstClass, whole(rule.firstClass ?? 0, 2 ** 32 - 1, `${what}.firstClass`, call));
    module.putWord(own + separationRuleAt.secondClass, whole(rule.secondClass ?? 0, 2 ** 32 - 1, `${what}.secondClass`, call));
    const all = module.room(separationAt.size * levels.length);
    for (const [place, level] of levels.entries()) {
      const [shape, ...numbers] = levelNumbers(level, `${what}.levels[${place}]`);
      module.putWord(all + separationAt.size * place, shape!);
      module.putVector(all + separationAt.size * place + separationAt.horizontal, numbers);
    }
    module.putWord(own + separationRuleAt.levels, all);
    module.putWord(own + separationRuleAt.levelCount, levels.length);
  }
  module.putWord(at + monitorAt.separations, rules);
  module.putWord(at + monitorAt.separationCount, separations.length);
  return at;
}

/** Reads a ks_monitor_definition. */
export function monitorDefinitionOf(module: Module, from: Place): FullMonitorDefinition {
  const records = <T>(of: Place, first: number, count: number, size: number, read: (record: Place) => T) =>
    Array.from({ length: of.word(count) }, (_, k) => read(module.at(of.word(first) + size * k)));
  return {
    ...monitorFieldsOf(from),
    ...(from.word(monitorAt.hasStartTime) === 0 ? {} : { startTime: from.number(monitorAt.startTime) }),
    shard: {
      of: from.whole(monitorAt.shardOf), first: from.whole(monitorAt.shardFirst), count: from.whole(monitorAt.shardCount),
    },
    classes: records(from, monitorAt.classes, monitorAt.classCount, classAt.size, (one) => ({
      accelerationLimit: boundOf(one, classAt.accelerationLimit),
      largestSpeed: boundOf(one, classAt.largestSpeed),
      plannedAcceleration: one.vector(classAt.plannedAcceleration).slice(),
    })),
    separations: records(from, monitorAt.separations, monitorAt.separationCount, separationRuleAt.size, (rule) => ({
      firstClass: rule.word(separationRuleAt.firstClass),
      secondClass: rule.word(separationRuleAt.secondClass),
      levels: records(rule, separationRuleAt.levels, separationRuleAt.levelCount, separationAt.size, separationOf),
    })),
  };
}
