"""Writes what Python repeats: rows of tables, properties of events and answers, arguments, kinds, and types.

`python/module/records.hpp` has rows and properties, `python/module/definitions.hpp` the arguments of World and
Monitor, `python/kinesphere/kinds.py` the enumerations, and parts of `python/kinesphere/_kinesphere.pyi` the types.
"""

from __future__ import annotations

from dataclasses import dataclass

import meaning
from cplusplus import walked_fields
from header import Enumeration, Field, Interface, Record, camel, wrapped

# Rows of tables: the columns that come first, in this order; the others follow in that of the header.
rows = {
    "ks_event": (),
    "ks_monitor_event": ("time", "first", "second", "kind", "verdict", "before", "level"),
    "ks_pair_answer": (),
    "ks_open_pair": (),
    "ks_predicted_pair": (),
    "ks_report_request": ("track", "by", "other"),
}
# Whose rows are read, too.
read_rows = {"ks_event", "ks_monitor_event"}
# Classes with a property for each field, and the fields that are properties of another form.
classes = {"ks_event": (), "ks_monitor_event": ("second", "verdict", "before"), "ks_pair_answer": ()}
definitions = {"ks_world_definition": "World", "ks_monitor_definition": "Monitor"}
members = {"ks_event_kind": "EventKind", "ks_wall": "Wall", "ks_senses": "Senses", "ks_verdict": "Verdict"}
members["ks_monitor_event_kind"] = "MonitorEventKind"


@dataclass(frozen=True)
class Column:
    """A column of a table: its member of the row in C++, its type for NumPy, and its size and alignment."""

    name: str
    member: str
    numpy: str
    cplusplus: str
    size: int
    alignment: int


plain_columns = {
    "double": ("f8", "double", 8),
    "uint64_t": ("u8", "std::uint64_t", 8),
    "uint32_t": ("u4", "std::uint32_t", 4),
    "int32_t": ("i4", "std::int32_t", 4),
    "ks_bool": ("?", "bool", 1),
    "ks_body_id": ("i8", "std::int64_t", 8),
}


def columns_of(interface: Interface, record: Record) -> list[Column]:
    """Whether a body is static and the like come last."""
    names = walked_fields(record)
    first = rows[record.name]
    found, last = [], []
    for name in [*first, *(one for one in names if one not in first)]:
        one = record[name]
        if one.type.name == "ks_vec3":
            found.append(Column(name, name, "3f8", "Vec3", 24, 8))
        elif one.type.name == "ks_state":
            for part in ("position", "velocity"):
                found.append(Column(name.replace("state", part), f"{name}.{part}", "3f8", "Vec3", 24, 8))
        elif one.type.name == "ks_traits":
            for flag, _ in meaning.flags_of(interface, one):
                last.append(
                    Column(
                        flag, f"{name}.{flag.removeprefix(name.removesuffix('traits'))}", "?", "bool", 1, 1
                    )
                )
        elif one.type.name in interface.enumerations:
            found.append(Column(name, name, "u1", "std::uint8_t", 1, 1))
        else:
            numpy, cplusplus, size = plain_columns[one.type.name]
            found.append(Column(name, name, numpy, cplusplus, size, size))
    return found + last


def class_name(record: Record) -> str:
    return camel(record.name.removeprefix("ks_"))


def read_member(interface: Interface, record: Record, column: Column) -> str:
    """The value of the library that goes into a column."""
    value = f"from.{column.member}"
    if column.cplusplus == "std::int64_t":
        return f"number_of({value})"
    return f"static_cast<std::uint8_t>({value})" if column.cplusplus == "std::uint8_t" else value


def written_member(record: Record, column: Column) -> str:
    """The statement that gives a value of the library what is in a column."""
    target, value = f"to.{column.member}", f"from.{column.name}"
    if column.cplusplus == "std::int64_t":
        value = f"BodyId::unpack(static_cast<std::uint64_t>({value}))"
    if column.cplusplus == "std::uint8_t":
        value = f"static_cast<decltype({target})>({value})"
    return f"  {target} = {value};"


