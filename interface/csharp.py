"""Writes csharp/src/Native.cs, the functions of C, and csharp/src/Records.cs, its records and enumerations."""

from __future__ import annotations

import meaning
from header import Enumeration, Field, Function, Interface, Record, Type, camel, lower_camel, wrapped

# Records that C# has under names and with constructors of its own; their layout is that of C.
own_records = {
    "ks_body_id": "BodyId",
    "ks_vec3": "Vector",
    "ks_state": "State",
    "ks_quaternion": "Quaternion",
    "ks_rotation": "Rotation",
    "ks_rigid_part": "RigidPart",
}
# Records that callers see in another form.
hidden = {
    "ks_box": "Box",
    "ks_rigid_hull": "Hull",
    "ks_run_definition": "RunDefinition",
    "ks_game_definition": "GameDefinition",
    "ks_step_potential_definition": "StepPotentialDefinition",
    "ks_event_list": "EventList",
    "ks_body_list": "BodyList",
    "ks_motion_definition": "MotionDefinition",
    "ks_separation_rule": "SeparationRule",
    "ks_monitor_definition": "MonitorDefinition",
}
hidden_enumerations = {"ks_shape_kind", "ks_bound_kind", "ks_motion_kind"}
# Records whose fields callers reach by methods alone.
opaque = {"ks_shape", "ks_error_bound", "ks_event_hash", "ks_response"}
# Records that callers fill.
given = {
    "ks_world_definition",
    "ks_roughness",
    "ks_body_definition",
    "ks_static_definition",
    "ks_rigid_definition",
    "ks_track_report",
}
zeros = {"ks_senses": "Neither"}
numbers = {
    "double": "double",
    "int32_t": "int",
    "uint32_t": "uint",
    "int64_t": "long",
    "uint64_t": "ulong",
    "uint8_t": "byte",
    "size_t": "UIntPtr",
    "ks_bool": "int",
    "ks_status": "int",
    "void": "byte",
}


def type_name(interface: Interface, name: str, is_inside: bool) -> str:
    """`is_inside`: in the class Native."""
    if name in numbers or name in own_records:
        return numbers.get(name) or own_records[name]
    if name in interface.records and interface.records[name].is_handle:
        return "ulong"
    plain = hidden.get(name) or camel(name.removeprefix("ks_"))
    is_native = name in hidden or name in hidden_enumerations or name in interface.callbacks
    return plain if is_inside or not is_native else f"Native.{plain}"


def parameter(interface: Interface, function: Function, index: int, takes_pointers: bool) -> str:
    one = function.parameters[index]
    name = "@event" if one.name == "event" else lower_camel(one.name)
    if one.name == "user":
        return f"IntPtr {name}"
    type = type_name(interface, one.type.name, True)
    if not one.type.is_pointer:
        return f"{type} {name}"
    if takes_pointers:
        return f"{type}* {name}"
    if function.is_array(index):
        return f"{'' if one.type.is_const else '[Out] '}{type}[] {name}"
    record = interface.records.get(one.type.name)
    is_kept = record is not None and record.is_sized and not function.name.endswith("_init")
    changes = one.type.is_const or is_kept or one.type.name == "ks_event_hash"
    return f"{'ref' if changes else 'out'} {type} {name}"


def parameters(interface: Interface, function: Function, takes_pointers: bool) -> str:
    return ", ".join(
        parameter(interface, function, k, takes_pointers) for k in range(len(function.parameters))
    )


def is_callback(interface: Interface, function: Function) -> bool:
    """It can be given as a callback."""
    types = [one.type for one in function.parameters]
    return any(
        types == [one.type for one in callback.parameters] for callback in interface.callbacks.values()
    )


def documented(text: str, indent: str, type: str = "") -> list[str]:
    plain = meaning.respelled(meaning.plain(text, type), camel)
    if not plain:
        return []
    plain = plain.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return wrapped(f"<summary>{plain}</summary>", 124, indent + "/// ")


