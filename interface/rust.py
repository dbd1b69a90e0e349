"""Writes rust/src/sys.rs, the declarations of C, and rust/src/records.rs, the records of safe Rust."""

from __future__ import annotations

import meaning
from header import Enumeration, Field, Function, Interface, Record, Type, camel, layout, wrapped

# Records that Rust has under names and with methods of its own; their layout is that of C.
own_records = {
    "ks_vec3": "Vec3",
    "ks_state": "State",
    "ks_box": "Box3",
    "ks_sphere": "Sphere",
    "ks_ray": "Ray",
    "ks_body_id": "BodyId",
    "ks_quaternion": "Quaternion",
    "ks_rotation": "Rotation",
    "ks_rigid_part": "RigidPart",
}
numbers = {
    "double": "f64",
    "int32_t": "i32",
    "uint32_t": "u32",
    "int64_t": "i64",
    "uint64_t": "u64",
    "uint8_t": "u8",
    "size_t": "usize",
    "ks_bool": "i32",
    "char": "c_char",
    "void": "c_void",
}
# Made by hand: their forms in Rust are not those of C.
by_hand = {
    "ks_shape",
    "ks_error_bound",
    "ks_separation",
    "ks_separation_rule",
    "ks_static_definition",
    "ks_rigid_hull",
    "ks_rigid_definition",
    "ks_run_definition",
    "ks_game_definition",
    "ks_step_potential_definition",
    "ks_event_list",
    "ks_body_list",
    "ks_motion_definition",
    "ks_response",
    "ks_event_hash",
    "ks_sensor_overlap",
}
# What callers give; the library gives all other records.
given = {
    "ks_filter",
    "ks_roughness",
    "ks_world_definition",
    "ks_body_definition",
    "ks_motion_limits",
    "ks_track_class",
    "ks_monitor_definition",
    "ks_track_report",
}
# Narrower types of fields, by which wrong numbers do not compile.
narrow = {"sensor_class": "u8", "track_class": "usize"}
# Names of fields that are others in Rust: `box` is a word of the language.
renamed = {"box": "bounds", "box_end": "bounds_end", "near_others": "near"}


def raw_name(name: str) -> str:
    return "box_" if name == "box" else name


def raw_type(interface: Interface, type: Type) -> str:
    name = interface.aliases.get(type.name, type.name) if type.name not in ("ks_status",) else type.name
    name = numbers.get(type.name) or own_records.get(type.name) or numbers.get(name, name)
    if type.name in interface.callbacks:
        name = f"Option<{type.name}>"
    if type.is_pointer:
        if name == "c_void":
            return "*const u8" if type.is_const else "*mut c_void"
        return f"*{'const' if type.is_const else 'mut'} {name}"
    return f"[{name}; {type.count}]" if type.count > 1 else name


def raw_parameters(interface: Interface, function: Function, is_named: bool) -> str:
    parts = []
    for one in function.parameters:
        type = raw_type(interface, one.type)
        # Memory of bytes; a callback's own pointer is `user`.
        if one.type.name == "void" and one.name != "user":
            type = "*const u8" if one.type.is_const else "*mut u8"
        parts.append(f"{raw_name(one.name)}: {type}" if is_named else type)
    return ", ".join(parts)


def has_pointer(interface: Interface, record: Record) -> bool:
    return any(one.type.is_pointer or one.type.name in interface.callbacks for one in record.fields)


def raw_record(interface: Interface, record: Record) -> list[str]:
    derived = "Clone, Copy, Debug, PartialEq, Eq" if record.is_handle else "Clone, Copy, Debug"
    if not has_pointer(interface, record) and not record.is_handle:
        derived += ", Default"
    lines = ["#[repr(C)]", f"#[derive({derived})]", f"pub struct {record.name} {{"]
    lines += [f"    pub {raw_name(one.name)}: {raw_type(interface, one.type)}," for one in record.fields]
    lines += ["}", ""]
    if not record.is_sized:
        return lines
    lines += [f"impl {record.name} {{"]
    if interface.initialiser(record):
        lines += [
            "    /// The defaults of the library.",
            "    pub fn new() -> Self {",
            "        let mut made = std::mem::MaybeUninit::<Self>::zeroed();",
            "        // It fails for a library with another layout only, and then leaves the size 0, which is refused.",
            "        unsafe {",
            f"            {record.name}_init(made.as_mut_ptr(), std::mem::size_of::<Self>() as u32);",
            "            made.assume_init()",
            "        }",
            "    }",
        ]
    else:
        lines += [
            "    /// All zeros, with its size: to be filled.",
            "    pub fn new() -> Self {",
            "        Self { struct_size: std::mem::size_of::<Self>() as u32, ..Default::default() }",
            "    }",
        ]
    return [*lines, "}", ""]


