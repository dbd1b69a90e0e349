"""Writes docs/parity.md: which call of which language does what, and why one lacks it.

A call that is named here and is not in the sources of its language, or that lacks without a reason, is an error.
"""

from __future__ import annotations

import bisect
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from header import Function, HeaderError, Interface, lower_camel

repository = Path(__file__).resolve().parent.parent
languages = ["C", "C++", "Rust", "C#", "Python", "JavaScript"]

# What only C needs, as other languages have it in their types: errors, the ends of objects, defaults, names of kinds.
housekeeping = re.compile(
    r"ks_(last_error_\w+|status_name|abi_version|\w+_init|\w+_destroy|probe_motions|\w+_name)$"
)

# Names that are not those of C without `ks_world_` and the like: in C++, Python and JavaScript.
names = {
    "ks_version": ("version", "version", "version"),
    "ks_mesh_create": ("Mesh::create", "Mesh", "mesh"),
    "ks_mesh_create_chain": ("Mesh::chain", "chain", "chain"),
    "ks_world_create": ("World::create", "World", "World"),
    "ks_world_clone": ("clone", "clone", "clone"),
    "ks_world_set_velocities": ("set_velocities", "set_velocity", "setVelocityAll"),
    "ks_world_use_threads": ("use_workers", "use_threads", "none"),
    "ks_world_set_angular_velocity": ("change", "set_angular_velocity", "setAngularVelocity"),
    "ks_world_set_rotation": ("change", "set_rotation", "setRotation"),
    "ks_world_set_radius": ("change", "set_radius", "setRadius"),
    "ks_world_set_radius_rate": ("change", "set_radius_rate", "setRadiusRate"),
    "ks_world_set_mass": ("change", "set_mass", "setMass"),
    "ks_world_set_motion_limits": ("change", "set_motion_limits", "setMotionLimits"),
    "ks_world_set_user_data": ("change", "set_user_data", "setUserData"),
    "ks_world_set_filter": ("change", "set_filter", "setFilter"),
    "ks_world_set_solid": ("change", "set_solid", "setSolid"),
    "ks_world_set_sensor_class": ("change", "set_sensor_class", "setSensorClass"),
    "ks_world_size": ("size", "__len__", "size"),
    "ks_world_contains": ("contains", "__contains__", "contains"),
    "ks_world_rotation": ("rotation", "rotations", "rotation"),
    "ks_world_probe_count": ("counters", "counters", "counters"),
    "ks_probe_reason_advice": ("advice_on", "advice", "advice"),
    "ks_event_hash_add": ("add", "add", "add"),
    "ks_event_hash_value": ("value", "value", "value"),
    "ks_bounce_rough": ("bounce", "Roughness", "bounce"),
    "ks_step_potential_create": ("StepPotential::create", "StepPotential", "StepPotential"),
    "ks_step_potential_respond": ("respond", "StepPotential", "respond"),
    "ks_step_potential_energy": ("energy", "energy", "energy"),
    "ks_game_create": ("GameWorld::create", "GameWorld", "GameWorld"),
    "ks_game_restore": ("GameWorld::restore", "GameWorld.restore", "GameWorld.restore"),
    "ks_game_bodies": ("ids, positions, velocities",) * 3,
    "ks_game_set_response": ("set_response", "respond", "setRespond"),
    "ks_world_add_motion": ("add_motion", "add_motion", "addMotion"),
    "ks_world_add_to_motion": ("BodyMap::add", "BodyMap.add", "BodyMap.add"),
    "ks_world_push_frame": ("push", "push", "push"),
    "ks_world_push_frame_at": ("push", "push", "push"),
    "ks_world_latest_frame": ("latest", "latest", "latest"),
    "ks_world_latest_frame_time": ("latest_time", "latest_time", "latestTime"),
    "ks_world_states": ("states", "states", "states"),
    "ks_world_pair_safe_until": ("safe_until", "safe_until", "safeUntil"),
    "ks_world_overlapping_sphere": ("overlapping", "overlapping", "overlapping"),
    "ks_world_overlapping_box": ("overlapping", "overlapping_box", "overlappingBox"),
    "ks_world_cast": ("ray_cast, sphere_cast", "ray_cast, sphere_cast", "rayCast, sphereCast"),
    "ks_world_cast_all": ("ray_cast_all", "ray_cast_all", "rayCastAll"),
    "ks_world_recording": ("stop_recording", "stop_recording", "stopRecording"),
    "ks_replay_open": ("Replay::open", "Replay", "Replay"),
    "ks_replay_steps": ("step, step_count", "step, step_count", "step, stepCount"),
    "ks_replay_hash": ("hash", "hash", "hash"),
    "ks_monitor_create": ("Monitor::create", "Monitor", "Monitor"),
    "ks_monitor_places": ("track", "track", "track"),
}