def initial_property(interface: Interface, record: Record, type: str, indent: str) -> list[str]:
    """How callers begin, or the library: with the defaults, or with a size."""
    init = interface.initialiser(record)
    if not record.is_sized or record.name == "ks_response":
        return []
    size = f"Native.SizeOf<{type}>()"
    if not init:
        return [
            f"{indent}internal static {type} New {{ get {{ return new {type} {{ structSize = {size} }}; }} }}"
        ]
    lines = [f"{indent}public static {type} Default", indent + "{", indent + "    get", indent + "    {"]
    lines += [
        f"{indent}        {type} made;",
        f"{indent}        Native.Check(Native.{init.name}(out made, {size}));",
    ]
    lines += [indent + "        return made;", indent + "    }", indent + "}"]
    if record.name in given:
        lines.append(
            f'{indent}internal void Require(string name) {{ Native.RequireDefault(structSize, "{type}", name); }}'
        )
    return lines


def is_private(interface: Interface, record: Record, one: Field) -> bool:
    is_choice = one.type.name in interface.enumerations and one.type.name not in hidden_enumerations
    return (
        (record.name in opaque and not is_choice)
        or not meaning.is_told(record, one)
        or one.type.name in ("ks_bool", "ks_box")
        or one.type.is_pointer
        or one.type.count > 1
        or meaning.guard_of(record, one.name) is not None
        or meaning.group_of(record, one) is not None
    )


def public_record(interface: Interface, record: Record) -> list[str]:
    type = type_name(interface, record.name, False)
    needs_pointers = any(one.type.is_pointer for one in record.fields)
    lines = documented(record.comment, "    ") or [f"    /// <summary>As in C++.</summary>"]
    lines += ["    [StructLayout(LayoutKind.Sequential)]"]
    lines += [f"    public {'unsafe ' if needs_pointers else ''}partial struct {type}", "    {"]
    for one in record.fields:
        kind = type_name(interface, one.type.name, False) + ("*" if one.type.is_pointer else "")
        if is_private(interface, record, one):
            names = [lower_camel(one.name)]
            if one.type.count > 1:
                names = [f"{lower_camel(one.name)}{k}" for k in range(one.type.count)]
            lines.append(f"        {kind} {', '.join(names)};")
        else:
            lines += [
                *documented(one.comment, "        ", one.type.name),
                f"        public {kind} {camel(one.name)};",
            ]
    for one in record.fields:
        if one.type.name != "ks_bool" or one.name.startswith("has_") or record.name in opaque:
            continue
        name = lower_camel(one.name)
        accessors = f"get {{ return {name} != 0; }}" + (
            f" set {{ {name} = value ? 1 : 0; }}" if record.name in given else ""
        )
        lines += documented(one.comment, "        ", one.type.name)
        lines.append(f"        public bool {camel(one.name)} {{ {accessors} }}")
    lines += initial_property(interface, record, type, "        ")
    return [*lines, "    }", ""]


def monitor_definition(interface: Interface) -> list[str]:
    """The fields of the class with lists, which C has as pointers."""
    record = interface.records["ks_monitor_definition"]
    fields = [one for one in record.fields if meaning.is_told(record, one) and not one.type.is_pointer]
    lines = ["    public sealed unsafe partial class MonitorDefinition", "    {"]
    for one in fields:
        optional = "?" if meaning.guard_of(record, one.name) else ""
        lines += documented(one.comment, "        ", one.type.name)
        lines.append(
            f"        public {type_name(interface, one.type.name, False)}{optional} {camel(one.name)};"
        )
    lines += [
        "        public MonitorDefinition()",
        "        {",
        "            var made = Native.MonitorDefinition.Default;",
    ]
    plain = [one for one in fields if not meaning.guard_of(record, one.name)]
    lines += [f"            {camel(one.name)} = made.{camel(one.name)};" for one in plain] + ["        }"]
    lines += [
        "        /// <summary>The record of C, without its lists.</summary>",
        "        Native.MonitorDefinition Raw()",
        "        {",
    ]
    lines += ["            var made = Native.MonitorDefinition.Default;"]
    lines += [f"            made.{camel(one.name)} = {camel(one.name)};" for one in plain]
    for one in fields:
        guard = meaning.guard_of(record, one.name)
        if guard:
            lines.append(f"            made.{camel(guard)} = {camel(one.name)}.HasValue ? 1 : 0;")
            lines.append(f"            made.{camel(one.name)} = {camel(one.name)}.GetValueOrDefault();")
    return [*lines, "            return made;", "        }", "    }", ""]