def sizes(interface: Interface) -> list[str]:
    """Programs do not compile with layouts other than those of C."""
    lines = ['#[cfg(target_pointer_width = "64")]', "const _: () = {"]
    for record in interface.records.values():
        size = layout(interface, record)[1]
        name = own_records.get(record.name, record.name)
        lines.append(f"    assert!(std::mem::size_of::<{name}>() == {size});")
    return [*lines, "};", ""]


def sys(interface: Interface, banner: str) -> str:
    """The text of sys.rs."""
    used = ", ".join(sorted(set(own_records.values())))
    lines = [
        f"// {banner}",
        "//! The declarations of `kinesphere.h`, which explains them. Nothing here is safe by itself; a record whose layout",
        "//! differed from that of C would be refused by its size.",
        "#![allow(non_camel_case_types)]",
        "#![allow(clippy::new_without_default)]",
        "",
        f"use crate::geometry::{{{used}}};",
        "use std::os::raw::{c_char, c_void};",
        "",
        "pub type ks_status = i32;",
    ]
    for enumeration in interface.enumerations.values():
        type = "ks_status" if enumeration.name == "ks_status" else numbers[enumeration.type]
        lines += [f"pub const {one.name}: {type} = {one.value};" for one in enumeration.enumerators]
    lines.append("")
    for callback in interface.callbacks.values():
        lines.append(
            f'pub type {callback.name} = unsafe extern "C" fn({raw_parameters(interface, callback, False)}) -> i32;'
        )
    lines.append("")
    for record in interface.records.values():
        if record.name not in own_records:
            lines += raw_record(interface, record)
    lines += sizes(interface)
    lines += ['extern "C" {']
    for one in interface.functions.values():
        result = raw_type(interface, one.result)
        lines.append(f"    pub fn {one.name}({raw_parameters(interface, one, True)}) -> {result};")
    return "\n".join([*lines, "}", ""])


def documented(text: str, indent: str, type: str = "") -> list[str]:
    plain = meaning.plain(text, type)
    return wrapped(plain, 118, indent + "/// ") if plain else []


def safe_name(name: str) -> str:
    return own_records.get(name) or camel(name.removeprefix("ks_"))


def enumeration_of(interface: Interface, enumeration: Enumeration) -> list[str]:
    name = safe_name(enumeration.name)
    is_complete = enumeration.name in meaning.complete
    lines = documented(enumeration.comment, "")
    lines += [f"#[derive(Clone, Copy, Debug, {'Default, ' if is_complete else ''}PartialEq, Eq, Hash)]"]
    lines += [f"pub enum {name} {{"]
    chosen = meaning.choices(enumeration)
    for one in chosen:
        lines += documented(one.comment, "    ")
        if is_complete and one.value == 0:
            lines.append("    #[default]")
        lines.append(f"    {camel(enumeration.short(one))} = {one.value},")
    lines += ["}", "", f"impl {name} {{"]
    arms = [f"{one.value} => {name}::{camel(enumeration.short(one))}," for one in chosen]
    if meaning.may_lack(enumeration):
        lacking = enumeration.enumerators[0].name
        lines += [
            f"    /// Returns nothing for `{lacking}`.",
            f"    pub(crate) fn of(number: i32) -> Option<{name}> {{",
        ]
        lines += ["        Some(match number {", *("            " + one for one in arms)]
        lines += ["            _ => return None,", "        })", "    }"]
    elif not is_complete:
        lines += [f"    pub(crate) fn of(number: i32) -> {name} {{", "        match number {"]
        lines += ["            " + one for one in arms]
        lines += ['            _ => unreachable!("a number that the library gave"),', "        }", "    }"]
    texts = [
        one
        for one in interface.functions.values()
        if [p.type.name for p in one.parameters] == [enumeration.name]
    ]
    for one in texts:
        word = one.name.removeprefix(enumeration.name + "_")
        example = enumeration.short(chosen[1])
        doc = (
            f'Returns a name such as "{example}".'
            if word == "name"
            else ("Returns two sentences: what it means, and what makes such a body cheaper.")
        )
        lines += [f"    /// {doc}", f"    pub fn {word}(self) -> &'static str {{"]
        lines += [f"        literal(unsafe {{ sys::{one.name}(self as i32) }})", "    }"]
    lines += ["}", ""]
    if any(one.name.endswith("_name") for one in texts):
        lines += [f"impl fmt::Display for {name} {{"]
        lines += [
            "    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {",
            "        f.write_str(self.name())",
        ]
        lines += ["    }", "}", ""]
    return lines