# Public functions that are not the nearest ones before the call of C.
wrappers = {
    ("ks_mesh_create", "Rust"): "Mesh::new",
    ("ks_mesh_create", "C#"): "Mesh",
    ("ks_world_create", "Rust"): "World::new",
    ("ks_world_create", "C#"): "World",
    ("ks_step_potential_create", "Rust"): "StepPotential::new",
    ("ks_step_potential_create", "C#"): "StepPotential",
    ("ks_world_clone", "C#"): "Clone",
    ("ks_game_create", "Rust"): "GameWorld::new",
    ("ks_game_create", "C#"): "GameWorld",
    ("ks_game_restore", "Rust"): "GameWorld::restore",
    ("ks_game_restore", "C#"): "GameWorld.Restore",
    ("ks_game_bodies", "Rust"): "ids, positions, velocities",
    ("ks_game_bodies", "C#"): "Ids, Positions, Velocities",
    ("ks_replay_open", "C#"): "Replay",
    ("ks_monitor_create", "Rust"): "Monitor::new",
    ("ks_monitor_create", "C#"): "Monitor",
    ("ks_bounce", "Rust"): "bounce, settle",
    ("ks_world_add_motion", "C#"): "AddBallistic, AddRandomForces, AddFrames, AddSteered",
}

# Why a language lacks a call of C, and what does the same there.
lacking: dict[tuple[str, str], str] = {
    ("ks_world_use_threads", "JavaScript"): "Its module has one thread.",
}


@dataclass(frozen=True)
class Capability:
    """What C lacks: its call in each language that has it, and why the others do not."""

    what: str
    calls: dict[str, str]
    reason: str


beyond = [
    Capability(
        "a motion of one's own in a run",
        {"C++": "MotionSource", "Python": "MotionSource"},
        "A run goes back and forth in time. A loop over events with a probe does the same without that.",
    ),
    Capability(
        "several motions in a world",
        {
            "C": "ks_world_add_motion",
            "C++": "BodyMap",
            "Rust": "add_motion",
            "C#": "AddBallistic",
            "Python": "BodyMap",
            "JavaScript": "BodyMap",
        },
        "",
    ),
    Capability(
        "frames that turn rigid bodies",
        {"C++": "rotations", "Python": "rotations", "JavaScript": "rotations"},
        "A probe for rotations (`ks_world_set_rotation_probe`) gives them.",
    ),
    Capability(
        "motion in a field of velocities",
        {"C++": "VelocityField", "Python": "VelocityField"},
        "A field is a function that is asked at each step; as a callback it would cost more than a probe.",
    ),
    Capability(
        "recorded tracks as a motion",
        {"C++": "RecordedTracks", "Python": "RecordedTracks", "JavaScript": "RecordedTracks"},
        "A probe that interpolates is as short; not asked for so far.",
    ),
    Capability(
        "approaches of known paths",
        {"C++": "Approaches", "Python": "approaches"},
        "Not asked for so far; the program `kinesphere tracks` does it for files.",
    ),
    Capability(
        "spheres placed without overlap",
        {"C++": "place_spheres", "Python": "place_spheres"},
        "Not asked for so far; `ks_world_overlapping_sphere` says whether a place is free.",
    ),
    Capability(
        "pairs by distance",
        {"C++": "radial_distribution", "Python": "radial_distribution"},
        "It is for fluids and packings, whose programs are in C++ and Python.",
    ),
    Capability(
        "boxes that grow or shrink",
        {"C++": "ExpandingBox", "Python": "ExpandingBox"},
        "It is for fluids and packings, whose programs are in C++ and Python.",
    ),
    Capability(
        "a search for defects",
        {"C++": "audit", "Python": "audit", "JavaScript": "audit"},
        "It is for bugs of the library, which a recording of the world shows too.",
    ),
    Capability(
        "certificates and cells to look at",
        {"C++": "certificates", "Python": "certificates", "JavaScript": "certificates"},
        "They are for pictures of how the library works.",
    ),
    Capability(
        "tracks that crowd a monitor",
        {"C++": "crowd", "Python": "crowd", "JavaScript": "crowd"},
        "Not asked for so far; `ks_monitor_open_pairs` has what it counts.",
    ),
    Capability(
        "built-in scenes",
        {"Python": "Scene", "JavaScript": "Scene"},
        "They are for the program and its pictures; in C++ they are no part of the library.",
    ),
    Capability(
        "worlds over several processes",
        {"C++": "DistributedWorld"},
        "They need MPI, which each language has in a library of its own.",
    ),
]

folders = {
    "C": ("include", "kinesphere.h"),
    "C++": ("include/kinesphere", "*.hpp"),
    "Rust": ("rust/src", "*.rs"),
    "C#": ("csharp/src", "*.cs"),
    "Python": ("python/kinesphere", "*.py*"),
    "JavaScript": ("browser/package/src", "*.ts"),
}


@lru_cache
def sources(language: str) -> str:
    """What people wrote, or can call."""
    folder, pattern = folders[language]
    files = sorted((repository / folder).rglob(pattern))
    # What a build makes of it is included as a header.
    files += [repository / "cmake/version.hpp.in"] if language == "C++" else []
    made = {"sys.rs", "Native.cs", "__pycache__"}
    return "\n".join(one.read_text() for one in files if one.name not in made and one.suffix != ".pyc")