def enumeration_of(enumeration: Enumeration, indent: str) -> list[str]:
    name = camel(enumeration.name.removeprefix("ks_"))
    lines = documented(enumeration.comment, indent)
    if enumeration.is_flags:
        lines += [f"{indent}[Flags]", f"{indent}public enum {name} : uint", indent + "{"]
        lines.append(f"{indent}    {zeros.get(enumeration.name, 'None')} = 0,")
    else:
        lines += [f"{indent}public enum {name}", indent + "{"]
    for one in enumeration.enumerators:
        lines += documented(one.comment, indent + "    ")
        lines.append(f"{indent}    {camel(enumeration.short(one))} = {one.value},")
    return [*lines, indent + "}", ""]


preamble = ["using System;", "using System.Runtime.InteropServices;", "", "// Some fields are for C alone."]
preamble += ["#pragma warning disable 169, 414, 649", "", "namespace Kinesphere", "{"]


def records(interface: Interface, banner: str) -> str:
    """The text of Records.cs."""
    lines = [f"// {banner}", *preamble]
    for enumeration in interface.enumerations.values():
        if enumeration.name != "ks_status" and enumeration.name not in hidden_enumerations:
            lines += enumeration_of(enumeration, "    ")
    for record in interface.records.values():
        if not record.is_handle and record.name not in own_records and record.name not in hidden:
            lines += public_record(interface, record)
    lines += monitor_definition(interface)
    return "\n".join([*lines[:-1], "}", ""])


def native_record(interface: Interface, record: Record) -> list[str]:
    lines = [
        "        [StructLayout(LayoutKind.Sequential)]",
        f"        public struct {hidden[record.name]}",
        "        {",
    ]
    for one in record.fields:
        kind = type_name(interface, one.type.name, True) + ("*" if one.type.is_pointer else "")
        kind = "IntPtr" if one.type.name == "void" or one.type.name in interface.callbacks else kind
        name = "structSize" if one.name == "struct_size" else camel(one.name)
        lines.append(f"            public {kind} {name};")
    return [
        *lines,
        *initial_property(interface, record, hidden[record.name], "            "),
        "        }",
        "",
    ]


def native(interface: Interface, banner: str) -> str:
    """The text of Native.cs."""
    lines = [
        f"// {banner}",
        "// The functions of kinesphere.h, which explains them, and its records with pointers.",
        *preamble,
    ]
    lines += ["    unsafe static partial class Native", "    {"]
    for name in sorted(hidden_enumerations):
        lines += enumeration_of(interface.enumerations[name], "        ")
    for one in interface.callbacks.values():
        lines.append("        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]")
        lines.append(
            f"        public delegate int {camel(one.name.removeprefix('ks_'))}({parameters(interface, one, True)});"
        )
    lines.append("")
    for name in hidden:
        lines += native_record(interface, interface.records[name])
    for one in interface.functions.values():
        result = "IntPtr" if one.result.is_pointer else type_name(interface, one.result.name, True)
        takes = parameters(interface, one, is_callback(interface, one))
        lines += [
            "        [DllImport(library)]",
            f"        public static extern {result} {one.name}({takes});",
        ]
    return "\n".join([*lines, "    }", "}", ""])
