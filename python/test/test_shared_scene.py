"""The scene that programs in all languages run (tests/same_hash/shared_scene.cpp) has one hash."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import hash_of

import kinesphere as ks


def numbers() -> Iterator[float]:
    state = 1
    while True:
        state = state * 16807 % 2147483647
        yield state / 2147483647


@pytest.mark.parametrize("threads", [1, 2])
def test_the_scene_of_all_languages_has_one_hash(threads: int) -> None:
    random = numbers()
    drawn = [[next(random) for _ in range(4)] for _ in range(64)]
    radii = [0.5 + first for first, *_ in drawn]
    velocities = [[20 * (number - 0.5) for number in others] for _, *others in drawn]
    positions = [[2.5 + 5 * (k % 4), 2.5 + 5 * (k // 4 % 4), 2.5 + 5 * (k // 16)] for k in range(64)]
    motion = ks.RandomForces(np.array(positions), np.array(velocities), 5.0, interval=0.2, seed=7)
    world = ks.World(box=((0, 0, 0), (20, 20, 20)))
    world.set_sensor(0, [0.5])
    world.add_motion(motion, radii, masses=radii)
    world.add_zone(ks.Box((5, 5, 5), (15, 15, 15)))
    hashed = hash_of(world.run(5.0, motion, ks.Bouncing(restitution=0.9), threads=threads))
    file = Path(__file__).parents[2] / "tests" / "same_hash" / "shared_scene.txt"
    assert hashed == file.read_text().strip()
