"""Rigid bodies: a gas of dumbbells, rotations by a function, and wrong use."""

import copy
import pickle
from typing import Any, Callable

import numpy as np
import numpy.typing as npt
import pytest
from conftest import hash_of, straight

import kinesphere as ks

Doubles = npt.NDArray[np.float64]
Ids = npt.NDArray[np.int64]
half, radius = 0.5, 0.3
dumbbell = [ks.Ball((-half, 0, 0), radius), ks.Ball((half, 0, 0), radius)]
inertia = np.array((0, half**2, half**2))  # two masses of 1/2, half apart


def gas_of(side: int) -> tuple[ks.World, ks.Ballistic, ks.BodyMap]:
    """Dumbbells with random orientations, all of whose energy is in the flight."""
    rng = np.random.default_rng(7)
    places = 2.5 * (np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5)
    speeds, turns = rng.normal(size=places.shape), rng.normal(size=(len(places), 4))
    speeds /= np.linalg.norm(speeds, axis=1)[:, None]
    motion, bodies = ks.Ballistic(places, speeds), ks.BodyMap()
    world = ks.World(box=((0, 0, 0), (2.5 * side,) * 3))
    for number, turn in enumerate(turns):
        orientation = turn / np.linalg.norm(turn)
        bodies.add_rigid_body(world, motion, number, dumbbell, orientation=orientation, inertia=inertia)
    return world, motion, bodies


def energies(world: ks.World, motion: ks.Ballistic) -> tuple[float, float]:
    """Of flight and of rotation."""
    spins = world.rotations(world.bodies())[1]
    flight = 0.5 * np.square(motion.states(world.time)[1]).sum()
    return float(flight), float(0.5 * half**2 * np.square(spins).sum())


def answer(event: ks.Event) -> Any:
    begins = event.kind in (ks.EventKind.contact_begin, ks.EventKind.wall_begin)
    return ks.bounce_rigid(event) if begins and event.approach_speed > 0 else None


def test_a_gas_of_dumbbells_keeps_its_energy_and_shares_it() -> None:
    world, motion, bodies = gas_of(4)
    before = sum(energies(world, motion))
    shares = []
    # The mean of so many samples deviates by 0.004: rounding of the start alone makes another course.
    while world.time < 600:
        world.run(world.time + 1, bodies, ks.Bouncing())
        flight, rotation = energies(world, motion)
        assert flight + rotation == pytest.approx(before, rel=1e-12)
        shares.append(flight / before)
    # Equipartition: three directions of flight, two axes of rotation.
    assert np.mean(shares[10:]) == pytest.approx(0.6, abs=0.03)


def test_a_function_and_a_loop_bounce_as_bouncing_does() -> None:
    world, motion, bodies = gas_of(2)
    others = copy.deepcopy((world, motion, bodies))
    again = pickle.loads(pickle.dumps((world, motion, bodies)))
    ready = world.run(5.0, bodies, ks.Bouncing())
    assert hash_of(others[0].run(5.0, others[2], answer)) == hash_of(ready)
    looped = []
    for event in again[0].events(5.0, again[2]):
        looped.append(event)
        for body, turned in zip((event.first, event.second), answer(event) or ()):
            if turned[0] is not None:
                again[2].set_velocity(again[0], body, turned[0])
            if turned[1] is not None:
                again[0].set_angular_velocity(body, turned[1])
    assert hash_of(ks.Events(looped)) == hash_of(ready)
    assert set(ready["first_part"].tolist()) == {0, 1} and np.any(ready["first_spin_gain"] != 0)
    assert set(ready.of_kind(ks.EventKind.contact_begin)["second_part"].tolist()) == {0, 1}
    # A unit impulse along the normal turns a dumbbell about an axis across both.
    spin = ready["first_spin_gain"]
    assert np.abs(np.sum(spin * ready["normal"], axis=1)).max() < 1e-12
    for name in ("first_part", "second_angular_velocity", "second_spin_gain"):
        assert np.array_equal(getattr(ready[9], name), ready[name][9])