class SafeField:
    """A field of a safe record: its type, and how it is made of the record of C, and that of it."""

    def __init__(self, interface: Interface, record: Record, one: Field):
        self.name = renamed.get(one.name, one.name)
        self.comment, self.c_type = one.comment, one.type.name
        source, value = f"raw.{raw_name(one.name)}", f"self.{self.name}"
        guard = meaning.guard_of(record, one.name)
        self.type, of, self.raw = self.converted(interface, one, source, "one" if guard else value)
        self.of = of
        if guard:
            self.type = f"Option<{self.type}>"
            self.of = f"(raw.{guard} != 0).then(|| {of})"
            is_number = one.type.name in numbers
            some = f"self.{self.name}" if self.raw == "one" else f"self.{self.name}.map(|one| {self.raw})"
            self.raw = some + (".unwrap_or(0.0)" if is_number else ".unwrap_or_default()")

    def converted(self, interface: Interface, one: Field, source: str, value: str) -> tuple[str, str, str]:
        name = one.type.name
        if one.name in narrow:
            return (
                narrow[one.name],
                f"{source} as {narrow[one.name]}",
                f"{value} as {raw_type(interface, one.type)}",
            )
        if name == "ks_bool":
            return "bool", f"{source} != 0", f"{value} as i32"
        if name == "ks_axes":
            return (
                "[bool; 3]",
                f"std::array::from_fn(|axis| {source} >> axis & 1 != 0)",
                f"(0..3).map(|axis| ({value}[axis] as u32) << axis).sum()",
            )
        if meaning.may_be_nobody(one):
            return "Option<BodyId>", f"{source}.some()", f"{value}.unwrap_or_default()"
        if name in interface.enumerations:
            type = safe_name(name)
            enumeration = interface.enumerations[name]
            if meaning.may_be_none(interface, one):
                return f"Option<{type}>", f"{type}::of({source})", f"{value}.map_or(0, |one| one as i32)"
            if one.name == "kind":
                return type, f"{type}::of({source})?", f"{value} as i32"
            if meaning.may_lack(enumeration):
                usual = next(n for n in enumeration.enumerators if str(n.value) == one.default)
                of = f"{type}::of({source}).unwrap_or({type}::{camel(enumeration.short(usual))})"
                return type, of, f"{value} as i32"
            return type, f"{type}::of({source})", f"{value} as i32"
        if name in own_records or name in numbers:
            type = own_records.get(name) or numbers[name]
            return (f"[{type}; {one.type.count}]" if one.type.count > 1 else type), source, value
        type = safe_name(name)
        return type, f"{type}::of(&{source})", f"{value}.raw()"


def safe_fields(interface: Interface, record: Record) -> list[SafeField]:
    fields = []
    for one in record.fields:
        if not meaning.is_told(record, one) or one.type.is_pointer or meaning.group_of(record, one):
            continue
        flags = meaning.flags_of(interface, one)
        for name, bit in flags:
            made = SafeField(interface, record, Field(name, Type("ks_bool"), bit.comment))
            made.of = f"raw.{one.name} & sys::{bit.name} != 0"
            fields.append(made)
        if not flags:
            fields.append(SafeField(interface, record, one))
    return fields


