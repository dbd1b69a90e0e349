// Definitions of monitors: classes, separations, levels.
import { boundNumbers, boundOf, type ErrorBound } from "./error_bound.js";
import { checkKeys, type Keys, shown, whole } from "./options.js";
import { monitorFieldKeys, type MonitorFields, monitorFieldsOf, monitorSize, putMonitorFields } from "./records.js";
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

function separationOf(numbers: Float64Array): Separation {
  const [shape, horizontal, vertical, lookAhead, modifiedTau] =
    Array.from(numbers) as [number, number, number, number, number];
  const name = shapes[shape]!;
  if (name === "wellClear") return { wellClear: { horizontal, vertical, lookAhead, modifiedTau } };
  if (name === "cylinder") return { cylinder: { horizontal, vertical, lookAhead } };
  return horizontal === vertical ? { sphere: { distance: horizontal, lookAhead } }
                                 : { ellipsoid: { horizontal, vertical, lookAhead } };
}

function list<T>(values: readonly T[], what: string): readonly T[] {
  if (!Array.isArray(values)) throw new TypeError(`Monitor: ${what} must be an array, but is ${shown(values)}`);
  return values;
}

/** Returns numbers in the order of monitor_definition_at() in browser/module/monitor.cpp. */
export function monitorNumbers(definition: MonitorDefinition): number[] {
  const call = "Monitor";
  checkKeys(definition, monitorKeys, "definition", call);
  const shard = definition.shard ?? {};
  checkKeys(shard, shardKeys, "shard", call);
  const classes = list(definition.classes, "classes");
  const separations = list(definition.separations ?? [], "separations");
  const share = (value: number, what: string) => whole(value, Number.MAX_SAFE_INTEGER, `shard.${what}`, call);
  whole(definition.dimensions ?? 3, 3, "dimensions", call);
  const fields = new Float64Array(monitorSize);
  putMonitorFields(fields, 0, definition, call);
  const numbers = [
    ...fields,
    definition.startTime === undefined ? 0 : 1,
    definition.startTime ?? 0,
    share(shard.of ?? 1, "of"),
    share(shard.first ?? 0, "first"),
    share(shard.count ?? 1, "count"),
    classes.length,
    separations.length,
  ];
  for (const [k, one] of classes.entries()) {
    checkKeys(one, classKeys, `classes[${k}]`, call);
    numbers.push(
      ...boundNumbers(one.accelerationLimit ?? Infinity, `classes[${k}].accelerationLimit`, call),
      ...boundNumbers(one.largestSpeed ?? Infinity, `classes[${k}].largestSpeed`, call),
      ...vector(one.plannedAcceleration ?? [0, 0, 0], `classes[${k}].plannedAcceleration`, call));
  }
  for (const [k, rule] of separations.entries()) {
    const what = `separations[${k}]`;
    checkKeys(rule, ruleKeys, what, call);
    const levels = list(rule.levels, `${what}.levels`);
    numbers.push(whole(rule.firstClass ?? 0, 2 ** 32 - 1, `${what}.firstClass`, call),
                 whole(rule.secondClass ?? 0, 2 ** 32 - 1, `${what}.secondClass`, call), levels.length);
    for (const [place, level] of levels.entries()) numbers.push(...levelNumbers(level, `${what}.levels[${place}]`));
  }
  return numbers;
}

/** Returns the definition that these numbers describe. */
export function monitorDefinitionOf(numbers: Float64Array): FullMonitorDefinition {
  let next = monitorSize;
  const number = () => numbers[next++]!;
  const several = (count: number) => numbers.subarray(next, (next += count));
  const [starts, startTime] = several(2);
  const common = {
    ...monitorFieldsOf(numbers), ...(starts === 0 ? {} : { startTime: startTime! }),
    shard: { of: number(), first: number(), count: number() },
  };
  const classes = number(), rules = number();
  return {
    ...common,
    classes: Array.from({ length: classes }, () =>
      ({ accelerationLimit: boundOf(several(3)), largestSpeed: boundOf(several(3)), plannedAcceleration: several(3) })),
    separations: Array.from({ length: rules }, () => {
      const [firstClass, secondClass, levels] = several(3);
      return {
        firstClass: firstClass!,
        secondClass: secondClass!,
        levels: Array.from({ length: levels! }, () => separationOf(several(5))),
      };
    }),
  };
}