def row_of(interface: Interface, record: Record) -> list[str]:
    name, columns = class_name(record), columns_of(interface, record)
    ids = [Column(one, one, "u8", "std::uint64_t", 8, 8) for one in ("first", "second")]
    # An answer does not say whom it is about.
    whole = ids + columns if record.name == "ks_pair_answer" else columns
    lines = [
        f"/// A row of a table; bytes that are not used are zero, as they go into files.",
        f"struct {name}Record {{",
    ]
    at, unused = 0, 0
    for one in whole:
        gap = -at % one.alignment
        if gap:
            unused += 1
            lines.append(f"  std::array<std::uint8_t, {gap}> unused_{unused};")
        at += gap + one.size
        lines.append(f"  {one.cplusplus} {one.name};")
    if at % 8:
        lines.append(f"  std::array<std::uint8_t, {-at % 8}> unused_at_end;")
    lines += ["};", f"static_assert(sizeof({name}Record) == {at + -at % 8});"]
    lines += [f"inline constexpr Field {name}_fields[] = {{".replace(name, record.name.removeprefix("ks_"))]
    lines += [
        f'    {{"{one.name}", "{one.numpy}", offsetof({name}Record, {one.name})}},' for one in whole
    ] + ["};"]
    lines += [f"inline {name}Record record_of(const {name}& from) {{", f"  {name}Record to{{}};"]
    lines += [f"  to.{one.name} = {read_member(interface, record, one)};" for one in columns] + [
        "  return to;",
        "}",
    ]
    if record.name in read_rows:
        short = record.name.removeprefix("ks_")
        lines += [f"inline {name} {short}_of(const {name}Record& from) {{", f"  {name} to;"]
        lines += [written_member(record, one) for one in columns] + ["  return to;", "}"]
    return [*lines, ""]


def documented(text: str, type: str = "") -> str:
    plain = meaning.plain(text, type).replace("infinity", "inf").replace("default true", "default True")
    return plain.replace("no body", "None").replace("If false", "If False").replace("\\", "")


def properties_of(interface: Interface, record: Record) -> list[str]:
    """Calls visit(name, getter, doc) for each property."""
    name = class_name(record)
    short = record.name.removeprefix("ks_")
    lines = [
        f'/// Calls visit("name", function of an object, "documentation") for each property.',
        "template <class Visit>",
    ]
    lines += [f"void each_{short}_property(const Visit& visit) {{"]
    for field in walked_fields(record):
        if field in classes[record.name]:
            continue
        one = record[field]
        parts = [(field, field, one.comment)]
        if one.type.name == "ks_state":
            parts = [
                (field.replace("state", part), f"{field}.{part}", one.comment)
                for part in ("position", "velocity")
            ]
        elif one.type.name == "ks_traits":
            flags = meaning.flags_of(interface, one)
            parts = [
                (flag, f"{field}.{flag.removeprefix(field.removesuffix('traits'))}", bit.comment)
                for flag, bit in flags
            ]
        # pybind11 makes numbers of them itself.
        is_number = one.type.name in ("double", "uint64_t", "uint32_t", "int32_t", "ks_bool", "ks_traits")
        for python, member, comment in parts:
            value = f"from.{member}" if is_number else f"object_of_field(from.{member})"
            lines += [f'  visit("{python}", [](const {name}& from) {{ return {value}; }},']
            lines += [f'        "{documented(comment, one.type.name)}");']
    return [*lines, "}", ""]


def records(interface: Interface, banner: str) -> str:
    """The text of records.hpp."""
    lines = [
        f"// {banner}",
        "// Rows of tables, and properties of objects.",
        "// clang-format off",
        "#pragma once",
        "",
        "#include <array>",
        "#include <cstddef>",
        "#include <cstdint>",
        "",
        '#include "exchange.hpp"',
        '#include "kinesphere/event.hpp"',
        '#include "kinesphere/monitor/monitor.hpp"',
        '#include "kinesphere/monitor/monitor_event.hpp"',
        "",
        "namespace kinesphere::python {",
        "",
    ]
    for name in rows:
        lines += row_of(interface, interface.records[name])
    for name in classes:
        lines += properties_of(interface, interface.records[name])
    return "\n".join([*lines, "}  // namespace kinesphere::python", ""])


# Arguments of definitions.


def arguments_of(record: Record) -> list[Field]:
    """The fields that callers give, those of another form than in C first, as they always were."""
    told = [
        one for one in record.fields if meaning.is_told(record, one) and not meaning.group_of(record, one)
    ]
    if record.name == "ks_monitor_definition":
        part = meaning.groups[record.name]
        lists = [one for one in told if one.type.is_pointer]
        return [*lists, *(one for one in told if one not in lists), Field(part, told[0].type)]
    first = [record[name] for name in ("box", "periodic", "wall_filter")]
    return [*first, *(one for one in told if one not in first)]