def test_bodies_that_contacts_do_not_turn_get_velocities_alone() -> None:
    world = ks.World(box=((0, 0, 0), (10, 10, 10)))
    world.add((8.0, 5, 5), (1, 0, 0))
    event = world.advance(5.0, straight(np.array([(8.0, 5, 5)]), np.array([(1.0, 0, 0)])))
    assert event is not None and event.first_part == 0 and not event.first_spin_gain.any()
    (velocity, spin), wall = ks.bounce_rigid(event, 0.5)
    assert np.array_equal(velocity, (-0.5, 0, 0)) and spin is None and wall == (None, None)  # type: ignore[arg-type]


def door(rotation: Callable[[Ids, float], Any]) -> tuple[ks.World, Callable[[], ks.Event | None]]:
    """A rod of length 4 that turns about one end, towards a ball that stands two away from there."""
    world = ks.World(contact_tolerance=1e-9)
    world.add_rigid_body(
        [ks.Capsule((0, 0, 0), (4, 0, 0), 0.1)], (0, 0, 0), angular_velocity=(0, 0, 1),
        angular_acceleration_limit=1.0, largest_angular_speed=2.0,
    )  # fmt: skip
    world.add((0, 2.0, 0), radii=0.1)
    world.set_rotation_probe(rotation)
    probe = straight(np.array([(0, 0, 0), (0, 2.0, 0)]), np.zeros((2, 3)))
    return world, lambda: world.advance(3.0, probe)