def part_of(record: Record) -> tuple[str, list[Field]]:
    """The fields that make a part of the record, without the name of the part."""
    part = meaning.groups.get(record.name, "")
    fields = [one for one in record.fields if part and one.name.startswith(part + "_")]
    return part, [Field(one.name.removeprefix(part + "_"), one.type, one.comment) for one in fields]


def lists_of(record: Record) -> list[Field]:
    """Arrays of the caller, which a record of C points to."""
    return [one for one in record.fields if one.type.is_pointer]


def may_be_zero(type: str) -> bool:
    return (
        type.startswith("Option")
        or type in numbers.values()
        or type in own_records.values()
        or type == "bool"
    )


def struct_of(interface: Interface, record: Record) -> list[str]:
    name = safe_name(record.name)
    fields, lists = safe_fields(interface, record), lists_of(record)
    part, part_fields = part_of(record)
    lines = documented(record.comment, "") or [f"/// As `{name}` in C++."]
    derived = ["Clone", *([] if lists else ["Copy"]), "Debug"]
    if record.name != "ks_event":
        derived.append("PartialEq")
        types = {one.type for one in fields}
        derived += ["Eq"] if types <= {"u64", "i32", "u32"} else []
        has_zero = not interface.initialiser(record) and record.name != "ks_filter" and not lists
        derived += ["Default"] if has_zero and all(may_be_zero(one) for one in types) else []
    lines += [f"#[derive({', '.join(derived)})]", f"pub struct {name} {{"]
    for one in fields:
        lines += [*documented(one.comment, "    ", one.c_type), f"    pub {one.name}: {one.type},"]
    for one in lists:
        lines += [*documented(one.comment, "    "), f"    pub {one.name}: Vec<{safe_name(one.type.name)}>,"]
    if part:
        type = camel(part)
        lines += [f"    pub {part}: {f'Option<{type}>' if meaning.guard_of(record, part) else type},"]
    if record.name == "ks_event":
        lines.append("    raw: sys::ks_event,")
    lines += ["}", ""]
    lines += part_struct(interface, record, part, part_fields) if part else []
    lines += methods_of(interface, record, fields)
    return lines


def part_struct(interface: Interface, record: Record, part: str, fields: list[Field]) -> list[str]:
    is_plain = all(one.type.name == "uint64_t" for one in fields)
    lines = [
        f"/// A part of a [`{safe_name(record.name)}`].",
        f"#[derive(Clone, Copy, Debug, PartialEq{', Eq' if is_plain else ''})]",
    ]
    lines += [f"pub struct {camel(part)} {{"]
    for one in fields:
        made = SafeField(interface, record, one)
        lines += [*documented(one.comment, "    "), f"    pub {one.name}: {made.type},"]
    return [*lines, "}", ""]


def methods_of(interface: Interface, record: Record, fields: list[SafeField]) -> list[str]:
    name = safe_name(record.name)
    part, part_fields = part_of(record)
    has_kind = any(one.name == "kind" for one in record.fields)
    is_given, init = record.name in given, interface.initialiser(record)
    lines = [f"impl {name} {{"]
    if record.name == "ks_event":
        lines += [
            "    /// The record of C.",
            "    pub fn raw(&self) -> &sys::ks_event {",
            "        &self.raw",
            "    }",
        ]
    if not is_given or init or record.name == "ks_filter":
        result = f"Option<{name}>" if has_kind else name
        lines += [f"    pub(crate) fn of(raw: &sys::{record.name}) -> {result} {{"]
        made = [f"{one.name}: {one.of}" if one.of != one.name else one.name for one in fields]
        made += [f"{one.name}: Vec::new()" for one in lists_of(record)]
        if part:
            inside = ", ".join(
                f"{one.name}: {SafeField(interface, record, one).of.replace('raw.', f'raw.{part}_')}"
                for one in part_fields
            )
            whole, guard = f"{camel(part)} {{ {inside} }}", meaning.guard_of(record, part)
            made.append(f"{part}: (raw.{guard} != 0).then(|| {whole})" if guard else f"{part}: {whole}")
        made += ["raw: *raw"] if record.name == "ks_event" else []
        opening, closing = (
            (f"        Some({name} {{", "        })") if has_kind else (f"        {name} {{", "        }")
        )
        lines += [opening, *(f"            {one}," for one in made), closing, "    }"]
    if is_given:
        lines += raw_method(interface, record, fields)
    lines += ["}", ""]
    if is_given and init:
        lines += [
            "/// The defaults of the library.",
            f"impl Default for {name} {{",
            f"    fn default() -> {name} {{",
        ]
        lines += [f"        {name}::of(&sys::{record.name}::new())", "    }", "}", ""]
    return lines


