"""Writes interface/fields.hpp, by which C++ goes through the fields of a record, and c/kinesphere-c.map."""

from __future__ import annotations

import meaning
from header import Interface, Record

# Records whose fields have the same names in C++.
walked = [
    "body_definition",
    "motion_limits",
    "world_definition",
    "track_class",
    "separation",
    "monitor_definition",
    "track_report",
    "monitor_event",
    "pair_answer",
    "open_pair",
    "predicted_pair",
    "report_request",
    "track_place",
]


def walked_fields(record: Record) -> list[str]:
    """The fields that C++ has under the same names: no lists, parts, and fields that may be missing."""
    return [
        one.name
        for one in record.fields
        if meaning.is_told(record, one)
        and not one.type.is_pointer
        and not meaning.group_of(record, one)
        and not meaning.guard_of(record, one.name)
    ]


def walk(record: Record) -> list[str]:
    short = record.name.removeprefix("ks_")
    lines = [
        "template <class Visit, class... Records>",
        f"constexpr void each_{short}_field(Visit&& visit, Records&... records) {{",
    ]
    lines += [f'  visit("{name}", records.{name}...);' for name in walked_fields(record)]
    return [*lines, "}", ""]


def made(record: Record) -> list[str]:
    """A record of the same fields in one expression, which is faster than to fill one that has its defaults."""
    short = record.name.removeprefix("ks_")
    lines = [
        "/// Returns a record whose fields are convert(field of `from`), and the others those of an empty one."
    ]
    lines += ["template <class To, class From, class Convert>"]
    lines += [f"constexpr To make_{short}(const From& from, const Convert& convert) {{", "  return {"]
    lines += [f"      .{name} = convert(from.{name})," for name in walked_fields(record)]
    return [*lines, "  };", "}", ""]


def fields(interface: Interface, banner: str) -> str:
    """The text of fields.hpp."""
    lines = [
        f"// {banner}",
        '// Each function calls visit("name", records.name...) for the fields that kinesphere.h and the library have in',
        "// common. Lists, fields that may be missing, and parts of a record are left to the caller.",
        "// clang-format off",
        "#pragma once",
        "",
        "namespace kinesphere::fields {",
        "",
    ]
    for name in walked:
        lines += walk(interface.records["ks_" + name])
    lines += made(interface.records["ks_event"])
    return "\n".join([*lines, "}  // namespace kinesphere::fields", ""])


def symbols(interface: Interface, banner: str) -> str:
    """The text of kinesphere-c.map."""
    names = sorted(interface.functions)
    lines = [
        f"/* {banner} */",
        "/* The symbols of the shared library, and nothing else. */",
        "KINESPHERE_C_0 {",
        "  global:",
    ]
    lines += [f"    {name};" for name in names]
    return "\n".join([*lines, "  local:", "    *;", "};", ""])
