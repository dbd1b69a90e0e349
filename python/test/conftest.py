"""What several tests start from."""

import os
import subprocess
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np
import numpy.typing as npt
import pytest

import kinesphere as ks

Doubles = npt.NDArray[np.float64]
Ids = npt.NDArray[np.int64]
Probe = Callable[[Ids, float], tuple[Doubles, Doubles]]


def pair(**settings: Any) -> tuple[ks.World, ks.Ballistic]:
    """Two spheres of radius 1 that meet head-on at time 4: one flies at speed 2, one stands 10 away."""
    motion = ks.Ballistic([(0, 0, 0), (10, 0, 0)], [(2, 0, 0), (0, 0, 0)])
    world = ks.World(**settings)
    world.add_motion(motion, radii=1.0)
    return world, motion


def straight(positions: Doubles, velocities: Doubles) -> Probe:
    """The probe of bodies that fly straight on from time 0."""

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        return positions[ids] + velocities[ids] * t, velocities[ids]

    return probe


def hash_of(events: ks.Events) -> str:
    return str(ks.EventHash().add(events))


def data_file(*names: str) -> Path:
    """A file of the recorded data, which the project does not contain; without it the test is skipped."""
    root = Path(os.environ.get("KINESPHERE_DATA", Path(__file__).parents[2] / ".." / "shared" / "data"))
    file = root.joinpath(*names)
    if not file.exists():
        pytest.skip(f"there is no {file}")
    return file


def native(*arguments: str) -> Optional[str]:
    """What the program `kinesphere` prints; None where the environment does not say where it is."""
    program = os.environ.get("KINESPHERE_PROGRAM")
    if not program:
        return None
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout.strip()
