"""Writes browser/package/src/records.ts: enumerations, records, and where their fields lie in the module's memory."""

from __future__ import annotations

import json

import meaning
from cplusplus import walked_fields
from header import Enumeration, Field, Interface, Record, layout, lower_camel, wrapped

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
# Records that the library gives, with the names of their classes or interfaces.
got = {
    "ks_event": "EventFields",
    "ks_monitor_event": "MonitorEventFields",
    "ks_pair_answer": "PairAnswer",
    "ks_open_pair": "OpenPair",
    "ks_predicted_pair": "PredictedPair",
    "ks_report_request": "ReportRequest",
    "ks_timings": "Timings",
    "ks_busy_body": "BusyFields",
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
renamed = {"near_others": "near"}
whole_numbers = {"sensor_class": "255", "user_data": "2 ** 53", "track_class": "2 ** 32 - 1"}
# Records that are written and read by hand.
placed = [
    "ks_shape", "ks_static_definition", "ks_body_view", "ks_rigid_definition", "ks_rigid_hull", "ks_sensor_overlap",
    "ks_prediction", "ks_hit", "ks_sphere", "ks_ray", "ks_response", "ks_roughness",
    "ks_step_potential_definition", "ks_run_definition", "ks_game_definition", "ks_event_list", "ks_body_list",
    "ks_track_class", "ks_separation", "ks_separation_rule",
]  # fmt: skip
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


def offsets_of(interface: Interface, record: Record) -> dict[str, int]:
    """Where the fields are in WebAssembly, in bytes."""
    return layout(interface, record, pointer=4)[0]


def fields_of(interface: Interface, record: Record) -> list[tuple[Field, int]]:
    """The fields that JavaScript has under the same names, each with its offset."""
    offsets = offsets_of(interface, record)
    return [(record[name], offsets[name]) for name in walked_fields(record)]


def places(interface: Interface, record: Record) -> list[str]:
    name, offsets = stem(record), offsets_of(interface, record)
    fields = ", ".join(
        f"{lower_camel(one)}: {at}" for one, at in offsets.items() if one not in ("struct_size", "reserved")
    )
    size = layout(interface, record, pointer=4)[1]
    lines = wrapped(
        f"export const {name}At = {{ size: {size}, {fields} }}\u00a0as\u00a0const;", 118, "", "  "
    )
    return [f"/** @internal Size of a {record.name}, and offsets of its fields, in bytes. */", *lines, ""]


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


def named(interface: Interface, type: str, number: str) -> str:
    """The name of an enumerator by its number."""
    chosen = meaning.choices(interface.enumerations[type])
    first = interface.enumerations[type].enumerators[1].value if type in meaning.complete else chosen[0].value
    return f"{enumerations[type][1]}[{number}{f' - {first}' if first else ''}]!"


def read_value(interface: Interface, record: Record, one: Field, at: int, source: str) -> tuple[str, str]:
    """The type of a field that the library gives, and how a Place reads it."""
    name = one.type.name
    call = lambda kind: f"{source}.{kind}({at})"
    simple = {
        "ks_vec3": ("Float64Array", call("vector")),
        "ks_state": ("State", call("state")),
        "ks_traits": ("BodyTraits", f"traitsOf({call('word')})"),
        "ks_senses": ("(typeof senses)[number]", f"senses[{call('word')}]!"),
        "ks_wall": ("Wall | null", f"wallOf({call('word')})"),
        "ks_bool": ("boolean", f"{call('word')} !== 0"),
        "ks_axes": ("", f"axesOf({call('word')})"),
    }
    if name in simple:
        return simple[name]
    if name == "ks_body_id":
        return (
            ("BodyId | null", f"idOrNull({call('id')})")
            if meaning.may_be_nobody(one)
            else ("BodyId", call("id"))
        )
    if name in enumerations:
        return enumerations[name][0], named(interface, name, call("word"))
    if one.name == "dimensions":
        return "2 | 3", f"{call('word')} as 2 | 3"
    kind = {"double": "number", "uint64_t": "whole", "int32_t": "word", "uint32_t": "word"}[name]
    is_track = record.name in tracks and name == "uint64_t"
    return ("TrackId" if is_track else "number"), call(kind)


def class_of(interface: Interface, record: Record) -> list[str]:
    lines = [
        "/** The fields of an event, read from memory that never changes. */",
        f"export class {got[record.name]} extends Place {{",
    ]
    for one, at in fields_of(interface, record):
        if one.name not in by_hand.get(record.name, ()):
            type, value = read_value(interface, record, one, at, "this")
            lines += documented(one.comment, "  ", one.type.name)
            lines += [f"  get {lower_camel(one.name)}(): {type} {{ return {value}; }}"]
    return [*lines, "}", ""]


def interface_of(interface: Interface, record: Record) -> list[str]:
    """An interface that the library gives, and the function that reads it."""
    name, fields = got[record.name], fields_of(interface, record)
    values = [(one, *read_value(interface, record, one, at, "from")) for one, at in fields]
    spelled = {one.name: renamed.get(one.name, lower_camel(one.name)) for one, _ in fields}
    lines = documented(record.comment, "") + [f"export interface {name} {{"]
    for one, type, _ in values:
        lines += documented(one.comment, "  ", one.type.name) + [f"  {spelled[one.name]}: {type};"]
    lines += [
        "}",
        "/** @internal */",
        f"export function {stem(record)}Of(from: Place): {name} {{",
        "  return {",
    ]
    lines += [f"    {spelled[one.name]}: {value}," for one, _, value in values]
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
    number = default.replace("INFINITY", "Infinity")
    or_default = value if is_required else f"{value} ?? {number}"
    if name == "ks_bool":
        flag = f"{value} === false ? 0 : 1" if default == "1" else f"{value} ? 1 : 0"
        return f"to.putWord({place}, {flag});"
    if name == "ks_axes":
        return f"to.putWord({place}, axesBits({value}));"
    if name == "ks_vec3":
        return f"to.putVector({place}, vector({value}{'' if is_required else ' ?? [0, 0, 0]'}, {said}));"
    if name == "ks_filter":
        return f"putFilter(to, {place}, {value} ?? {{}}, call);"
    if name == "ks_error_bound":
        return f"putBound(to, {place}, {value} ?? 0, {said});"
    if name == "ks_contacts":
        return f"to.putWord({place}, contactsNumber({value}, {default}, call));"
    if one.name in whole_numbers:
        or_default = f"whole({or_default}, {whole_numbers[one.name]}, {said})"
    put = {"double": "putNumber", "uint64_t": "putWhole", "int32_t": "putWord", "uint32_t": "putWord"}[name]
    return f"to.{put}({place}, {or_default});"


def given_of(interface: Interface, record: Record) -> list[str]:
    """An interface that callers give, its keys, and the function that writes it."""
    name, required = given[record.name]
    skipped = by_hand.get(record.name, ())
    fields = [(one, at) for one, at in fields_of(interface, record) if one.name not in skipped]
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
    lines += ["/** @internal Writes a record of zeros; what is not given has its default. */"]
    statements = [written(one, at, one.name in required) for one, at in fields]
    call = "call" if any("call" in one for one in statements) else "_call"
    lines += [f"export function put{name}(to: Memory, at: number, given: {name}, {call}: string): void {{"]
    lines += [*("  " + one for one in statements), "}", ""]
    return lines


def read_back(interface: Interface, record: Record) -> list[str]:
    """The function that reads a definition which the module tells."""
    name = given[record.name][0]
    lines = [
        "/** @internal */",
        f"export function {stem(record)}FieldsOf(from: Place): Required<{name}> {{",
        "  return {",
    ]
    for one, at in fields_of(interface, record):
        lines += [f"    {lower_camel(one.name)}: {read_value(interface, record, one, at, 'from')[1]},"]
    return [*lines, "  };", "}", ""]


by_name = """\
function contactsNumber(contacts: ContactEvents | undefined, usual: number, call: string): number {
  if (contacts === undefined) return usual;
  const number = contactEvents.indexOf(contacts) + 1;
  if (number < 1)
    throw new TypeError(`${call}: contacts must be "all", "begin_and_end" or "impacts", but is ${shown(contacts)}`);
  return number;
}
function axesBits(axes: WorldFields["periodic"] = {}): number {
  return (axes.x ? 1 : 0) + (axes.y ? 2 : 0) + (axes.z ? 4 : 0);
}
function axesOf(bits: number): { x: boolean; y: boolean; z: boolean } {
  return { x: (bits & 1) !== 0, y: (bits & 2) !== 0, z: (bits & 4) !== 0 };
}
function idOrNull(id: number): BodyId | null {
  return id < 0 ? null : id;
}
"""


def records(interface: Interface, banner: str) -> str:
    """The text of records.ts."""
    lines = [
        f"// {banner}",
        "// Enumerations and records of the library, and where they lie in the memory of the module.",
        'import { type ErrorBound, putBound } from "./error_bound.js";',
        'import { type Filter, putFilter } from "./filter.js";',
        'import { type Memory, Place } from "./memory.js";',
        'import { type Keys, shown, whole } from "./options.js";',
        'import { type BodyId, type State, type Vec3, vector } from "./state.js";',
        "",
        "/** Identifies a track: a whole number from 0 to 2^53 - 1 of the caller's, such as a transponder address or an MMSI. */",
        "export type TrackId = number;",
        "",
    ]
    for name in enumerations:
        lines += enumeration_of(interface.enumerations[name])
    lines += [*error_codes(interface.enumerations["ks_status"]), *flags(interface), by_name]
    for name in got:
        record = interface.records[name]
        lines += places(interface, record)
        lines += class_of(interface, record) if name in classes else interface_of(interface, record)
    for name in given:
        record = interface.records[name]
        lines += [*places(interface, record), *given_of(interface, record)]
        if name in ("ks_world_definition", "ks_monitor_definition"):
            lines += read_back(interface, record)
    for name in placed:
        lines += places(interface, interface.records[name])
    return "\n".join(lines).replace("\u00a0", " ")
