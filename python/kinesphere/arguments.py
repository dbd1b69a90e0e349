"""What is wrong with a call whose arguments fit no function of the module."""

from __future__ import annotations

import difflib
import re
from typing import Any, Optional, Sequence

# Signature, number of arguments that need no name, and (name, has a default) of each argument.
Overload = tuple[str, int, Sequence[tuple[str, bool]]]


def _nearest(given: str, known: Sequence[str]) -> str:
    """The name that was probably meant, or a list of all."""

    def likeness(name: str) -> float:
        alike = difflib.SequenceMatcher(None, given, name).ratio()
        return max(alike, 0.7) if name.startswith(given) or given.startswith(name) else alike

    if not known:
        return "it has none"
    nearest = max(known, key=likeness)
    return f"the nearest is {nearest}" if likeness(nearest) >= 0.5 else "it has " + ", ".join(known)


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:56] + " ..."


def _kind(signature: str, name: str) -> str:
    """The type that a signature gives an argument, such as "float" or "World"."""
    found = re.search(rf"[(,] ?{name}: (?:Optional\[)?([\w.]+)(?=[,)\]]| = )", signature)
    return found[1].split(".")[-1] if found else "object"


def _has_a_number(value: object) -> bool:
    """Arrays and times of NumPy have __float__, whatever they hold."""
    try:
        float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return False
    return True


def _expected(kind: str, value: object) -> Optional[str]:
    """What an argument of this kind must be, if this value is not of that kind."""
    if kind == "object":
        return None
    if kind == "float":
        fits = hasattr(value, "__float__") or hasattr(value, "__index__")
        return None if fits and _has_a_number(value) else "must be a number"
    if kind == "int":
        if not hasattr(value, "__index__"):
            return "must be a whole number"
        return None if 0 <= int(value.__index__()) < 256 else "must be a whole number in its range"
    if kind in ("bool", "str"):
        fits = any(base.__name__ in (kind, kind + "_") for base in type(value).__mro__)
        return None if fits else f"must be {'True or False' if kind == 'bool' else 'a text'}"
    article = "an" if kind[0] in "AEIO" else "a"
    return None if any(base.__name__ == kind for base in type(value).__mro__) else f"must be {article} {kind}"


def _in_one(call: str, overload: Overload, args: Sequence[object], kwargs: dict[str, Any]) -> Optional[str]:
    signature, positional, arguments = overload
    if not arguments:
        return None
    names = [name for name, _ in arguments]
    is_method = names[0] == "self"
    if len(args) > positional:
        most = positional - is_method
        rest = names[positional:]
        return f"{call}: takes at most {most} arguments without a name, but has {len(args) - is_method}" + (
            f"; {', '.join(rest)} need theirs" if rest else ""
        )
    for name in names[: len(args)]:
        if name in kwargs:
            return f"{call}: {name} is given twice, with its name and without"
    given = dict(zip(names, args)) | kwargs
    for name, has_default in arguments:
        if name not in given and not has_default:
            return f"{call}: {name} is missing"
    wrong = {
        name: expected
        for name, value in given.items()
        if not (value is None and f"{name}: Optional[" in signature)
        and (expected := _expected(_kind(signature, name), value)) is not None
    }
    # The range of a whole number is not known, so one that is not small is blamed only if there is no other.
    certain = [name for name, expected in wrong.items() if not expected.endswith("range")]
    if not certain and len(wrong) != 1:
        shown = ", ".join(_shown(value) for value in args[is_method:])
        return f"{call}: the arguments ({shown}) fit no call of {signature.split(' -> ')[0]}"
    name = (certain or list(wrong))[0]
    return f"{call}: {name} {wrong[name]}, but is {_shown(given[name])}"


def wrong_call(
    call: str, overloads: Sequence[Overload], args: Sequence[object], kwargs: dict[str, Any]
) -> Optional[str]:
    """One line that names the argument; None if it is not known which is wrong."""
    known = list(
        dict.fromkeys(name for _, _, arguments in overloads for name, _ in arguments if name != "self")
    )
    for name in kwargs:
        if name not in known:
            return f"{call}: there is no argument {name}; {_nearest(name, known)}"
    return _in_one(call, overloads[0], args, kwargs) if len(overloads) == 1 else None
