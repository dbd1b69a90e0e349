"""What going through Python costs, measured against the program `kinesphere`: python -m kinesphere.bench
[--program PATH]

Each scene is run by the program, by World.run() with the ready-made motion, and by World.run() with a MotionSource
that is a function of NumPy's arrays. They take turns. Times are medians: real seconds of the run alone, and user
seconds of all that is done, with making the scene; hashes of what was computed are compared.
"""

from __future__ import annotations

import argparse
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

from . import EventHash, MotionSource, Scene, World, __version__

_scenes = [("paper1", 0.05, 1.0), ("gas", 0.05, 2.0), ("rain", 0.05, 1.0)]
"""Name, packing, seconds. In those that fly freely a probe is two lines of NumPy."""
_gravity = {"gas": (0.0, 0.0, 0.0), "rain": (0.0, 0.0, -9.81)}
_clocks = {"real": "real seconds of the run", "user": "user seconds, with making the scene"}

# Seconds by clock, and the hash.
Measured = tuple[dict[str, float], str]


def _by_program(program: str, name: str, bodies: int, packing: float, seconds: float) -> Measured:
    arguments = ["--bodies", str(bodies), "--packing", str(packing), "--seconds", str(seconds)]
    command = [program, "run", name, *arguments]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    user = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    spent = re.search(r"^real time +([\d.,e+-]+) s", printed, re.MULTILINE)
    hash = re.search(r"^hash +(\w+)", printed, re.MULTILINE)
    if spent is None or hash is None:
        raise RuntimeError(f"{' '.join(command)}: there is no time or hash in what it prints:\n{printed}")
    return {"real": float(spent[1].replace(",", "")), "user": user}, hash[1]


def _by_python(
    set_up: Callable[[Scene], tuple[World, Any]], name: str, bodies: int, packing: float, seconds: float
) -> Measured:
    before = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    scene = Scene(name, bodies=bodies, packing=packing, seconds=seconds)
    world, motion = set_up(scene)
    start = time.perf_counter()
    events = world.run(scene.end_time, motion, scene)
    real = time.perf_counter() - start
    hash = str(EventHash().add(events))
    user = resource.getrusage(resource.RUSAGE_SELF).ru_utime - before
    return {"real": real, "user": user}, hash


def _with_motion(scene: Scene) -> tuple[World, Any]:
    world, motion = World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    return world, motion


def _with_mover(scene: Scene) -> tuple[World, Any]:
    gx, gy, gz = _gravity[scene.name]
    start = scene.motion().definitions(0.0)

    def straight(ids: Any, t: float, since: Any, positions: Any, velocities: Any) -> tuple[Any, Any]:
        return positions + velocities * (t - since), velocities

    def falling(ids: Any, t: float, since: Any, positions: Any, velocities: Any) -> tuple[Any, Any]:
        flown = t - since
        return positions + (velocities + plan * (0.5 * flown)) * flown, velocities + plan * flown

    plan = start["planned_accelerations"][0]
    assert plan.tolist() == [gx, gy, gz]
    world = World(**scene.definition)
    world.add(**start, radii=scene.radii)
    return world, MotionSource(falling if gz != 0.0 else straight, start["positions"], start["velocities"])


def _print_line(clock: str, name: str, times: dict[str, list[dict[str, float]]], hashes: set[str]) -> None:
    medians = {way: statistics.median(one[clock] for one in all) for way, all in times.items()}
    line = f"{name:8} {medians['program']:7.3f} s"
    for way in ("motion", "mover"):
        if way in medians:
            line += f" {medians[way]:7.3f} s {medians[way] / medians['program']:6.2f}"
        else:
            line += f" {'':9} {'':6}"
    print(f"{line}  {' and '.join(sorted(hashes))}{'' if len(hashes) == 1 else ': THEY DIFFER'}")


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m kinesphere.bench", description=__doc__)
    parser.add_argument(
        "--program", default=shutil.which("kinesphere"), help="the program; default: the one in PATH"
    )
    parser.add_argument("--bodies", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    if options.program is None:
        print(
            "bench: there is no program `kinesphere` in PATH, so --program must say where it is",
            file=sys.stderr,
        )
        return 2

    print(f"kinesphere {__version__}, {options.bodies} bodies, medians of {options.repeats}")
    measured: dict[str, tuple[dict[str, list[dict[str, float]]], set[str]]] = {}
    for name, packing, seconds in _scenes:
        arguments = (name, options.bodies, packing, seconds)
        times: dict[str, list[dict[str, float]]] = {}
        hashes = set()
        for _ in range(options.repeats):
            runs = {
                "program": _by_program(options.program, *arguments),
                "motion": _by_python(_with_motion, *arguments),
            }
            if name in _gravity:
                runs["mover"] = _by_python(_with_mover, *arguments)
            for way, (spent, hash) in runs.items():
                times.setdefault(way, []).append(spent)
                hashes.add(hash)
        measured[name] = times, hashes
    for clock, what in _clocks.items():
        print(f"{what}:")
        print(f"{'scene':8} {'program':>9} {'motion':>9} {'ratio':>6} {'NumPy':>9} {'ratio':>6}  hash")
        for name, (times, hashes) in measured.items():
            _print_line(clock, name, times, hashes)
    return 0 if all(len(hashes) == 1 for _, hashes in measured.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
