"""A KD-tree per frame, a NumPy loop over all pairs, and Kinesphere, side by side: time, and what each misses.

Small fast spheres fly straight through each other; the truth is computed for every pair from the exact
roots.
Usage: side_by_side.py [bodies]
"""

import sys
import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

import kinesphere as ks

Pairs = set[tuple[int, int]]
Doubles = npt.NDArray[np.float64]
count, radius, duration = int(sys.argv[1]) if len(sys.argv) > 1 else 1000, 0.5, 2.0
rng = np.random.default_rng(2)
positions, velocities = rng.uniform(0, 100, (count, 3)), rng.normal(0, 30, (count, 3))


def at(t: float) -> Doubles:
    return positions + velocities * t


def kd_tree(rate: int) -> Pairs:
    found: Pairs = set()
    for frame in range(int(duration * rate) + 1):
        found |= cKDTree(at(frame / rate)).query_pairs(2 * radius)
    return found


def numpy_loop(rate: int) -> Pairs:
    found: Pairs = set()
    for frame in range(int(duration * rate) + 1):
        here = at(frame / rate)
        squares = np.sum(here**2, axis=1)
        apart = squares[:, None] + squares[None, :] - 2 * here @ here.T
        first, second = np.nonzero(np.triu(apart <= (2 * radius) ** 2, 1))
        found |= set(zip(first.tolist(), second.tolist()))
    return found


def kinesphere() -> Pairs:
    world, motion = ks.World(), ks.Ballistic(positions, velocities)
    world.add_motion(motion, radius)
    begins = world.run(duration, motion).of_kind(ks.EventKind.contact_begin)
    return set(zip(begins["first"].tolist(), begins["second"].tolist()))


def kinesphere_with_numpy_probe() -> Pairs:
    world = ks.World()
    world.add(positions, velocities, radius)
    begins = world.run(duration, lambda ids, t: (positions[ids] + velocities[ids] * t, velocities[ids]))
    return set(
        zip(*(begins.of_kind(ks.EventKind.contact_begin)[end].tolist() for end in ("first", "second")))
    )


def truth() -> Pairs:
    """Every pair whose least distance in [0, duration] is at most two radii."""
    found: Pairs = set()
    for a in range(count - 1):
        p, v = positions[a + 1 :] - positions[a], velocities[a + 1 :] - velocities[a]
        t = np.clip(-np.sum(p * v, axis=1) / np.sum(v * v, axis=1), 0, duration)
        near = np.sum((p + v * t[:, None]) ** 2, axis=1) <= (2 * radius) ** 2
        found |= {(a, a + 1 + int(b)) for b in np.flatnonzero(near)}
    return found


ways: list[tuple[str, Callable[[], Pairs]]] = [
    ("cKDTree, 60 frames a second", lambda: kd_tree(60)),
    ("cKDTree, 240 frames a second", lambda: kd_tree(240)),
    ("NumPy, all pairs, 60 frames", lambda: numpy_loop(60)),
    ("Kinesphere", kinesphere),
    ("Kinesphere, NumPy probe", kinesphere_with_numpy_probe),
]
true_pairs = truth()
print(f"{count} spheres of radius {radius} for {duration} s: {len(true_pairs)} pairs touch")
print(f"{'':30} {'seconds':>8} {'missed':>7} {'invented':>9}")
for name, find in ways:
    start = time.perf_counter()
    found = find()
    spent = time.perf_counter() - start
    missed, invented = len(true_pairs - found), len(found - true_pairs)
    print(f"{name:30} {spent:8.3f} {missed:7} {invented:9}")
    if name.startswith("Kinesphere"):
        assert missed == 0
