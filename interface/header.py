"""Reads include/kinesphere.h, the one description of the interface for all languages but C++.

What the writers of this folder take from it, beside names, types and order:

- `///` comments before a declaration, and `///<` behind a field or an enumerator;
- `default NUMBER` in the comment of a field of a definition: what its `ks_..._init()` sets. Zero needs none;
- `ks_bool` for fields that are false or true;
- `has_NAME` before `NAME`: NAME is there only if it is not 0;
- `no body` in the comment of an id that may name none;
- an array of callers as a pointer with a name in the plural, and its length as a `size_t` behind it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field


class HeaderError(Exception):
    """The header has something that this reader does not know."""


@dataclass(frozen=True)
class Type:
    """A type of a field or a parameter: its name, whether it is a pointer, to what, and how many it has."""

    name: str
    is_pointer: bool = False
    is_const: bool = False
    count: int = 1


@dataclass(frozen=True)
class Field:
    name: str
    type: Type
    comment: str = ""

    @property
    def default(self) -> str:
        found = re.search(r"\bdefault (-?[\w.+/-]*[\w])", self.comment)
        return found[1] if found else "0"


@dataclass(frozen=True)
class Record:
    name: str
    fields: tuple[Field, ...]
    comment: str = ""

    @property
    def is_sized(self) -> bool:
        """It may get more fields later."""
        return self.fields[0].name == "struct_size"

    @property
    def is_handle(self) -> bool:
        return len(self.fields) == 1 and self.fields[0].name == "value"

    def __getitem__(self, name: str) -> Field:
        return next(one for one in self.fields if one.name == name)


@dataclass(frozen=True)
class Enumerator:
    name: str
    value: int
    comment: str = ""


@dataclass(frozen=True)
class Enumeration:
    """`type` is the name of the integer with these values: `ks_event_kind`."""

    name: str
    type: str
    enumerators: tuple[Enumerator, ...]
    comment: str = ""

    @property
    def prefix(self) -> str:
        """What all names begin with: `KS_EVENT_`."""
        names = [one.name for one in self.enumerators]
        common = next(n for n in range(len(names[0]), 0, -1) if all(one[:n] == names[0][:n] for one in names))
        return names[0][: names[0][:common].rindex("_") + 1]

    def short(self, one: Enumerator) -> str:
        return one.name[len(self.prefix) :].lower()

    @property
    def is_flags(self) -> bool:
        return self.type == "uint32_t"


@dataclass(frozen=True)
class Parameter:
    name: str
    type: Type


@dataclass(frozen=True)
class Function:
    name: str
    result: Type
    parameters: tuple[Parameter, ...]
    comment: str = ""
    must_check: bool = False

    def is_array(self, index: int) -> bool:
        """A pointer to several: its name is a plural, and its length, or that of another one, is told."""
        one = self.parameters[index]
        if not one.type.is_pointer or not one.name.endswith("s") or one.name == "status":
            return False
        after = next((p for p in self.parameters[index + 1 :] if not p.type.is_pointer), None)
        has_count = after is not None and after.type.name == "size_t"
        return has_count or one.name in ("ids", "numbers", "states")


@dataclass
class Interface:
    aliases: dict[str, str] = field(default_factory=dict)
    enumerations: dict[str, Enumeration] = field(default_factory=dict)
    records: dict[str, Record] = field(default_factory=dict)
    callbacks: dict[str, Function] = field(default_factory=dict)
    functions: dict[str, Function] = field(default_factory=dict)

    def initialiser(self, record: Record) -> Function | None:
        """The function that fills a definition with its defaults."""
        return self.functions.get(record.name + "_init")


scalars = {
    "double": 8,
    "int32_t": 4,
    "uint32_t": 4,
    "int64_t": 8,
    "uint64_t": 8,
    "uint8_t": 1,
    "size_t": 8,
    "void": 1,
    "char": 1,
}


def words(text: str) -> str:
    return " ".join(text.split())


def type_of(text: str, count: int = 1) -> Type:
    found = re.fullmatch(r"(const )?(\w+) ?(\*?)", words(text))
    if not found:
        raise HeaderError(f"kinesphere.h: unknown type: {text}")
    return Type(found[2], bool(found[3]), bool(found[1]), count)


def fields_of(record: str, body: str) -> tuple[Field, ...]:
    fields: list[Field] = []
    before: list[str] = []
    is_behind = False
    for line in body.splitlines():
        declared, _, comment = line.partition("///")
        declared, comment = declared.strip(), comment.lstrip("<").strip()
        if declared:
            found = re.fullmatch(r"((?:const )?\w+\*?) ([\w, ]+?)(?:\[(\d+)\])?;", declared)
            if not found:
                raise HeaderError(
                    f"kinesphere.h: {record}: a field in a line of its own is expected: {declared}"
                )
            text = words(" ".join([*before, comment]))
            for name in found[2].split(", "):
                fields.append(Field(name, type_of(found[1], int(found[3] or 1)), text))
            before, is_behind = [], bool(comment)
        elif comment and is_behind and fields and line.strip().startswith("///<"):
            last = fields[-1]
            fields[-1] = Field(last.name, last.type, words(last.comment + " " + comment))
        elif comment:
            before.append(comment)
    return tuple(fields)


def enumerators_of(body: str) -> tuple[Enumerator, ...]:
    found: list[Enumerator] = []
    before: list[str] = []
    for line in re.sub(r"=\s+(\d)", r"= \1", body).splitlines():
        declared, _, comment = line.partition("//")
        comment = comment.lstrip("/<").strip()
        items = re.findall(r"(KS_\w+) = (\d+)", declared)
        for name, value in items:
            found.append(Enumerator(name, int(value), words(" ".join([*before, comment]))))
        if items:
            before = []
        elif comment and line.strip().startswith("///"):
            before.append(comment)
    return tuple(found)


def function_of(name: str, result: str, parameters: str, comment: str, must_check: bool = False) -> Function:
    found = []
    for one in [] if words(parameters) == "void" else parameters.split(","):
        parts = re.fullmatch(r"(.*[ *])(\w+)", words(one))
        if not parts:
            raise HeaderError(f"kinesphere.h: {name}: a parameter with a name is expected: {one}")
        found.append(Parameter(parts[2], type_of(parts[1].strip())))
    return Function(name, type_of(result), tuple(found), comment, must_check)


declarations = re.compile(
    r"(?P<comment>(?:^///[^\n]*\n)*)"
    r"(?:"
    r"^typedef struct \w+ \{\n(?P<fields>.*?)^\} (?P<record>\w+);"
    r"|^typedef (?P<integer>u?int32_t) (?P<alias>\w+);"
    r"|^enum \{(?P<values>.*?)\};"
    r"|^typedef (?P<answer>\w+) \(\*(?P<callback>\w+)\)\((?P<given>.*?)\);"
    r"|^KS_API (?P<checked>KS_MUST_CHECK )?(?P<result>[\w ]+\*?) (?P<function>ks_\w+)\((?P<taken>.*?)\);"
    r"|^static inline [^{]*\{.*?^\}"
    r")",
    re.MULTILINE | re.DOTALL,
)


def read(text: str) -> Interface:
    """Reads the text of the header."""
    interface = Interface()
    alias, alias_comment = "", ""
    known: set[str] = set(scalars)
    for found in declarations.finditer(text):
        comment = words(re.sub(r"^///", "", found["comment"], flags=re.MULTILINE))
        if found["record"]:
            interface.records[found["record"]] = Record(
                found["record"], fields_of(found["record"], found["fields"]), comment
            )
            known.add(found["record"])
        elif found["alias"]:
            alias, alias_comment = found["alias"], comment
            interface.aliases[alias] = found["integer"]
            known.add(alias)
        elif found["values"]:
            if not alias:
                raise HeaderError(
                    f"kinesphere.h: no typedef before the enumeration {found['values'].strip()}"
                )
            interface.enumerations[alias] = Enumeration(
                alias, interface.aliases[alias], enumerators_of(found["values"]), alias_comment or comment
            )
            alias = ""
        elif found["callback"]:
            one = function_of(found["callback"], found["answer"], found["given"], comment)
            interface.callbacks[one.name] = one
            known.add(one.name)
        elif found["function"]:
            one = function_of(
                found["function"], found["result"], found["taken"], comment, bool(found["checked"])
            )
            interface.functions[one.name] = one
    require_known(interface, known)
    return interface


def require_known(interface: Interface, known: set[str]) -> None:
    """Refuses types that the header does not declare before it uses them."""
    for record in interface.records.values():
        for one in record.fields:
            if one.type.name not in known:
                raise HeaderError(f"kinesphere.h: {record.name}.{one.name}: unknown type {one.type.name}")
    for function in [*interface.callbacks.values(), *interface.functions.values()]:
        for one in function.parameters:
            if one.type.name not in known:
                raise HeaderError(
                    f"kinesphere.h: {function.name}: unknown type {one.type.name} of {one.name}"
                )


def size_and_alignment(interface: Interface, type: Type, pointer: int = 8) -> tuple[int, int]:
    """Of a value; `pointer` is the size of a pointer."""
    if type.is_pointer or type.name in interface.callbacks or type.name == "size_t":
        return pointer, pointer
    name = interface.aliases.get(type.name, type.name)
    if name in scalars:
        return scalars[name] * type.count, scalars[name]
    size, alignment = layout(interface, interface.records[name], pointer)[1:]
    return size * type.count, alignment


def layout(interface: Interface, record: Record, pointer: int = 8) -> tuple[dict[str, int], int, int]:
    """The offset of each field, the size, and the alignment of a record."""
    offsets, at, widest = {}, 0, 1
    for one in record.fields:
        size, alignment = size_and_alignment(interface, one.type, pointer)
        at = (at + alignment - 1) // alignment * alignment
        offsets[one.name] = at
        at, widest = at + size, max(widest, alignment)
    return offsets, (at + widest - 1) // widest * widest, widest


def camel(name: str) -> str:
    """`contact_begin` as `ContactBegin`."""
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def lower_camel(name: str) -> str:
    """`contact_begin` as `contactBegin`."""
    return name[:1] + camel(name)[1:]


def wrapped(text: str, width: int, first: str, rest: str | None = None) -> list[str]:
    """Lines of at most `width` characters, which begin with `first` and then `rest`."""
    import textwrap

    return textwrap.wrap(
        text,
        width,
        initial_indent=first,
        subsequent_indent=first if rest is None else rest,
        break_long_words=False,
        break_on_hyphens=False,
    )