# Of C++: the type of an argument, and its default.
def argument(record: Record, one: Field) -> tuple[str, str]:
    if one.name == "shard":
        return "const Shard&", "Shard{}"
    if one.type.is_pointer:
        return "const py::object&", ""
    name, default = one.type.name, one.default
    if meaning.guard_of(record, one.name) and name == "double":
        return "std::optional<double>", "py::none()"
    if meaning.guard_of(record, one.name) or default == "NaN":
        return "const py::object&", "py::none()"
    if name == "ks_axes":
        return "const py::object&", "false"
    if name == "ks_bool":
        return "bool", "true" if default == "1" else "false"
    if name == "ks_contacts":
        return "const std::string&", '"all"'
    if name == "int32_t":
        return "int", default
    infinite = "std::numeric_limits<double>::infinity()"
    return "double", infinite if default == "INFINITY" else repr(meaning.number(default))


notes = {
    "box": "walls, a Box or a pair of corners; without one the world is unbounded.",
    "periodic": 'True, or axes such as "xy", on which the box repeats instead of having walls; in two dimensions '
    'True means "xy".',
    "wall_filter": "the filter of all walls, a dict with category, mask and group or some of these (set_filter()); "
    "they meet a body as another body with this filter would. Without one they meet every body.",
    "contacts": 'which contact events the world reports. "all": a begin and an end for each contact, and a begin for '
    'each further approach in between (event.already_touching). "impacts", for what only bounces: a begin for each '
    'approach, and no ends. "begin_and_end", for contacts that are watched: one begin and one end, and the first '
    "approach if the contact began without one or a response has parted the two.",
    "separation_distance": "(length, > contact_tolerance; default 4 of it): the gap at which a contact ends.",
    "classes": "a list of TrackClass; report(track_classes=...) has their numbers.",
    "separations": "a list of SeparationRule. Pairs of classes that none names are not watched.",
    "shard": "the pairs that this monitor watches.",
}


def documentation(record: Record) -> str:
    """What help() says of the arguments."""
    lines = []
    for one in arguments_of(record):
        text = notes.get(one.name) or documented(one.comment, one.type.name)
        lines += wrapped(f"{one.name}: {text}", 110, "", "")
    return "\n".join([*lines, "Raises ValueError (InvalidValue) that names the argument."])


def initialiser(record: Record) -> list[str]:
    """Binds the constructor: it reads each argument, and calls create()."""
    name, arguments = definitions[record.name], arguments_of(record)
    definition = class_name(record)
    taken = ", ".join(f"{argument(record, one)[0]} {one.name}" for one in arguments)
    lines = [
        "template <class Class, class Create>",
        f"void bind_{name.lower()}_arguments(Class& bound, const Create& create) {{",
    ]
    lines += ["  bound.def(", f"      py::init([create]({taken}) {{", f"        {definition} definition;"]
    # How many numbers a corner has depends on the dimensions.
    scalars = [
        one for one in arguments if not argument(record, one)[0].startswith("const ") or one.name == "shard"
    ]
    lines += [f"        definition.{one.name} = {one.name};" for one in scalars]
    for one in arguments:
        if one not in scalars:
            lines.append(
                f'        read_argument({one.name}, {{"{name}", "{one.name}"}}, definition, definition.{one.name});'
            )
    lines += ["        return create(definition);", "      }),", "      py::kw_only(),"]
    for one in arguments:
        default = argument(record, one)[1]
        lines.append(f"      py::arg(\"{one.name}\"){' = ' + default if default else ''},")
    lines += [f'      R"({documentation(record)})");', "}", ""]
    lines += [f"inline py::dict arguments_of(const {definition}& definition) {{", "  py::dict arguments;"]
    lines += [f'  arguments["{one.name}"] = argument_of(definition.{one.name});' for one in arguments]
    return [*lines, "  return arguments;", "}", ""]


def bound_definitions(interface: Interface, banner: str) -> str:
    """The text of definitions.hpp."""
    lines = [
        f"// {banner}",
        "// Constructors of worlds and monitors, and the arguments that they were made from.",
        "// clang-format off",
        "#pragma once",
        "",
        "#include <limits>",
        "#include <optional>",
        "#include <string>",
        "",
        "#include <pybind11/stl.h>",
        "",
        '#include "definition_arguments.hpp"',
        "",
        "namespace kinesphere::python {",
        "",
    ]
    for name in definitions:
        lines += initialiser(interface.records[name])
    return "\n".join([*lines, "}  // namespace kinesphere::python", ""])


