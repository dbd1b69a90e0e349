"""What going through Python costs, measured against the program `kinesphere`: python -m kinesphere.bench
[--program PATH]

Each scene is run by the program, by World.run() with the ready-made motion, and by World.run() with a MotionSource
that is a function of NumPy's arrays. They take turns. Times are medians, without making the scene; hashes
of what was computed are compared.
"""

from __future__ import annotations

import argparse
import re
import shutil
import statistics
import subprocess
import sys
import time
from typing import Any

from . import EventHash, MotionSource, Scene, World, __version__

_scenes = [("paper1", 0.05, 1.0), ("gas", 0.05, 2.0), ("rain", 0.05, 1.0)]
"""Name, packing, seconds. In those that fly freely a probe is two lines of NumPy."""
_gravity = {"gas": (0.0, 0.0, 0.0), "rain": (0.0, 0.0, -9.81)}


def _by_program(program: str, name: str, bodies: int, packing: float, seconds: float) -> tuple[float, str]:
    arguments = ["--bodies", str(bodies), "--packing", str(packing), "--seconds", str(seconds)]
    command = [program, "run", name, *arguments]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    spent = re.search(r"^real time +([\d.,e+-]+) s", printed, re.MULTILINE)
    hash = re.search(r"^hash +(\w+)", printed, re.MULTILINE)
    if spent is None or hash is None:
        raise RuntimeError(f"{' '.join(command)}: there is no time or hash in what it prints:\n{printed}")
    return float(spent[1].replace(",", "")), hash[1]


def _by_run(scene: Scene, world: World, motion: Any) -> tuple[float, str]:
    start = time.perf_counter()
    events = world.run(scene.end_time, motion, scene)
    return time.perf_counter() - start, str(EventHash().add(events))


def _by_motion(scene: Scene) -> tuple[float, str]:
    world, motion = World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    return _by_run(scene, world, motion)


def _by_mover(scene: Scene) -> tuple[float, str]:
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
    mover = MotionSource(falling if gz != 0.0 else straight, start["positions"], start["velocities"])
    return _by_run(scene, world, mover)


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
    print(f"{'scene':8} {'program':>9} {'motion':>9} {'ratio':>6} {'NumPy':>9} {'ratio':>6}  hash")
    same = True
    for name, packing, seconds in _scenes:
        scene = Scene(name, bodies=options.bodies, packing=packing, seconds=seconds)
        times: dict[str, list[float]] = {"program": [], "motion": [], "mover": []}
        hashes = set()
        for _ in range(options.repeats):
            runs = {
                "program": _by_program(options.program, name, options.bodies, packing, seconds),
                "motion": _by_motion(scene),
            }
            if name in _gravity:
                runs["mover"] = _by_mover(scene)
            for way, (spent, hash) in runs.items():
                times[way].append(spent)
                hashes.add(hash)
        program, motion = statistics.median(times["program"]), statistics.median(times["motion"])
        line = f"{name:8} {program:7.3f} s {motion:7.3f} s {motion / program:6.2f}"
        if times["mover"]:
            mover = statistics.median(times["mover"])
            line += f" {mover:7.3f} s {mover / program:6.2f}"
        else:
            line += f" {'':9} {'':6}"
        same = same and len(hashes) == 1
        print(f"{line}  {' and '.join(sorted(hashes))}{'' if len(hashes) == 1 else ': THEY DIFFER'}")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
