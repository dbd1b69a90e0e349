"""Arrays in and out: every kind that NumPy has, and what is refused."""

import array
from typing import Any

import numpy as np
import pytest
from conftest import pair, straight

import kinesphere as ks

rng = np.random.default_rng(3)
positions = rng.uniform(-50, 50, (20, 3))
velocities = rng.uniform(-5, 5, (20, 3))


def events_with(given_positions: Any, given_velocities: Any = velocities, **more: Any) -> str:
    world = ks.World()
    ids = world.add(given_positions, given_velocities, radii=4.0, **more)
    assert ids.dtype == np.int64 and ids.tolist() == list(range(20))
    return str(ks.EventHash().add(world.run(20.0, straight(positions, velocities))))


expected = events_with(positions)


def read_only(values: Any) -> Any:
    copy = values.copy()
    copy.flags.writeable = False
    return copy


@pytest.mark.parametrize(
    "variant",
    [
        lambda a: a.tolist(),
        lambda a: [tuple(row) for row in a],
        lambda a: np.asfortranarray(a),
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: np.ascontiguousarray(a[::-1])[::-1],
        lambda a: np.hstack([a, a])[:, :3],
        lambda a: np.ascontiguousarray(a.T).T,
        read_only,
        lambda a: a.astype(">f8"),
        lambda a: a.astype(np.longdouble),
        lambda a: np.ascontiguousarray(a).data,
    ],
    ids=["list", "tuples", "fortran", "strided", "backwards", "columns", "transposed", "read-only", "big-endian",
         "longdouble", "memoryview"],
)  # fmt: skip
def test_equal_numbers_give_equal_events(variant: Any) -> None:
    assert events_with(variant(positions), variant(velocities)) == expected


def test_float32_and_whole_numbers_are_taken() -> None:
    single = positions.astype(np.float32)
    variants: list[Any] = [single, single.astype(np.float64)]
    for variant in variants:
        world = ks.World()
        world.add(variant)
        assert np.array_equal(world.bounds()[0], single.astype(np.float64))
    world = ks.World()
    world.add(np.arange(6).reshape(2, 3), radii=np.array([1, 2], dtype=np.uint8))
    assert world.body(1).position.tolist() == [3.0, 4.0, 5.0] and world.body(1).radius == 2.0


def test_a_structured_field_is_an_array_like_any_other() -> None:
    table = np.zeros(20, dtype=[("name", "i4"), ("at", "3f8")])
    table["at"] = positions
    assert events_with(table["at"]) == expected


def test_an_array_of_the_standard_library_is_a_buffer() -> None:
    world = ks.World()
    world.add([[0, 0, 0], [5, 0, 0]], radii=array.array("d", [1.0, 2.0]))
    assert world.body(1).radius == 2.0


@pytest.mark.parametrize("kind", [complex, object, str, "datetime64[s]", bool])
def test_what_is_no_real_number_is_refused(kind: Any) -> None:
    with pytest.raises(TypeError, match="add: positions must be real numbers"):
        ks.World().add(np.ones((2, 3)).astype("i8").astype(kind))


def test_masked_entries_are_refused() -> None:
    ma: Any = np.ma  # its functions have no types
    masked = ma.masked_array(positions.copy(), mask=np.zeros(positions.shape, dtype=bool))
    assert events_with(masked) == expected
    masked[3, 1] = ma.masked
    refusal = "must be .*numbers, but has masked entries"
    with pytest.raises(TypeError, match=f"add: positions {refusal}"):
        ks.World().add(masked)
    with pytest.raises(TypeError, match=f"radii {refusal}"):
        ks.World().add(positions, radii=ma.masked_less(np.arange(20.0), 1))
    with pytest.raises(TypeError, match=f"x {refusal}"):
        ks.tracks([0, 1, 0, 1], ma.masked_equal([0.0, 1, 2, 3], 2), np.zeros(4), None, [1, 1, 2, 2], 1.0)
    with pytest.raises(ks.InvalidValue, match=f"errors {refusal}"):
        ks.PolynomialPaths([0], [0], [1], np.zeros((1, 3, 2)), errors=ma.masked_equal([0.0], 0))


