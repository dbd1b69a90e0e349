"""Writes browser/package/src/records.ts: enumerations, fields of records, and where they are in tables of numbers.

The module writes and reads the same tables by interface/fields.hpp, field after field, as browser/module/numbers.hpp
converts them.
"""

from __future__ import annotations

import json

import meaning
from cplusplus import walked_fields
from header import Enumeration, Field, Interface, Record, lower_camel, wrapped

# Names of enumerations, and of the lists of their names.
enumerations = {
    "ks_event_kind": ("EventKind", "eventKinds"),
    "ks_wall": ("Wall", "walls"),
    "ks_contacts": ("ContactEvents", "contactEvents"),
    "ks_body_action": ("BodyAction", "bodyActions"),
    "ks_probe_reason": ("ProbeReason", "probeReasons"),
    "ks_verdict": ("Verdict", "verdicts"),
    "ks_monitor_event_kind": ("MonitorEventKind", "monitorEventKinds"),
}
# Numbers that a field takes; all others take one.
widths = {"ks_vec3": 3, "ks_state": 6, "ks_filter": 3, "ks_axes": 3, "ks_error_bound": 3}
# Records that the library gives, with the names of their classes or interfaces.
got = {
    "ks_event": "EventFields",
    "ks_monitor_event": "MonitorEventFields",
    "ks_pair_answer": "PairAnswer",
    "ks_open_pair": "OpenPair",
    "ks_predicted_pair": "PredictedPair",
    "ks_report_request": "ReportRequest",
}
classes = {"ks_event", "ks_monitor_event"}
# What callers give, with the names of their interfaces, and fields that have no default.
given = {
    "ks_world_definition": ("WorldFields", ()),
    "ks_body_definition": ("BodyFields", ("position",)),
    "ks_motion_limits": ("MotionLimits", ()),
    "ks_monitor_definition": ("MonitorFields", ()),
    "ks_track_report": ("ReportFields", ("timestamp",)),
}
# Fields that the classes made by hand have in another form.
by_hand = {
    "ks_monitor_event": ("second", "verdict", "before"),
    "ks_track_report": ("state", "velocity_error"),
}
whole_numbers = {"sensor_class": "255", "user_data": "2 ** 53", "track_class": "2 ** 32 - 1"}
tracks = {"ks_monitor_event", "ks_pair_answer", "ks_open_pair", "ks_predicted_pair", "ks_report_request"}


def documented(text: str, indent: str, type: str = "") -> list[str]:
    plain = meaning.respelled(meaning.plain(text, type), lower_camel).replace("infinity", "Infinity")
    if type == "ks_body_id":
        plain = plain.replace("no body", "null")
    if not plain:
        return []
    lines = wrapped(plain, 118, indent + " * ")
    if len(lines) == 1 and len(indent) + len(plain) < 112:
        return [f"{indent}/** {plain} */"]
    return [indent + "/**", *lines, indent + " */"]


def stem(record: Record) -> str:
    """`monitorEvent`, for the names of its layout."""
    return lower_camel(record.name.removeprefix("ks_").removesuffix("_definition").removeprefix("track_"))


def fields_of(record: Record) -> list[tuple[Field, int]]:
    """The fields of a table, each with its place."""
    at, found = 0, []
    for name in walked_fields(record):
        found.append((record[name], at))
        at += widths.get(record[name].type.name, 1)
    return found


def size_of(record: Record) -> int:
    one, at = fields_of(record)[-1]
    return at + widths.get(one.type.name, 1)


def layout(record: Record) -> list[str]:
    name = stem(record)
    places = ", ".join(f"{lower_camel(one.name)}: {at}" for one, at in fields_of(record))
    lines = wrapped(f"export const {name}At = {{ {places} }}\u00a0as\u00a0const;", 118, "", "  ")
    return [
        f"/** @internal Places in the table of a record, and its size. */",
        *lines,
        f"/** @internal */ export const {name}Size = {size_of(record)};",
        "",
    ]


def enumeration_of(enumeration: Enumeration) -> list[str]:
    type, names = enumerations[enumeration.name]
    chosen = (
        meaning.choices(enumeration)
        if enumeration.name not in meaning.complete
        else enumeration.enumerators[1:]
    )
    texts = ", ".join(json.dumps(enumeration.short(one)) for one in chosen)
    lines = wrapped(f"export const {names} = [{texts}]\u00a0as\u00a0const;", 118, "", "  ")
    lines += documented(enumeration.comment, "") + [f"export type {type} = (typeof {names})[number];"]
    if meaning.may_lack(enumeration) and enumeration.name == "ks_wall":
        lines.append(
            f"/** @internal */ export const wallOf = (number: number): {type} | null => {names}[number - 1] ?? null;"
        )
    return [*lines, ""]


def error_codes(enumeration: Enumeration) -> list[str]:
    """The errors of the library; those of C's own interface do not reach JavaScript."""
    chosen = [one for one in enumeration.enumerators if one.value >= 20]
    texts = " | ".join(json.dumps(one.name.removeprefix("KS_ERROR_").lower()) for one in chosen)
    lines = [
        "/** The reason of a failed call: one of the error codes of the library (kinesphere/result.hpp). */"
    ]
    return [*lines, *wrapped(f"export type ErrorCode = {texts};", 118, "", "  "), ""]


