#!/usr/bin/env python3
"""Writes the reference of the Python package from its docstrings and the types of its stubs: a page with all functions,
and one for each class in the folder beside it that is named as the page.

It fails for a public class, call or module that has no docstring. Plain attributes may leave theirs to the class.
Usage: python_reference.py PAGE (with an interpreter that has the package)
"""

import ast
import inspect
import re
import shutil
import sys
from enum import IntEnum
from pathlib import Path
from typing import Any

import kinesphere

page = Path(sys.argv[1])
GROUPS = {
    "Worlds": "World GameWorld Event Events EventKind EventIterator EventHash BodyId Wall Senses Workers Counters BodyView BusyBody",
    "Certified answers": "SafeTime SafeSeparation EarliestContact EarliestApproach DistanceLimits",
    "Shapes and starts": "Ball Box Capsule HalfSpace Hull Mesh Triangle place_spheres radial_distribution"
    " ExpandingBox",
    "Motions": "Motion Ballistic RandomForces VelocityField Circulation RecordedTracks SteeredMotion FrameMotion"
    " MotionSource BodyMap",
    "Responses": "Bouncing Roughness StepPotential bounce bounce_rigid settle least_resting_speed",
    "Monitors": "Monitor TrackClass Separation SeparationRule ErrorBound Shard Verdict MonitorEvent MonitorEvents"
    " MonitorEventKind MonitorEventIterator PairAnswer TrackView TrackPlace MonitorCounters",
    "Recordings of motion, streams and known paths": "tracks tracks_in Approaches watch Alerts PolynomialPaths"
    " PathApproaches",
    "Scenes and recorded runs": "Scene scene_names read_scene Replay read_recording RecordedRun",
    "Errors": "KinesphereError InvalidValue StateError BodyError",
    "Constants and types of tables": "no_body zone_class index_of event_dtype monitor_event_dtype pair_answer_dtype"
    " __version__",
}
# `name: what it is`, or `name (unit): what it is`.
ARGUMENT = re.compile(r"^([a-z]\w*(?:(?:, | and )\w+)*)( \([^)]*\))?: (?=\S)")
missing: list[str] = []


def documentation(name: str, thing: Any) -> str:
    """The docstring without the signatures that pybind11 writes before it."""
    text = inspect.cleandoc(getattr(thing, "__doc__", None) or "")
    short = name.rsplit(".", 1)[-1]
    if text.startswith(short + "("):
        text = text.partition("\n")[2].strip()
        text = re.sub(r"^(Overloaded function\.)?$|^\d+\. " + short + r"\(.*$", "", text, flags=re.M)
    if not text.strip():
        missing.append(name)
    lines, in_code = [], False
    for line in text.strip().splitlines():
        # Indented blocks are code.
        if line.strip():
            is_code = line.startswith("    ")
            in_code, toggled = is_code, is_code != in_code
            if toggled and is_code:
                lines.append("")
        lines.append(ARGUMENT.sub(r"- **\1**\2: ", line) if not line.startswith(" ") else line)
    shown: list[str] = []
    for line in lines:
        if (
            line.startswith("- **")
            and shown
            and shown[-1].strip()
            and not shown[-1].startswith(("- **", " "))
        ):
            shown.append("")
        shown.append(
            "    " + line
            if shown and shown[-1].startswith(("- **", "    ")) and line and line[0] not in "- "
            else line
        )
    return "\n".join(shown).replace("<", "&lt;")


stubs: dict[str, list[ast.stmt]] = {}
for source in sorted(Path(kinesphere.__file__).parent.glob("*.py*")):
    for node in ast.parse(source.read_text()).body if source.suffix in (".py", ".pyi") else []:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            stubs.setdefault(node.name, []).append(node)


def signature(node: ast.FunctionDef, own: bool) -> str:
    """`name(arguments) -> result`, one argument a line if it is long."""
    node.args.args = node.args.args[own:]
    arguments, result = ast.unparse(node.args), ast.unparse(node.returns) if node.returns else "None"
    line = f"{node.name}({arguments}) -> {result}"
    if len(line) <= 100:
        return line
    given = re.sub(r", (?=\w+: |\*)", ",\n    ", arguments)
    return f"{node.name}(\n    {given},\n) -> {result}"


