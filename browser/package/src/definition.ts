// Definitions of worlds.
import { type Filter, filterFrom, filterNumbers } from "./filter.js";
import type { Module } from "./module.js";
import { checkKeys, type Keys, shown } from "./options.js";
import { type Vec3, vector } from "./state.js";

/** All points with lower <= p <= upper on every axis. */
export interface Box {
  lower: Vec3;
  upper: Vec3;
}

/**
 * Which contact events a body asks for. "all": a begin and an end for each contact, and a begin for each further approach
 * in between (`alreadyTouching`). "impacts", for what only bounces: a begin for each approach, and no ends.
 * "begin_and_end", for contacts that are watched and not answered. Two bodies report what either asks for.
 */
export type ContactEvents = "all" | "begin_and_end" | "impacts";
const contactEvents = [undefined, "impacts", "begin_and_end", "all"] as const;

/** The definition of a world; kinesphere/world_definition.hpp documents each field. */
export interface WorldDefinition {
  /** The walls. Without a box the world is unbounded. */
  box?: Box;
  /** Axes on which space is periodic with the box, without walls. */
  periodic?: { x?: boolean; y?: boolean; z?: boolean };
  /** The filter of all walls; without one they meet every body. */
  wallFilter?: Filter;
  /** 2: bodies are discs in the plane z = 0. */
  dimensions?: 2 | 3;
  /** > 0 (length). */
  contactTolerance?: number;
  /** > contactTolerance (length): the gap at which a contact ends. */
  separationDistance?: number;
  /** What bodies ask for that do not say it themselves; by default "all". */
  contacts?: ContactEvents;
  /** If false, bodies that certainly overlap are refused. */
  allowOverlap?: boolean;
  /** >= 0 (time): contacts of a body that follow each other sooner are `repeated`. */
  zenoInterval?: number;
  startTime?: number;
  /** Has no effect. */
  spreadWindowStarts?: boolean;
  /** A report that breaks the promise of its body raises the body's accelerationLimit; by default true. */
  adoptObservedLimits?: boolean;
}

/** A definition with all defaults filled in. */
export type Definition = Required<Omit<WorldDefinition, "box" | "wallFilter">> & Pick<WorldDefinition, "box" | "wallFilter">;

const definitionKeys: Keys<WorldDefinition> = {
  box: true, periodic: true, wallFilter: true, dimensions: "number", contactTolerance: "number",
  separationDistance: "number", contacts: true, allowOverlap: "boolean", zenoInterval: "number", startTime: "number",
  spreadWindowStarts: "boolean", adoptObservedLimits: "boolean",
};
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
  return [
    box === undefined ? 0 : 1,
    ...corners,
    periodic?.x ? 1 : 0,
    periodic?.y ? 1 : 0,
    periodic?.z ? 1 : 0,
    dimensions,
    definition.contactTolerance ?? 1e-6,
    definition.separationDistance ?? NaN,
    numberOfContacts(definition.contacts ?? "all", "World"),
    definition.allowOverlap === false ? 0 : 1,
    definition.zenoInterval ?? 0,
    definition.startTime ?? 0,
    definition.spreadWindowStarts ? 1 : 0,
    wallFilter === undefined ? 0 : 1,
    ...filterNumbers(wallFilter ?? {}, "World"),
    definition.adoptObservedLimits === false ? 0 : 1,
  ];
}

export function numberOfContacts(contacts: ContactEvents, call: string): number {
  const number = contactEvents.indexOf(contacts);
  if (number < 1) throw new TypeError(`${call}: contacts must be "all", "begin_and_end" or "impacts", but is ${shown(contacts)}`);
  return number;
}

/** Returns the definition at this address in the module. */
export function definitionAt(module: Module, address: number): Definition {
  module.call("definition_numbers", address);
  const numbers = module.answer();
  return {
    ...(numbers[0] === 0 ? {} : { box: { lower: numbers.subarray(1, 4), upper: numbers.subarray(4, 7) } }),
    periodic: { x: numbers[7] !== 0, y: numbers[8] !== 0, z: numbers[9] !== 0 },
    dimensions: numbers[10] as 2 | 3,
    contactTolerance: numbers[11]!,
    separationDistance: numbers[12]!,
    contacts: contactEvents[numbers[13]!] as ContactEvents,
    allowOverlap: numbers[14] !== 0,
    zenoInterval: numbers[15]!,
    startTime: numbers[16]!,
    spreadWindowStarts: numbers[17] !== 0,
    adoptObservedLimits: numbers[22] !== 0,
    ...(numbers[18] === 0 ? {} : { wallFilter: filterFrom(numbers, 19) }),
  };
}