@pytest.mark.parametrize("shape", [(3, 2), (2, 4), (3, 3, 3), (), (6,), (3, 1), (0, 5)])
def test_wrong_shapes_name_argument_and_shape(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"add: positions must have shape .* but has shape \(") as caught:
        ks.World().add(np.zeros(shape))
    assert isinstance(caught.value, ks.InvalidValue)
    assert (caught.value.code, caught.value.argument) == ("out_of_range", "positions")


def test_arrays_that_do_not_fit_each_other_are_refused() -> None:
    world = ks.World()
    with pytest.raises(
        ks.InvalidValue, match=r"velocities must have shape \(n, 3\) with n = 20, but has shape \(19, 3\)"
    ):
        world.add(positions, velocities[:19])
    with pytest.raises(ks.InvalidValue, match=r"radii must be one number, or one for each of 20 bodies"):
        world.add(positions, radii=[1.0, 2.0])
    with pytest.raises(TypeError, match="NumPy says"):
        world.add([[1, 2, 3], [1, 2]])
    assert len(world) == 0


def test_nothing_is_a_fine_array() -> None:
    world = ks.World()
    assert world.add(np.zeros((0, 3))).shape == (0,)
    assert world.add([]).shape == (0,)
    assert len(world.run(1.0, ks.Ballistic([]))) == 0


def test_an_error_names_the_body_and_adds_none() -> None:
    world = ks.World()
    radii = np.ones(20)
    radii[7] = -1
    with pytest.raises(ks.InvalidValue, match="radius") as caught:
        world.add(positions, radii=radii)
    assert caught.value.argument == "radius" and len(world) == 0
    places = positions.copy()
    places[11, 1] = np.nan
    with pytest.raises(ks.InvalidValue, match="^add: body 11: position must be") as caught:
        world.add(places)
    assert caught.value.code == "not_finite" and len(world) == 0


def test_a_single_body_has_a_single_id() -> None:
    world = ks.World()
    ball = world.add((1.0, 2.0, 3.0), radii=0.5)
    assert isinstance(ball, ks.BodyId) and ball == 0 and ball in world
    assert world.add(np.array([9, 9, 9])) == 1
    world.set_velocity(ball, (1, 0, 0))
    world.set_velocity(ball, np.array([1.0, 0.0, 0.0], dtype=np.float32))
    assert positions[ball].shape == (3,)


def test_two_columns_are_the_plane() -> None:
    world = ks.World(dimensions=2)
    world.add(positions[:, :2], velocities[:, :2])
    assert world.body(0).position.tolist() == [positions[0, 0], positions[0, 1], 0.0]
    events = world.run(
        5.0, lambda ids, t: (positions[ids, :2] + t * velocities[ids, :2], velocities[ids, :2])
    )
    assert np.all(events["point"][:, 2] == 0)
    with pytest.raises(ks.InvalidValue, match=r"\(n, 3\), but has shape \(20, 2\)"):
        ks.World().add(positions[:, :2])


def test_what_comes_out_belongs_to_the_caller() -> None:
    world, motion = pair()
    places, speeds = motion.states(0.0)
    places += 100
    assert motion.states(0.0)[0][0, 0] == 0.0
    events = world.run(4.5, motion)
    events.array["time"] = -1
    assert events[0].time == -1.0
    normal = events[0].normal
    with pytest.raises(ValueError):
        normal[0] = 5


def test_one_plan_for_all_or_one_of_each() -> None:
    world = ks.World()
    world.add(positions, planned_accelerations=(0, 0, -9.81))
    world.add(positions + 200, planned_accelerations=velocities)
    assert world.body(3).planned_acceleration.tolist() == [0, 0, -9.81]
    assert np.array_equal(world.body(23).planned_acceleration, velocities[3])
