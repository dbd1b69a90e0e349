// Definitions of worlds.
import { type Filter, filterFrom, putFilter } from "./filter.js";
import type { Place } from "./memory.js";
import type { Argument } from "./module.js";
import { checkKeys, type Keys, shown } from "./options.js";
import { putWorldFields, worldAt, worldFieldKeys, type WorldFields, worldFieldsOf } from "./records.js";
import { type Vec3, vector } from "./state.js";

/** All points with lower <= p <= upper on every axis. */
export interface Box {
  lower: Vec3;
  upper: Vec3;
}

/** The definition of a world; kinesphere/world_definition.hpp documents each field. */
export interface WorldDefinition extends WorldFields {
  /** The walls, and the period of `periodic` axes. Without a box the world is unbounded. */
  box?: Box;
  /** The filter of all walls; without one they meet every body. */
  wallFilter?: Filter;
}

/** A definition with all defaults filled in. */
export type Definition = Required<Omit<WorldDefinition, "box" | "wallFilter">> & Pick<WorldDefinition, "box" | "wallFilter">;

const definitionKeys: Keys<WorldDefinition> = { box: true, ...worldFieldKeys, wallFilter: true };
const periodicKeys: Keys<NonNullable<WorldDefinition["periodic"]>> = { x: "boolean", y: "boolean", z: "boolean" };
export const boxKeys: Keys<Box> = { lower: true, upper: true };

/** Returns a ks_world_definition as an argument. */
export function definitionRecord(definition: WorldDefinition): Argument {
  checkKeys(definition, definitionKeys, "definition", "World");
  const { box, periodic, wallFilter, dimensions = 3 } = definition;
  if (dimensions !== 2 && dimensions !== 3)
    throw new RangeError(`World: dimensions must be 2 or 3, but is ${shown(dimensions)}`);
  if (box !== undefined) checkKeys(box, boxKeys, "box", "World");
  if (periodic !== undefined) checkKeys(periodic, periodicKeys, "periodic", "World");
  return (module) => {
    const at = module.record(worldAt);
    putWorldFields(module, at, definition, "World");
    if (box !== undefined) {
      module.putWord(at + worldAt.hasBox, 1);
      module.putVector(at + worldAt.box, vector(box.lower, "box.lower", "World"));
      module.putVector(at + worldAt.box + 24, vector(box.upper, "box.upper", "World"));
    }
    module.putWord(at + worldAt.hasWallFilter, wallFilter === undefined ? 0 : 1);
    putFilter(module, at + worldAt.wallFilter, wallFilter ?? {}, "World");
    return at;
  };
}

/** Reads a ks_world_definition. */
export function definitionOf(from: Place): Definition {
  return {
    ...worldFieldsOf(from),
    ...(from.word(worldAt.hasBox) === 0 ? {}
        : { box: { lower: from.vector(worldAt.box), upper: from.vector(worldAt.box + 24) } }),
    ...(from.word(worldAt.hasWallFilter) === 0 ? {} : { wallFilter: filterFrom(from, worldAt.wallFilter) }),
  };
}