def raw_method(interface: Interface, record: Record, fields: list[SafeField]) -> list[str]:
    """Makes the record of C, but for its pointers."""
    part, part_fields = part_of(record)
    by_name = {one.name: one for one in fields}
    made = []
    for one in record.fields:
        safe = by_name.get(renamed.get(one.name, one.name))
        name = raw_name(one.name)
        if one.name == "struct_size":
            made.append(f"{name}: std::mem::size_of::<sys::{record.name}>() as u32")
        elif safe:
            made.append(f"{name}: {safe.raw}")
        elif one.name.startswith("has_") and one.name != "has_" + part:
            guarded = one.name.removeprefix("has_")
            made.append(f"{name}: self.{renamed.get(guarded, guarded)}.is_some() as i32")
        elif meaning.group_of(record, one) and not meaning.guard_of(record, part):
            made.append(f"{name}: self.{part}.{one.name.removeprefix(part + '_')}")
        else:
            made.append(f"{name}: {'std::ptr::null()' if one.type.is_pointer else 'Default::default()'}")
    guard = meaning.guard_of(record, part) if part else None
    note = ", without its lists" if lists_of(record) else ""
    lines = [f"    /// The record of C{note}.", f"    pub(crate) fn raw(&self) -> sys::{record.name} {{"]
    opening = (
        f"        let {'mut ' if guard else ''}raw = sys::{record.name} {{"
        if guard
        else f"        sys::{record.name} {{"
    )
    lines += [opening, *(f"            {one}," for one in made)]
    if not guard:
        return [*lines, "        }", "    }"]
    lines += ["        };", f"        if let Some(one) = self.{part} {{", f"            raw.{guard} = 1;"]
    for one in part_fields:
        value = SafeField(interface, record, one).raw.replace("self.", "one.")
        lines.append(f"            raw.{part}_{one.name} = {value};")
    return [*lines, "        }", "        raw", "    }"]


def records(interface: Interface, banner: str) -> str:
    """The text of records.rs."""
    lines = [
        f"// {banner}",
        "//! Records and enumerations, as `kinesphere.h` has them; what else they can do is in the other modules.",
        "use crate::error::literal;",
        "use crate::geometry::{BodyId, Box3, State, Vec3};",
        "use crate::monitor::{ErrorBound, SeparationRule};",
        "use crate::sys;",
        "use std::fmt;",
        "",
    ]
    for enumeration in interface.enumerations.values():
        if not enumeration.is_flags and enumeration.name not in (
            "ks_status",
            "ks_shape_kind",
            "ks_motion_kind",
            "ks_bound_kind",
            "ks_separation_shape",
        ):
            lines += enumeration_of(interface, enumeration)
    for record in interface.records.values():
        if not record.is_handle and record.name not in by_hand and record.name not in own_records:
            lines += struct_of(interface, record)
            if record.name == "ks_filter":
                lines += filter_default(record)
    return "\n".join(lines)


def filter_default(record: Record) -> list[str]:
    values = ", ".join(
        f"{one.name}: {one.default.replace('UINT64_MAX', 'u64::MAX')}" for one in record.fields
    )
    return [
        "impl Default for Filter {",
        "    fn default() -> Filter {",
        f"        Filter {{ {values} }}",
        "    }",
        "}",
        "",
    ]