def flags(interface: Interface) -> list[str]:
    lines = ["/** Properties of one body of an event. */", "export interface BodyTraits {"]
    traits = interface.enumerations["ks_traits"]
    for one in traits.enumerators:
        lines += documented(one.comment, "  ") + [f"  {lower_camel('is_' + traits.short(one))}: boolean;"]
    made = ", ".join(
        f"{lower_camel('is_' + traits.short(one))}: (bits & {one.value}) !== 0" for one in traits.enumerators
    )
    lines += ["}", "function traitsOf(bits: number): BodyTraits {", f"  return {{ {made} }};", "}", ""]
    return [*lines, 'const senses = ["neither", "first", "second", "both"] as const;', ""]


def getter(interface: Interface, record: Record, one: Field, at: int) -> str:
    name, number = one.type.name, f"this.numbers[{at}]!"
    if name == "ks_bool":
        return f"get {lower_camel(one.name)}(): boolean {{ return this.numbers[{at}] === 1; }}"
    if name in widths:
        type, value = (
            ("State", f"this.state({at})")
            if name == "ks_state"
            else ("Float64Array", f"this.numbers.subarray({at}, {at + widths[name]})")
        )
    elif name == "ks_body_id":
        type, value = (
            ("BodyId | null", f"{number} < 0 ? null : {number}")
            if meaning.may_be_nobody(one)
            else ("BodyId", number)
        )
    elif name == "ks_wall":
        type, value = "Wall | null", f"wallOf({number})"
    elif name == "ks_traits":
        type, value = "BodyTraits", f"traitsOf({number})"
    elif name == "ks_senses":
        type, value = "(typeof senses)[number]", f"senses[{number}]!"
    elif name in enumerations:
        type, value = enumerations[name][0], f"{enumerations[name][1]}[{number}]!"
    else:
        type, value = ("TrackId" if record.name in tracks and one.name == "first" else "number"), number
    return f"get {lower_camel(one.name)}(): {type} {{ return {value}; }}"


def class_of(interface: Interface, record: Record) -> list[str]:
    lines = [
        f"/** The fields of an event, read from numbers that never change. */",
        f"export class {got[record.name]} {{",
    ]
    lines += ["  /** @internal */", "  constructor(readonly numbers: Float64Array) {}", ""]
    for one, at in fields_of(record):
        if one.name not in by_hand.get(record.name, ()):
            lines += [
                *documented(one.comment, "  ", one.type.name),
                "  " + getter(interface, record, one, at),
            ]
    if any(one.type.name == "ks_state" for one in record.fields):
        lines += ["", "  private state(from: number): State {", "    return {"]
        lines += [
            "      position: this.numbers.subarray(from, from + 3),",
            "      velocity: this.numbers.subarray(from + 3, from + 6),",
        ]
        lines += ["    };", "  }"]
    return [*lines, "}", ""]


def read_value(one: Field, at: int) -> tuple[str, str]:
    """The type of a field that the library gives, and how it is read."""
    name, number = one.type.name, f"numbers[{at}]!"
    if name == "ks_bool":
        return "boolean", f"numbers[{at}] === 1"
    if name == "ks_verdict":
        return "Verdict", f"verdicts[{number}]!"
    if name == "ks_contacts":
        return "ContactEvents", f"contactEvents[{number} - 1]!"
    if name == "ks_axes":
        return "", f"{{ x: numbers[{at}] === 1, y: numbers[{at + 1}] === 1, z: numbers[{at + 2}] === 1 }}"
    if name == "int32_t":
        return "2 | 3", f"{number} as 2 | 3"
    return ("TrackId" if name == "uint64_t" else "number"), number


def interface_of(record: Record) -> list[str]:
    """An interface that the library gives, and the function that makes it of numbers."""
    name, fields = got[record.name], fields_of(record)
    lines = documented(record.comment, "") + [f"export interface {name} {{"]
    for one, at in fields:
        lines += documented(one.comment, "  ", one.type.name) + [
            f"  {lower_camel(one.name)}: {read_value(one, at)[0]};"
        ]
    lines += [
        "}",
        f"/** @internal */",
        f"export function {stem(record)}Of(numbers: Float64Array): {name} {{",
        "  return {",
    ]
    lines += [f"    {lower_camel(one.name)}: {read_value(one, at)[1]}," for one, at in fields]
    return [*lines, "  };", "}", ""]


def given_type(one: Field) -> tuple[str, str]:
    """The type of a field that callers give, and what checkKeys() requires of it."""
    name = one.type.name
    if name == "ks_bool":
        return "boolean", '"boolean"'
    if name == "ks_axes":
        return "{ x?: boolean; y?: boolean; z?: boolean }", "true"
    if one.name == "dimensions":
        return "2 | 3", '"number"'
    others = {
        "ks_vec3": "Vec3",
        "ks_filter": "Filter",
        "ks_contacts": "ContactEvents",
        "ks_error_bound": "ErrorBound",
    }
    return (others[name], "true") if name in others else ("number", '"number"')


