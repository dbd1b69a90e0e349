"""Spheres at random places, without overlap."""

import itertools
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import kinesphere as ks

Doubles = npt.NDArray[np.float64]


def least_gap(centres: Doubles, radii: Doubles, size: Doubles, periodic: bool) -> float:
    apart = np.abs(centres[:, None] - centres[None])
    if periodic:
        apart = np.minimum(apart, size - apart)
    gaps = np.linalg.norm(apart, axis=2) - radii[:, None] - radii[None]
    return float(np.min(gaps[~np.eye(len(radii), dtype=bool)]))


@pytest.mark.parametrize("packing, periodic", itertools.product([0.1, 0.35, 0.55], [False, True]))
def test_spheres_do_not_overlap(packing: float, periodic: bool) -> None:
    radii = np.random.default_rng(1).uniform(0.3, 1, 400)
    size = np.full(3, (np.sum(4 / 3 * np.pi * radii**3) / packing) ** (1 / 3))
    centres = ks.place_spheres(radii, ((0, 0, 0), size), periodic=periodic, gap=1e-3)
    assert centres.shape == (400, 3) and centres.dtype == np.float64
    assert least_gap(centres, radii, size, periodic) > 0.999e-3
    margin = np.zeros((400, 1)) if periodic else radii[:, None]
    assert np.all(centres >= margin) and np.all(centres <= size - margin)


def test_discs_fill_a_periodic_plane_to_a_packing() -> None:
    size = np.array((30.0, 20.0))
    centres = ks.place_spheres(0.5, ((0, 0), size), periodic=True, packing=0.75, dimensions=2)
    radii = np.full(len(centres), 0.5)
    assert centres.shape == (int(0.75 * 600 / (np.pi / 4)), 2)
    assert least_gap(centres, radii, size, True) > 0
    world = ks.World(box=((0, 0), size), periodic=True, dimensions=2, allow_overlap=False)
    assert len(world.add(centres, radii=radii)) == len(centres)


def test_a_seed_gives_the_same_places() -> None:
    first, same, other = (
        ks.place_spheres([1.0, 0.5], ((0, 0, 0), (20, 20, 20)), packing=0.3, seed=seed) for seed in (1, 1, 2)
    )
    assert np.array_equal(first, same) and not np.array_equal(first, other)


def test_what_cannot_be_placed_is_refused() -> None:
    box = ((0, 0, 0), (10, 10, 10))
    cases: dict[str, dict[str, Any]] = {
        "radii": {"radii": [1.0, -1.0]}, "box": {"box": None}, "periodic": {"periodic": "w"}, "packing": {"packing": 1.0},
        "gap": {"gap": -1.0}, "dimensions": {"dimensions": 4},
    }  # fmt: skip
    for culprit, wrong in cases.items():
        arguments: dict[str, Any] = {"radii": 1.0, "box": box, **wrong}
        with pytest.raises(ks.InvalidValue, match=f"place_spheres: {culprit}") as refused:
            ks.place_spheres(**arguments)
        assert refused.value.argument == culprit
    with pytest.raises(ks.InvalidValue, match="no arrangement without overlap was found of 1394 spheres"):
        ks.place_spheres(0.5, box, periodic=True, packing=0.73)
    with pytest.raises(ks.InvalidValue, match="xy"):
        ks.place_spheres(1.0, ((0, 0), (9, 9)), periodic="xyz", dimensions=2)