# Python.


def kinds(interface: Interface, banner: str) -> str:
    """The text of kinds.py."""
    lines = [
        f"# {banner}",
        '"""What events are about. Members are whole numbers, as in tables of events; their texts are their names."""',
    ]
    lines += ["", "from .named import Named", ""]
    for name, python in members.items():
        lines += ["", *enumeration_of(interface.enumerations[name], python)]
    return "\n".join(lines)


def enumeration_of(enumeration: Enumeration, name: str) -> list[str]:
    lines = [f"class {name}(Named):", f'    """{documented(enumeration.comment)}"""', ""]
    if enumeration.name == "ks_senses":
        return [*lines, "    neither = 0", "    first = 1", "    second = 2", "    both = 3", ""]
    chosen = list(enumeration.enumerators)
    if enumeration.short(chosen[0]) == "none" and name != "Wall":
        chosen = chosen[1:]
    for number, one in enumerate(chosen):
        lines.append(f"    {enumeration.short(one)} = {number}")
        doc = documented(one.comment)
        if doc and len(doc) < 100:
            lines.append(f'    """{doc}"""')
        elif doc:
            lines += [*wrapped(doc, 110, '    """', "    "), '    """']
    return [*lines, ""]


stub_types = {
    "double": "float",
    "uint64_t": "int",
    "uint32_t": "int",
    "int32_t": "int",
    "ks_bool": "bool",
    "ks_vec3": "Doubles",
}


def stub_properties(interface: Interface, record: Record) -> str:
    lines = []
    for field in walked_fields(record):
        one = record[field]
        if field in classes[record.name]:
            continue
        names, type = [field], stub_types.get(one.type.name) or members.get(one.type.name, "")
        if one.type.name == "ks_state":
            names, type = [field.replace("state", part) for part in ("position", "velocity")], "Doubles"
        elif one.type.name == "ks_traits":
            names, type = [flag for flag, _ in meaning.flags_of(interface, one)], "bool"
        elif one.type.name == "ks_body_id":
            type = "Optional[BodyId]" if meaning.may_be_nobody(one) else "BodyId"
        elif one.type.name == "ks_wall":
            type = "Optional[Wall]"
        for name in names:
            lines += ["    @property", f"    def {name}(self) -> {type}: ..."]
    return "\n".join([*lines, ""])


def stub_argument(record: Record, one: Field) -> tuple[str, str]:
    """The type of an argument, and its default."""
    special = {
        "box": ("Optional[BoxLike]", "None"),
        "periodic": ("Union[bool, str]", "False"),
        "wall_filter": ("Optional[Filter]", "None"),
        "contacts": ("ContactEvents", '"all"'),
        "classes": ("Sequence[TrackClass]", ""),
        "separations": ("Sequence[SeparationRule]", ""),
        "shard": ("Shard", "..."),
    }
    if one.name in special:
        return special[one.name]
    if meaning.guard_of(record, one.name) or one.default == "NaN":
        return "Optional[float]", "None"
    kind = {"ks_bool": "bool", "int32_t": "int"}.get(one.type.name, "float")
    if kind == "bool":
        return kind, "True" if one.default == "1" else "False"
    if one.default == "INFINITY":
        return kind, "..."
    return kind, one.default if kind == "int" or "e" in one.default else repr(float(one.default))


def stub_initialiser(record: Record) -> str:
    lines = ["    def __init__(", "        self,", "        *,"]
    for one in arguments_of(record):
        type, default = stub_argument(record, one)
        lines.append(f"        {one.name}: {type}{' = ' + default if default else ''},")
    return "\n".join([*lines, "    ) -> None: ...", ""])


def stub_definition(record: Record) -> str:
    told = {
        "box": "Optional[Box]",
        "periodic": "str",
        "classes": "list[TrackClass]",
        "separations": "list[SeparationRule]",
    }
    lines = [
        f"    {one.name}: {told.get(one.name) or stub_argument(record, one)[0]}"
        for one in arguments_of(record)
    ]
    return "\n".join([*lines, ""])


def stub_parts(interface: Interface) -> dict[str, str]:
    """The parts of _kinesphere.pyi, each with its name."""
    parts = {}
    for name in classes:
        parts[class_name(interface.records[name])] = stub_properties(interface, interface.records[name])
    for name, python in definitions.items():
        parts[python] = stub_initialiser(interface.records[name])
        parts[class_name(interface.records[name])] = stub_definition(interface.records[name])
    return parts
