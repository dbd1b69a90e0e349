"""Moving shapes: a lift with a probe, and the work of a piston."""

import numpy as np
import numpy.typing as npt
import pytest

import kinesphere as ks

inf = float("inf")


def test_a_lift_is_met_with_its_velocity() -> None:
    world = ks.World()
    plate = ks.Box((-1, -1, -0.5), (1, 1, 0))
    lift = world.add_moving_shape(plate, (0, 0, 0), (0, 0, 2), acceleration_limit=1.0, mass=inf)
    ball = world.add((0.5, 0, 4), (0, 0, -1), 0.5)
    assert world.shape_of(lift) == plate
    assert world.body(lift).radius == pytest.approx(1.5)

    def probe(
        ids: npt.NDArray[np.int64], t: float
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        positions = np.where(ids[:, None] == int(lift), (0, 0, 2 * t), (0.5, 0, 4 - t))
        velocities = np.where(ids[:, None] == int(lift), (0, 0, 2.0), (0, 0, -1.0))
        return positions, velocities

    event = next(iter(world.events(5.0, probe)))
    assert event.kind == ks.EventKind.contact_begin
    assert event.time == pytest.approx((4 - 0.5) / 3, abs=1e-5)
    assert event.approach_speed == pytest.approx(3)
    first, second = ks.bounce(event)
    assert second is not None
    assert first[2] == 2 and second[2] == pytest.approx(5), "the lift keeps its velocity"
    assert event.second == ball


def test_work_of_a_piston_is_the_gain_of_energy() -> None:
    rng = np.random.default_rng(45)
    count = 100
    positions = np.vstack([rng.uniform(0.2, 9.8, (count, 3)), [(5, 5, 10)]])
    velocities = np.vstack([rng.normal(size=(count, 3)), [(0, 0, -0.2)]])
    motion = ks.Ballistic(positions, velocities)
    world = ks.World(box=((0, 0, 0), (10, 10, 10)), contacts="impacts")
    bodies = ks.BodyMap()
    for number in range(count):
        bodies.add(world, motion, number, 0.1)
    piston = bodies.add_moving_shape(world, motion, count, ks.Box((-6, -6, 0), (6, 6, 1)), mass=inf)
    end = 20.0
    events = world.run(end, bodies, ks.Bouncing())
    hits = events[(events["first"] == int(piston)) | (events["second"] == int(piston))]
    work = 2 * 0.2 * hits["approach_speed"].sum()
    states, after = motion.states(end)
    gain = 0.5 * (np.square(after[:count]).sum() - np.square(velocities[:count]).sum())
    assert len(hits) > 20
    assert gain == pytest.approx(work, rel=1e-9)
    assert states[count][2] == pytest.approx(6)


def test_what_is_no_moving_shape_is_refused() -> None:
    world = ks.World()
    with pytest.raises(ks.StateError, match="add_moving_shape: shape must be a box, a triangle or a mesh"):
        world.add_moving_shape(ks.HalfSpace((0, 0, 1), 0), (0, 0, 0))
    with pytest.raises(ks.InvalidValue, match="acceleration_limit"):
        world.add_moving_shape(ks.Box((0, 0, 0), (1, 1, 1)), (0, 0, 0), acceleration_limit=-1)
    with pytest.raises(ks.InvalidValue, match="position"):
        world.add_moving_shape(ks.Box((0, 0, 0), (1, 1, 1)), (0, 0))
