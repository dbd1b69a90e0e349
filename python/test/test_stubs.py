"""The types of the C++ module (_kinesphere.pyi) have its names, its arguments and their defaults.

run.sh lets mypy's stubtest compare the rest, but for the arguments of what pybind11 made, which it does not see.
"""

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Union

from kinesphere import _kinesphere

stub = ast.parse(Path(_kinesphere.__file__).with_name("_kinesphere.pyi").read_text())
Definition = Union[ast.FunctionDef, ast.ClassDef]


def definitions(body: list[ast.stmt]) -> dict[str, list[Definition]]:
    found: dict[str, list[Definition]] = {}
    for one in body:
        if isinstance(one, (ast.FunctionDef, ast.ClassDef)):
            found.setdefault(one.name, []).append(one)
    return found


def parts(text: str) -> Iterator[str]:
    """What is between the commas, but for those inside brackets."""
    depth, start = 0, 0
    for k, letter in enumerate(text + ","):
        depth += (letter in "([{<") - (letter in ")]}>")
        if letter == "," and depth == 0:
            yield text[start:k].strip()
            start = k + 1


def arguments_at_runtime(function: Any) -> list[tuple[str, bool]]:
    """Names and whether they have a default, of the signature that pybind11 writes; empty if it has no names."""
    signature = (function.__doc__ or "").splitlines()[0]
    if "(" not in signature or "Overloaded" in (function.__doc__ or ""):
        return []
    inside = signature[signature.index("(") + 1 : signature.rindex(")")]
    found = [part for part in parts(inside) if part and part[0] != "*" and not part.startswith("self")]
    names = [(part.split(":")[0].strip(), "=" in part) for part in found]
    return [] if any(name.startswith("arg") and name[3:].isdigit() for name, _ in names) else names


def arguments_of_stub(function: ast.FunctionDef) -> list[tuple[str, bool]]:
    given = function.args
    placed = [one.arg for one in given.args if one.arg != "self"]
    first = len(placed) - len(given.defaults)
    by_place = [(name, k >= first) for k, name in enumerate(placed)]
    named = zip(given.kwonlyargs, given.kw_defaults)
    return by_place + [(one.arg, default is not None) for one, default in named]


def is_public(name: str) -> bool:
    return not name.startswith("_")


def test_the_types_of_the_module_are_those_of_the_module() -> None:
    module, types = vars(_kinesphere), definitions(stub.body)
    differences = []
    values = {
        one.target.id
        for one in stub.body
        if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)
    }
    typed_dicts = {
        name for name, (kind, *_) in types.items()
        if isinstance(kind, ast.ClassDef) and any(isinstance(b, ast.Name) and b.id == "TypedDict" for b in kind.bases)
    }  # fmt: skip
    there = {name for name in module if not name.startswith("__")}
    differences += sorted(there ^ (set(types) - typed_dicts | values))
    functions = {name: (module[name], *found) for name, found in types.items() if name in module}
    checked = 0
    for name, (kind, *found) in list(functions.items()):
        if not isinstance(found[0], ast.ClassDef):
            continue
        del functions[name]
        members = definitions(found[0].body)
        known = {member for member in vars(kind) if is_public(member)}
        differences += [f"{name}.{member}" for member in known ^ {one for one in members if is_public(one)}]
        for member, of_stub in members.items():
            value = getattr(kind, member, None)
            if callable(value) and (is_public(member) or member == "__init__"):
                functions[f"{name}.{member}"] = (value, *of_stub)
    for name, (function, *found) in functions.items():
        expected = arguments_at_runtime(function)
        if expected and len(found) == 1 and isinstance(found[0], ast.FunctionDef):
            checked += 1
            if arguments_of_stub(found[0]) != expected:
                differences.append(f"{name}{expected}")
    assert differences == [] and checked > 100
