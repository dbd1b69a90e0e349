"""The scene and the game that programs in all languages run (tests/same_hash/shared_scene.cpp) have one hash each."""

import itertools
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


expected = (Path(__file__).parents[2] / "tests" / "same_hash" / "shared_scene.txt").read_text().split()


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
    assert hashed == expected[0]


def test_the_game_of_all_languages_has_one_hash() -> None:
    random = itertools.islice(numbers(), 4 * 64, None)  # behind those of the scene
    game = ks.GameWorld((0, 0, -9.81), ks.Bouncing(restitution=0.9), box=((0, 0, 0), (10, 10, 10)))
    game.add_static(ks.Box((4, 4, 0), (6, 6, 1)))
    for k in range(27):
        radius = 0.3 + 0.5 * next(random)
        velocity = [10 * (next(random) - 0.5) for _ in range(3)]
        game.add((2 + 3 * (k % 3), 2 + 3 * (k // 3 % 3), 2 + 3 * (k // 9)), velocity, radius, masses=radius)
    hashed = ks.EventHash()
    for frame in range(128):
        if frame % 16 == 0:
            game.set_velocities(game.velocities[:, [1, 2, 0]])
        if frame == 32:
            game.remove(game.ids[3])
        if frame == 64:
            game.add((5, 5, 9.5), radii=0.25)
        if frame == 96:
            game.set_acceleration(game.ids[0], (0, 0, 20))
        hashed.add(game.step(0.015625))
    assert str(hashed) == expected[1]