def written(one: Field, at: int, is_required: bool) -> str:
    """The statement that writes a field, or its default."""
    key, place = lower_camel(one.name), f"at + {at}"
    value, name, default = f"given.{key}", one.type.name, one.default
    said = f'"{key}", call'
    if name == "ks_bool":
        return f"numbers[{place}] = " + (
            f"{value} === false ? 0 : 1;" if default == "1" else f"{value} ? 1 : 0;"
        )
    if name == "ks_axes":
        return f"numbers.set([{value}?.x ? 1 : 0, {value}?.y ? 1 : 0, {value}?.z ? 1 : 0], {place});"
    if name == "ks_vec3":
        return f"numbers.set(vector({value}{'' if is_required else ' ?? [0, 0, 0]'}, {said}), {place});"
    if name == "ks_filter":
        return f"numbers.set(filterNumbers({value} ?? {{}}, call), {place});"
    if name == "ks_error_bound":
        return f"numbers.set(boundNumbers({value} ?? 0, {said}), {place});"
    if name == "ks_contacts":
        return f"numbers[{place}] = contactsNumber({value}, {default}, call);"
    number = default.replace("INFINITY", "Infinity")
    if one.name in whole_numbers:
        return f"numbers[{place}] = whole({value} ?? {number}, {whole_numbers[one.name]}, {said});"
    return f"numbers[{place}] = {value}{'' if is_required else f' ?? {number}'};"


def given_of(record: Record) -> list[str]:
    """An interface that callers give, its keys, and the function that writes it to numbers."""
    name, required = given[record.name]
    skipped = by_hand.get(record.name, ())
    fields = [(one, at) for one, at in fields_of(record) if one.name not in skipped]
    lines = documented(record.comment, "") or [f"/** {record.comment} */"]
    lines += [f"export interface {name} {{"]
    for one, _ in fields:
        mark = "" if one.name in required else "?"
        lines += documented(one.comment, "  ", one.type.name) + [
            f"  {lower_camel(one.name)}{mark}: {given_type(one)[0]};"
        ]
    keys = ", ".join(f"{lower_camel(one.name)}: {given_type(one)[1]}" for one, _ in fields)
    lines += ["}", "/** @internal */"]
    lines += wrapped(f"export const {stem(record)}FieldKeys: Keys<{name}> = {{ {keys} }};", 118, "", "  ")
    lines += ["/** @internal Writes the table that the module reads; what is not given has its default. */"]
    statements = [written(one, at, one.name in required) for one, at in fields]
    call = "call" if any("call" in one for one in statements) else "_call"
    lines += [
        f"export function put{name}(numbers: Float64Array, at: number, given: {name}, {call}: string): void {{"
    ]
    lines += [*("  " + one for one in statements), "}", ""]
    return lines


def read_back(record: Record) -> list[str]:
    """The function that reads a definition which the module tells."""
    name = given[record.name][0]
    lines = [
        "/** @internal */",
        f"export function {stem(record)}FieldsOf(numbers: Float64Array): Required<{name}> {{",
        "  return {",
    ]
    lines += [f"    {lower_camel(one.name)}: {read_value(one, at)[1]}," for one, at in fields_of(record)]
    return [*lines, "  };", "}", ""]


def records(interface: Interface, banner: str) -> str:
    """The text of records.ts."""
    lines = [
        f"// {banner}",
        "// Enumerations and records of the library, and their tables of numbers for the module.",
        'import { boundNumbers, type ErrorBound } from "./error_bound.js";',
        'import { type Filter, filterNumbers } from "./filter.js";',
        'import { type Keys, shown, whole } from "./options.js";',
        'import { type BodyId, type State, type Vec3, vector } from "./state.js";',
        "",
        "/** Identifies a track: a whole number from 0 to 2^53 - 1 of the caller's, such as a transponder address or an MMSI. */",
        "export type TrackId = number;",
        "",
    ]
    for name in enumerations:
        lines += enumeration_of(interface.enumerations[name])
    lines += [*error_codes(interface.enumerations["ks_status"]), *flags(interface)]
    for name in got:
        record = interface.records[name]
        lines += (
            layout(record)
            if name in classes
            else [f"/** @internal */ export const {stem(record)}Size = {size_of(record)};"]
        )
        lines += class_of(interface, record) if name in classes else interface_of(record)
    lines += [
        "function contactsNumber(contacts: ContactEvents | undefined, usual: number, call: string): number {",
        "  if (contacts === undefined) return usual;",
        "  const number = contactEvents.indexOf(contacts) + 1;",
        "  if (number < 1)",
        '    throw new TypeError(`${call}: contacts must be "all", "begin_and_end" or "impacts", but is ${shown(contacts)}`);',
        "  return number;",
        "}",
        "",
    ]
    for name in given:
        record = interface.records[name]
        lines += [*layout(record), *given_of(record)]
        if name in ("ks_world_definition", "ks_monitor_definition"):
            lines += read_back(record)
    return "\n".join(lines).replace("\u00a0", " ")
