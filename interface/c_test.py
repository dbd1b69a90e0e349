"""Writes tests of the C interface: of the sizes of records, and that defaults are those of the comments."""

from __future__ import annotations

from header import Field, Interface, Record, layout


def checks(interface: Interface, path: str, one: Field) -> list[str]:
    """Statements that fail unless a field has its default."""
    if "default:" in one.comment.lower() or one.name == "struct_size":
        return []
    value = f"{path}.{one.name}"
    if one.type.is_pointer:
        return [f"  CHECK({value} == NULL);"]
    if one.type.name in interface.callbacks:
        return [f"  CHECK({value} == 0);"]
    if one.type.name in interface.records:
        inner = interface.records[one.type.name]
        return [check for field in inner.fields for check in checks(interface, value, field)]
    if one.default == "NaN":
        return [f"  CHECK({value} != {value});"]
    return [f"  CHECK({value} == {one.default});"]


def function(interface: Interface, record: Record) -> list[str]:
    short = record.name.removeprefix("ks_")
    lines = [f"static void {short}(void) {{", f"  const {record.name} made = ks_default_{short}();"]
    lines += [check for one in record.fields for check in checks(interface, "made", one)]
    return [*lines, "}", ""]


def defaults(interface: Interface, banner: str) -> str:
    """The text of record_defaults.c."""
    made = [one for one in interface.records.values() if interface.initialiser(one)]
    lines = [f"// {banner}", "// Defaults are what the comments of the header say.", "// clang-format off"]
    lines += ["#include <kinesphere.h>", "#include <math.h>", "", '#include "check.h"', ""]
    for record in made:
        lines += function(interface, record)
    lines += ["int main(void) {"]
    lines += [f"  {one.name.removeprefix('ks_')}();" for one in made]
    return "\n".join([*lines, '  puts("all defaults are those of the header");', "  return 0;", "}", ""])


def sizes(interface: Interface, banner: str) -> str:
    """The text of record_sizes.c."""
    lines = [
        f"// {banner}",
        "// clang-format off",
        "// Sizes of the records, on machines with 64-bit pointers. A change of this file breaks programs that have been",
        "// compiled, so it needs another KS_ABI_VERSION; only records that begin with struct_size may grow, and the",
        "// library then takes both sizes.",
        "#include <kinesphere.h>",
        "",
        "#define HAS_SIZE(record, size) _Static_assert(sizeof(void*) != 8 || sizeof(record) == (size), #record)",
        "",
    ]
    lines += [f"HAS_SIZE({one.name}, {layout(interface, one)[1]});" for one in interface.records.values()]
    return "\n".join([*lines, ""])