# How a language declares what can be called; the words in what matches are names.
declared = {
    "C": r"ks_\w+(?=\()",
    "C++": r"\b(?:class|struct) \w+|\b\w+(?=\()|\b\w+(?=(?:\{\})?;)|\bconstexpr \S+ \w+",
    "Rust": r"\b(?:fn|struct|enum) \w+",
    "C#": r"\bpublic [^=;{(\n]*\w",
    "Python": r"\b(?:def|class) \w+|^\w+",
    "JavaScript": r"\b(?:class|interface|function) \w+|^\s+(?:static |get )*\w+(?=[(<])|\b\w+(?=\??:)",
}


@lru_cache
def declared_names(language: str) -> set[str]:
    found = re.findall(declared[language], sources(language), re.MULTILINE)
    return {name for one in found for name in re.findall(r"\w+", one)}


def require_named(language: str, call: str, what: str) -> None:
    for one in call.split(", "):
        parts = re.split(r"::|\.", one)
        name = parts[0] if parts[-1] == "new" else parts[-1]
        if name not in declared_names(language):
            raise HeaderError(
                f"docs/parity.md: {what}: {language} declares no {one}; interface/parity.py names it"
            )


@lru_cache
def public_functions(language: str) -> list[tuple[int, str]]:
    """The places of public functions, and their names."""
    public = {"Rust": r"pub fn (\w+)", "C#": r"public (?:static |override )*[\w<>\[\]?.]+ (\w+)"}[language]
    return [(found.start(), found[1]) for found in re.finditer(public, sources(language))]


def wrapper(function: Function, language: str) -> str | None:
    """The public function of Rust or C# that calls a function of C."""
    told = wrappers.get((function.name, language))
    if told:
        return told
    prefix = {"Rust": "sys::", "C#": r"Native\."}[language]
    called = re.search(rf"{prefix}{function.name}\b", sources(language))
    if not called:
        return None
    before = bisect.bisect([place for place, _ in public_functions(language)], called.start())
    return public_functions(language)[before - 1][1] if before else None


def usual_name(function: Function) -> str:
    return re.sub(r"^ks_(world_|game_|monitor_(?!event)|replay_|probe_)?", "", function.name)


def calls_of(function: Function) -> dict[str, str]:
    plain = usual_name(function)
    told = names.get(function.name, (plain, plain, lower_camel(plain)))
    calls = {"C": function.name, **dict(zip(("C++", "Python", "JavaScript"), told))}
    for language in ("Rust", "C#"):
        found = wrapper(function, language)
        if found:
            calls[language] = found
    return {one: name for one, name in calls.items() if (function.name, one) not in lacking}


def row(what: str, calls: dict[str, str], note: int | None) -> str:
    cells = [f"`{calls[one]}`" if one in calls else f"– ({note})" for one in languages]
    return "| " + " | ".join([*([what] if what else []), *cells]) + " |"


def checked(what: str, calls: dict[str, str]) -> dict[str, str]:
    for language, call in calls.items():
        if call != what:
            require_named(language, call, what)
    return calls


def page(interface: Interface, banner: str) -> str:
    """The text of parity.md."""
    reasons: list[str] = []

    def note(reason: str) -> int:
        if reason not in reasons:
            reasons.append(reason)
        return reasons.index(reason) + 1

    calls = ["| " + " | ".join(languages) + " |", "|" + "---|" * len(languages)]
    for function in interface.functions.values():
        if housekeeping.match(function.name):
            continue
        found = checked(function.name, calls_of(function))
        missing = [one for one in languages if one not in found]
        unexplained = [one for one in missing if (function.name, one) not in lacking]
        if unexplained:
            raise HeaderError(
                f"docs/parity.md: {function.name} is not in {', '.join(unexplained)}; interface/parity.py gives no reason"
            )
        calls.append(row("", found, note(lacking[function.name, missing[0]]) if missing else None))
    more = ["| what | " + " | ".join(languages) + " |", "|---|" + "---|" * len(languages)]
    for one in beyond:
        found = checked(one.what, one.calls)
        if len(found) < len(languages) and not one.reason:
            raise HeaderError(
                f"docs/parity.md: {one.what} is not in all languages; interface/parity.py gives no reason"
            )
        more.append(row(one.what, found, note(one.reason) if one.reason else None))
    lines = [
        f"<!-- {banner.replace('change the header, and run that', 'interface/parity.py has the names and reasons')} -->",
        "# One call in each language",
        "",
        "Each call has the meaning, the errors and about the cost that the C++ headers say. Calls that only C needs are",
        "left out: those for errors, for defaults, for names of kinds, and for the ends of objects.",
        "",
        *calls,
        "",
        "## What C lacks",
        "",
        *more,
        "",
        "## Why",
        "",
        *(f"{k}. {reason}" for k, reason in enumerate(reasons, 1)),
        "",
    ]
    return "\n".join(lines)