def is_kind(node: ast.FunctionDef, kind: str) -> bool:
    return any(isinstance(one, ast.Name) and one.id == kind for one in node.decorator_list)


def of_class(name: str, thing: Any) -> str:
    text = f"# {name}\n\nA class of the [Python package](../{page.name}), `kinesphere.{name}`.\n\n"
    functions = [node for node in stubs[name][0].body if isinstance(node, ast.FunctionDef)]
    makers = [
        node
        for node in functions
        if node.name == "__init__" and len(node.args.args + node.args.kwonlyargs) > 1
    ]
    if makers:
        calls = "\n".join(signature(node, True).removesuffix(" -> None") for node in makers)
        text += f"```python\n{calls.replace('__init__', name)}\n```\n\n"
    text += documentation(name, thing) + "\n\n"
    rows, members = [], {}
    for node in functions:
        if node.name.startswith("_") or any(isinstance(one, ast.Attribute) for one in node.decorator_list):
            continue
        member = inspect.getattr_static(thing, node.name, None)
        if is_kind(node, "property"):
            about = (
                inspect.cleandoc(getattr(member, "__doc__", None) or "")
                .replace("\n", " ")
                .replace("|", "\\|")
            )
            rows.append(f"| `{node.name}` | `{ast.unparse(node.returns)}` | {about} |".replace("<", "&lt;"))
        else:
            members.setdefault(node.name, []).append(node)
    if rows:
        text += "| attribute | type | |\n|---|---|---|\n" + "\n".join(rows) + "\n\n"
    for member, nodes in members.items():
        # The last of several signatures takes what all of them take.
        call = signature(nodes[-1], not is_kind(nodes[-1], "staticmethod"))
        text += f"## {name}.{member}\n\n```python\n{call}\n```\n\n"
        text += documentation(f"{name}.{member}", getattr(thing, member)) + "\n\n"
    body = stubs[name][0].body
    values = [
        f"| `{line.targets[0].id}` | {text_of(after)} |"
        for line, after in zip(body, body[1:] + [ast.Pass()])
        if isinstance(line, ast.Assign)
        and isinstance(line.targets[0], ast.Name)
        and issubclass(thing, IntEnum)
    ]
    return text + ("| value | |\n|---|---|\n" + "\n".join(values) + "\n\n" if values else "")


def text_of(node: ast.stmt) -> str:
    """The text that follows a member, on one line; nothing if there is none."""
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return " ".join(node.value.value.split()) if is_text else ""


text = "# Reference of the Python package\n\n" + documentation("kinesphere", kinesphere) + "\n\n"
text += (
    "Exceptions say what was wrong, as the `Error` of C++ does. `Array` is anything that NumPy converts.\n\n"
)
named = " ".join(GROUPS.values()).split()
if sorted(named) != sorted(kinesphere.__all__):
    sys.exit(f"python_reference: groups and __all__ differ: {sorted(set(named) ^ set(kinesphere.__all__))}")
classes: dict[str, str] = {}
for group, names in GROUPS.items():
    text += f"## {group}\n\n"
    rows, calls_of = [], ""
    for name in names.split():
        thing = getattr(kinesphere, name)
        if inspect.isclass(thing):
            classes[name] = of_class(name, thing)
            about = documentation(name, thing).split("\n\n")[0].replace("\n", " ").replace("|", "\\|")
            rows.append(f"| [{name}]({page.stem}/{name}.md) | {about} |")
        elif callable(thing):
            calls = "\n".join(
                signature(node, False) for node in stubs[name] if isinstance(node, ast.FunctionDef)
            )
            calls_of += f"### {name}\n\n```python\n{calls}\n```\n\n{documentation(name, thing)}\n\n"
        else:
            shown = (
                str(thing) if isinstance(thing, (int, str)) else "a NumPy dtype: " + ", ".join(thing.names)
            )
            calls_of += f"### {name}\n\n`{shown}`\n\n"
    if rows:
        text += "| class | |\n|---|---|\n" + "\n".join(rows) + "\n\n"
    text += calls_of
if missing:
    sys.exit("python_reference: no docstring: " + ", ".join(missing))
folder = page.with_suffix("")
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
for name, content in classes.items():
    (folder / f"{name}.md").write_text(content)
page.write_text(text)
