// Definitions of worlds.
import { type Filter, filterFrom, filterNumbers } from "./filter.js";
import type { Module } from "./module.js";
import { checkKeys, type Keys, shown } from "./options.js";
import { putWorldFields, worldFieldKeys, type WorldFields, worldFieldsOf, worldSize } from "./records.js";
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

/** Returns numbers in the order of definition_at() in browser/module/world.cpp. */
export function definitionNumbers(definition: WorldDefinition): number[] {
  checkKeys(definition, definitionKeys, "definition", "World");
  const { box, periodic, wallFilter, dimensions = 3 } = definition;
  if (dimensions !== 2 && dimensions !== 3)
    throw new RangeError(`World: dimensions must be 2 or 3, but is ${shown(dimensions)}`);
  if (box !== undefined) checkKeys(box, boxKeys, "box", "World");
  if (periodic !== undefined) checkKeys(periodic, periodicKeys, "periodic", "World");
  const corners = box === undefined
    ? [0, 0, 0, 0, 0, 0]
    : [...vector(box.lower, "box.lower", "World"), ...vector(box.upper, "box.upper", "World")];
  const fields = new Float64Array(worldSize);
  putWorldFields(fields, 0, definition, "World");
  return [
    ...fields, box === undefined ? 0 : 1, ...corners,
    wallFilter === undefined ? 0 : 1, ...filterNumbers(wallFilter ?? {}, "World"),
  ];
}

/** Returns the definition at this address in the module. */
export function definitionAt(module: Module, address: number): Definition {
  module.call("definition_numbers", address);
  const numbers = module.answer();
  const more = numbers.subarray(worldSize);
  return {
    ...worldFieldsOf(numbers),
    ...(more[0] === 0 ? {} : { box: { lower: more.subarray(1, 4), upper: more.subarray(4, 7) } }),
    ...(more[7] === 0 ? {} : { wallFilter: filterFrom(more, 8) }),
  };
}