def turning(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
    assert ids.tolist() == [0]
    return np.array([(np.cos(t / 2), 0, 0, np.sin(t / 2))]), np.array([(0.0, 0, 1)])


def test_a_function_turns_a_body() -> None:
    world, go_on = door(turning)
    event = go_on()
    assert event is not None and event.kind == ks.EventKind.contact_begin
    assert event.time == pytest.approx(np.pi / 2 - np.arcsin(0.1), abs=1e-7)
    assert event.approach_speed == pytest.approx(np.sqrt(2**2 - 0.2**2), abs=1e-6)
    orientation, spin = world.rotations(0)
    assert orientation.shape == (4,) and np.allclose(orientation, turning(np.array([0]), event.time)[0][0])
    assert np.array_equal(spin, (0, 0, 1)) and world.rotations([0])[0].shape == (1, 4)
    assert world.parts_of(0) == [ks.Capsule((0, 0, 0), (4, 0, 0), 0.1)]
    assert world.clone().advance(1.6, straight(np.array([(0, 0, 0), (0, 2.0, 0)]), np.zeros((2, 3)))) is None
    with pytest.raises(TypeError, match="a world with a rotation probe cannot be pickled"):
        pickle.dumps(world)
    world.set_rotation(0, (1, 0, 0, 0), (0, 0, 0.5))
    assert np.array_equal(world.rotations(0)[0], (1, 0, 0, 0))
    world.set_rotation_probe(None)
    assert go_on().kind == ks.EventKind.contact_end  # type: ignore[union-attr]
    with pytest.raises(ks.KinesphereError, match="set_rotation_probe"):
        go_on()


def test_what_a_rotation_probe_raises_comes_out_and_the_call_can_be_repeated() -> None:
    broken: list[Any] = [KeyError("no rotation")]

    def rotation(ids: Ids, t: float) -> Any:
        if not broken:
            return turning(ids, t)
        wrong = broken.pop()
        if isinstance(wrong, Exception):
            raise wrong
        return wrong

    world, go_on = door(rotation)
    with pytest.raises(KeyError, match="no rotation"):
        go_on()
    for wrong, message in [
        (None, "rotation probe: function must return"),
        ((np.zeros((1, 3)), np.zeros((1, 3))), r"rotation probe: orientations must have shape \(n, 4\) with n = 1"),
        (([(1, 0, 0, 0)], np.zeros((2, 3))), r"rotation probe: angular_velocities must have shape \(n, 3\) with n = 1"),
        (([(2, 0, 0, 0)], np.zeros((1, 3))), "orientation,? must have length 1"),
    ]:  # fmt: skip
        broken.append(wrong)
        with pytest.raises(ks.InvalidValue, match=message):
            go_on()
    event = go_on()
    assert event is not None and event.time == pytest.approx(np.pi / 2 - np.arcsin(0.1), abs=1e-7)
    broken.append(KeyError("in a run"))
    with pytest.raises(KeyError, match="in a run"):
        world.run(3.0, straight(np.array([(0, 0, 0), (0, 2.0, 0)]), np.zeros((2, 3))))


def test_wrong_use_is_refused() -> None:
    world = ks.World()
    wrong: list[tuple[dict[str, Any], type[Exception], str]] = [
        (dict(parts=[]), ks.InvalidValue, "add_rigid_body: parts must have at least one"),
        (dict(parts=[ks.Box((0, 0, 0), (1, 1, 1))]), TypeError, "parts must be Balls, Capsules and Hulls, but one is Box"),
        (dict(parts=[ks.Capsule((0, 0, 0), (1, 0, 0), -1)]), ks.InvalidValue, "radius"),
        (dict(orientation=(1, 0, 0)), ks.InvalidValue, r"orientation must be a quaternion .* has shape \(3,\)"),
        (dict(orientation=(1, 1, 0, 0)), ks.InvalidValue, "orientation,? must have length 1"),
        (dict(angular_velocity=(1, 0)), ks.InvalidValue, "angular_velocity"),
        (dict(angular_acceleration_limit=1.0), ks.InvalidValue, "largest_angular_speed,? must be finite"),
        (dict(inertia=(1, 1, -1)), ks.InvalidValue, "inertia"),
        (dict(group=2**31), ks.InvalidValue, "group must have 32 bits"),
    ]  # fmt: skip
    for arguments, error, message in wrong:
        given: dict[str, Any] = {"parts": dumbbell, "position": (0, 0, 0), **arguments}
        with pytest.raises(error, match=message):
            world.add_rigid_body(**given)
    assert len(world) == 0
    body = world.add_rigid_body(dumbbell, (0, 0, 0), largest_angular_speed=2.0)
    ball = world.add((5, 0, 0))
    with pytest.raises(ks.StateError, match="body must be rigid"):
        world.rotations(ball)
    with pytest.raises(ks.StateError, match="body must be rigid"):
        world.parts_of(ball)
    with pytest.raises(ks.StateError, match="change: body must be rigid"):
        world.set_angular_velocity(ball, (0, 0, 1))
    with pytest.raises(ks.InvalidValue, match="must not exceed largest_angular_speed"):
        world.set_angular_velocity([body], [(0, 0, 3)])
    with pytest.raises(TypeError, match="function must be a function of"):
        world.set_rotation_probe(3)  # type: ignore[arg-type]
    with pytest.raises(
        TypeError, match="shape must be a Ball, Box, HalfSpace, Triangle or Mesh, but is Capsule"
    ):
        world.add_static(ks.Capsule((0, 0, 0), (1, 0, 0), 1))  # type: ignore[arg-type]


def test_a_turning_box_meets_another() -> None:
    world = ks.World(contact_tolerance=1e-9)
    cube = ks.Hull.box((-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
    world.add_rigid_body([cube], (0, 0, 0), angular_velocity=(0, 0, 1))
    world.add_rigid_body([ks.Ball((0, 0, 0), 0.25), cube], (1.1, 0, 0))
    positions = np.array([[0, 0, 0], [1.1, 0, 0]], float)
    event = world.advance(2.0, lambda ids, t: (positions[ids], np.zeros((len(ids), 3))))
    assert event is not None and event.second_part == 1
    assert event.time == pytest.approx(np.pi / 4 - np.arccos(0.6 / np.sqrt(0.5)), abs=1e-8)
    assert world.parts_of(0) == [cube] and cube.points.shape == (8, 3) and cube.radius == 0
    assert pickle.loads(pickle.dumps(cube)) == cube != ks.Hull.box((0, 0), (1, 1))
    assert ks.Hull.box((0, 0), (1, 1)).points.shape == (4, 3)
    with pytest.raises(ks.InvalidValue, match="Hull: points must have shape"):
        ks.Hull([(1, 2, 3, 4)])
    with pytest.raises(ks.InvalidValue, match="number of points of at most 64, but is 65"):
        world.add_rigid_body([ks.Hull(np.ones((65, 3)) * np.arange(65)[:, None])], (0, 0, 0))


def test_a_capsule_is_a_value() -> None:
    capsule = ks.Capsule((0, 0), (1, 2), 0.5)
    assert repr(capsule) == "Capsule((0.0, 0.0, 0.0), (1.0, 2.0, 0.0), 0.5)"
    assert pickle.loads(pickle.dumps(capsule)) == capsule != ks.Capsule((0, 0), (1, 2), 0.6)
    assert list(capsule.b) == [1, 2, 0] and capsule.radius == 0.5
