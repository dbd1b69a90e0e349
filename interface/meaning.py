"""What the fields of records mean for languages that have more types than C."""

from __future__ import annotations

import re
from collections.abc import Callable

from header import Enumeration, Enumerator, Field, Interface, Record

# Fields that make one part of a record, by what their names begin with. A part that has_PART guards may be missing.
groups = {"ks_monitor_definition": "shard", "ks_track_report": "plan"}

# Enumerations whose 0 is a choice like the others, though it is called "none".
complete = {"ks_body_action"}


def plain(comment: str, type: str = "") -> str:
    """A comment without the names of C, as a sentence; `type` is that of the field in C."""
    text = re.sub(r"(^|; |, )[Ss]um of KS_\w+\.\.\.(: )?", r"\1", comment)
    text = re.sub(r"One of KS_\w+\.\.\.[:.]?", "", text)
    text = re.sub(r", KS_\w+:", ":", text)
    text = re.sub(r"\bKS_(?:EVENT|MONITOR|CONTACTS)_(\w+)", lambda found: f"`{found[1].lower()}`", text)
    text = text.replace("UINT64_MAX", "all bits").replace("INFINITY", "infinity")
    text = re.sub(r"\([^()]*(?:kinesphere/|\.hpp|\bks_)[^()]*\)", "", text)
    text = re.sub(r"(^|(?<=\. ))Fields(?: and ranges)?: [^.]*kinesphere/\S*\.hpp\.?", "", text)
    text = re.sub(r"; fields as in ks_\w+", "", text)
    text = " ".join(re.sub(r" \.(?!\.)", ".", text).split())
    if re.search(r"\b(ks|KS)_", text):
        sentences = re.split(r"(?<=\.) ", text)
        text = " ".join(one for one in sentences if not re.search(r"\b(ks|KS)_", one))
    if type == "ks_bool":
        text = (
            text.replace("default 1", "default true")
            .replace("If 0,", "If false,")
            .replace("0: possibly", "False: possibly")
        )
    elif type == "ks_contacts":
        text = text.replace("default 3", "default `all`").replace("0: those", "by default those")
    return text[:1].upper() + text[1:] + ("" if text[-1:] in ".:" else ".") if text else ""


def respelled(text: str, spell: Callable[[str], str]) -> str:
    """A comment in which fields are spelled as a language spells them; names of enumerators have quotes."""
    return re.sub(r"(?<![`\w])[a-z]+(?:_[a-z]+)+(?![`\w])", lambda found: spell(found[0]), text)


def choices(enumeration: Enumeration) -> list:
    """The enumerators but for the 0 that says that there is none."""
    first = enumeration.enumerators[0]
    lacks = first.value == 0 and enumeration.short(first) in ("none", "of_world")
    if lacks and enumeration.name not in complete:
        return list(enumeration.enumerators[1:])
    return list(enumeration.enumerators)


def may_lack(enumeration: Enumeration) -> bool:
    return len(choices(enumeration)) < len(enumeration.enumerators)


def is_told(record: Record, one: Field) -> bool:
    """Is of use to callers: neither bookkeeping of C, nor what says whether another field is there."""
    if one.name in ("struct_size", "reserved") or one.name.endswith("_user"):
        return False
    names = {other.name for other in record.fields}
    if one.name.startswith("has_"):
        return False
    return not (one.name.endswith("_count") and is_length(record, one))


def is_length(record: Record, one: Field) -> bool:
    return any(is_length_of(one, other) for other in record.fields)


def is_length_of(length: Field, pointer: Field) -> bool:
    """`class_count` is that of `classes`."""
    if not pointer.type.is_pointer or length.type.name != "size_t":
        return False
    stem = length.name.removesuffix("_count")
    return length.name.endswith("_count") and pointer.name in (stem + "s", stem + "es")


def guard_of(record: Record, name: str) -> str | None:
    """The field that says whether another one is there."""
    return next((one.name for one in record.fields if one.name == "has_" + name), None)


def group_of(record: Record, one: Field) -> str | None:
    part = groups.get(record.name)
    return part if part and one.name.startswith(part + "_") else None


def may_be_nobody(one: Field) -> bool:
    return one.type.name == "ks_body_id" and "no body" in one.comment.lower()


def may_be_none(interface: Interface, one: Field) -> bool:
    """An enumerator that may be the one that says that there is none."""
    enumeration = interface.enumerations.get(one.type.name)
    return enumeration is not None and may_lack(enumeration) and one.default == "0" and one.name != "kind"


def flags_of(interface: Interface, one: Field) -> list[tuple[str, Enumerator]]:
    """Names of a sum of bits, each with its enumerator: `first_senses`, `second_is_zone`."""
    enumeration = interface.enumerations.get(one.type.name)
    if enumeration is None or not enumeration.is_flags or enumeration.name == "ks_axes":
        return []
    names = []
    for bit in enumeration.enumerators:
        short = enumeration.short(bit)
        if enumeration.name == "ks_traits":
            names.append((one.name.replace("traits", "is_" + short), bit))
        else:
            names.append((f"{short}_{one.name}", bit))
    return names


def number(text: str) -> float:
    """The number that the comment of a field gives as its default."""
    return {"NaN": float("nan"), "INFINITY": float("inf"), "UINT64_MAX": 2**64 - 1}.get(text) or float(text)
