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


def shrinking(flow: str, positions: Any, velocities: Any, radii: Any, duration: float) -> ks.Events:
    """Contacts, without a response, in a box of ten by ten by ten that shrinks."""
    box = ks.ExpandingBox(rate=-0.05, flow=flow, start_time=3.0)  # type: ignore[arg-type]
    world = ks.World(box=((0, 0, 0), (10, 10, 10)), periodic=True, contacts="impacts")
    motion = ks.Ballistic(*box.seen(positions, velocities, 3.0))
    world.set_radius_rate(world.add_motion(motion, radii=radii), box.radius_rates(radii))
    return box.real_events(world.run(box.clock(3.0 + duration), motion, ks.Bouncing()))


def test_a_box_shrinks_around_balls_at_rest() -> None:
    # 2 apart across the border, of which the radii take 1: the box has lost that when it has 9.
    at, rest = [[1, 5, 5], [9, 5, 5]], np.zeros((2, 3))
    event = shrinking("free", at, rest, [0.5, 0.5], 3.0)[0]
    assert event.time == pytest.approx(5.0, abs=1e-5)
    assert event.approach_speed == pytest.approx(0.5)  # as the box shrinks
    assert np.linalg.norm(event.second_position - event.first_position) == pytest.approx(1.0, abs=1e-5)
    # It carries them along: what is 2 across the border is 1 at half of the scale.
    event = shrinking("carried", at, rest, [0.5, 0.5], 15.0)[0]
    assert event.time == pytest.approx(3.0 + np.log(2.0) / 0.05, abs=1e-4)
    assert event.approach_speed == pytest.approx(0.05)


def test_states_in_a_box_that_grows_come_back() -> None:
    rng = np.random.default_rng(3)
    positions, velocities = rng.normal(size=(5, 3)), rng.normal(size=(5, 3))
    for flow in ("free", "carried"):
        box = ks.ExpandingBox(rate=0.3, flow=flow)  # type: ignore[arg-type]
        clock = box.clock(2.0)
        assert box.time(clock) == pytest.approx(2.0) and box.scale_at(clock) == pytest.approx(
            float(box.scale(2.0))
        )
        back = box.real(*box.seen(positions, velocities, 2.0), clock)
        np.testing.assert_allclose(back, [positions, velocities])
    assert ks.ExpandingBox(rate=0.1).time(10.0) == np.inf and ks.ExpandingBox(rate=-0.1).clock(10.0) == np.inf


def test_boxes_that_change_in_no_known_way_are_refused() -> None:
    with pytest.raises(ks.InvalidValue, match="rate must be finite, but is nan"):
        ks.ExpandingBox(rate=np.nan)
    with pytest.raises(ks.InvalidValue, match="flow must be 'free' or 'carried', but is 'shear'"):
        ks.ExpandingBox(rate=0.1, flow="shear")  # type: ignore[arg-type]
