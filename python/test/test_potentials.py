"""Timers, states of pairs, and potentials of steps."""

import math
import pickle

import numpy as np
import numpy.typing as npt
import pytest

import kinesphere as ks


def head_on(gap: float, speed: float) -> tuple[ks.World, ks.Ballistic]:
    """Two balls of radius 1/2 and mass 1 that fly towards each other."""
    start = [[-0.5 - gap / 2, 0, 0], [0.5 + gap / 2, 0, 0]]
    motion = ks.Ballistic(start, [[speed / 2, 0, 0], [-speed / 2, 0, 0]])
    world = ks.World(contacts="impacts")
    world.add_motion(motion, 0.5)
    return world, motion


def test_timers_come_among_other_events() -> None:
    world, motion = head_on(2.0, 1.0)
    world.schedule(0.5, user_data=3, period=1.0)
    world.schedule(9.25)
    events = world.run(10.0, motion, ks.Bouncing())
    timers = events.of_kind(ks.EventKind.timer)
    assert timers["time"].tolist() == [*np.arange(0.5, 9.0), 9.25, 9.5]
    assert timers["first_user_data"].tolist() == [3] * 9 + [0, 3]
    assert timers[0].first is None and timers[0].second is None
    assert world.unschedule(3) == 1 and world.unschedule(3) == 0
    with pytest.raises(ks.KinesphereError, match="schedule: time must not lie before the current time"):
        world.schedule(1.0)


def test_a_square_well_speeds_up_and_holds_back() -> None:
    world, motion = head_on(2.0, 1.0)
    well = ks.StepPotential(world, [0.5], [-1.0])
    world.set_sensor(0, well.distances)
    events = world.run(1.6, motion, well)
    assert [str(event.kind) for event in events] == ["sensor_enter"]
    speed = np.diff(motion.states(1.6)[1][:, 0])
    assert abs(speed[0]) == pytest.approx(np.sqrt(5.0), abs=1e-12)
    assert well.energy(0.4) == -1.0 and well.energy(0.6) == 0.0

    world, motion = head_on(0.2, 1.0)
    world.set_sensor(0, well.distances)
    events = world.run(40.0, motion, ks.StepPotential(world, 0.5, -1.0))
    leaves = events.of_kind(ks.EventKind.sensor_leave)
    assert len(leaves) == pytest.approx(40, abs=1) and len(world.sensor_overlaps(0)) == 1
    assert len(events.of_kind(ks.EventKind.sensor_enter)) == 1


def test_pairs_in_each_state_have_a_response_of_their_own() -> None:
    """A chain whose bonds hold, among free balls that bounce, in a run and in a game."""
    count, side, bonded = 24, 12.0, 5
    places = np.column_stack([0.7 + 1.1 * (np.arange(count) % 10), 1.0 + 2.0 * (np.arange(count) // 10)])
    speeds = np.random.default_rng(2).normal(size=(count, 2))
    box = ((0, 0), (side, side))

    def chained(world: ks.World, ids: npt.NDArray[np.int64]) -> ks.StepPotential:
        bond = ks.StepPotential(world, [0.4], [0.0], outside=math.inf)
        world.set_sensor(0, bond.distances)
        for first, second in zip(ids[:9], ids[1:10], strict=True):
            world.set_pair_state(ks.BodyId(first), ks.BodyId(second), bonded)
        return bond

    motion = ks.Ballistic(places, speeds)
    world = ks.World(dimensions=2, box=box, contacts="impacts")
    ids = world.add_motion(motion, 0.5)
    bond = chained(world, ids)
    game = ks.GameWorld(dimensions=2, box=box, contacts="impacts")
    bond_of_game = chained(game, game.add(places, speeds, 0.5))
    game.respond = {0: ks.Bouncing(), np.int64(bonded): bond_of_game}  # type: ignore[dict-item]
    for time in range(1, 31):
        events = world.run(float(time), motion, {bonded: bond, 0: ks.Bouncing()})
        assert [event.time for event in game.step(time - game.time)] == [event.time for event in events]
        chain = motion.states(float(time))[0][:10]
        assert np.all(np.linalg.norm(np.diff(chain, axis=0), axis=1) < 1.4 + 1e-6)
    free = motion.states(30.0)[0][10:]
    assert np.max(np.linalg.norm(np.diff(free, axis=0), axis=1)) > 3.0
    energy = np.sum(motion.states(30.0)[1] ** 2)
    assert energy == pytest.approx(np.sum(speeds**2), rel=1e-12)

    for wrong, message in [
        ({"a": bond}, "keys must be states of pairs, whole numbers of 32 bits, but one is 'a'"),
        ({2**40: bond}, "keys must be states of pairs, whole numbers of 32 bits, but one is 1099511627776"),
        ({0: None}, "values must be a Bouncing, a Roughness or a StepPotential, but one is None"),
    ]:
        with pytest.raises(TypeError, match=f"^run: respond: {message}"):
            world.run(31.0, motion, wrong)  # type: ignore[call-overload]
        with pytest.raises(TypeError, match=f"^GameWorld: respond: {message}"):
            game.respond = wrong  # type: ignore[assignment]
    assert world.run(31.0, motion, {}).of_kind(ks.EventKind.contact_begin) is not None


def test_a_loop_turns_back_and_reads_states_of_pairs() -> None:
    world, motion = head_on(2.0, 1.0)
    world.set_sensor(0, [0.5])
    first, second = world.bodies()
    world.set_pair_state(ks.BodyId(first), ks.BodyId(second), 7)
    assert world.pair_state(ks.BodyId(second), ks.BodyId(first)) == 7
    seen = []
    for event in world.events(10.0, motion):
        seen.append(event)
        assert event.pair_state == 7
        swapped = np.array([event.second_velocity, event.first_velocity])
        motion.set_velocity([0, 1], event.time, swapped)
        world.set_velocity([0, 1], swapped)
        world.turn_back(event)
    assert [str(event.kind) for event in seen] == ["sensor_enter"]
    with pytest.raises(ks.KinesphereError, match="turn_back: crossing must be of the present time"):
        world.turn_back(seen[0])


def test_a_potential_that_is_none_is_refused() -> None:
    world = ks.World()
    with pytest.raises(ks.KinesphereError, match=r"distances\[1\] must be more than"):
        ks.StepPotential(world, [0.5, 0.4], [1.0, 2.0])
    with pytest.raises(ks.KinesphereError, match="number of energies"):
        ks.StepPotential(world, [0.5], [1.0, 2.0])


def rough_gas(count: int = 60) -> ks.GameWorld:
    """Balls of radius 1/2 that fly, and do not turn."""
    game = ks.GameWorld(
        respond=ks.Roughness(), box=((0, 0, 0), (8, 8, 8)), periodic="xyz", contacts="impacts"
    )
    random = np.random.default_rng(1)
    for position, velocity in zip(
        ks.place_spheres(np.full(count, 0.5), ((0, 0, 0), (8, 8, 8)), seed=4), random.normal(size=(count, 3))
    ):
        game.add_rigid_body([ks.Ball((0, 0, 0), 0.5)], position, velocity)
    return game


def test_rough_balls_share_their_energy_with_rotation() -> None:
    game = rough_gas()
    start = np.sum(game.velocities**2)
    game.step(10.0)
    parts = []
    for _ in range(100):
        game.step(4.0)
        parts.append((np.sum(game.velocities**2), 0.4 * 0.25 * np.sum(game.rotations(game.ids)[1] ** 2)))
    flying, turning = np.mean(parts, axis=0)
    assert np.sum(parts, axis=1) == pytest.approx(start, rel=1e-10)
    assert turning / flying == pytest.approx(1.0, abs=0.06)


def test_a_rough_bounce_of_one_contact() -> None:
    game = ks.GameWorld()
    for side in (-1, 1):
        game.add_rigid_body([ks.Ball((0, 0, 0), 0.5)], (2 * side, 0.2 * side, 0), (-side, 0, 0))
    event = game.advance(5.0)
    assert event is not None
    (velocity, spin), _ = ks.bounce_rigid(event, ks.Roughness())
    assert velocity is not None and spin is not None
    assert spin[2] != 0 and np.sum(velocity**2) + 0.1 * np.sum(spin**2) == pytest.approx(1.0, abs=1e-12)
    smooth = ks.Roughness(tangential_restitution=-1.0)
    first, second = ks.bounce_rigid(event, smooth)[0][0], ks.bounce_rigid(event, 1.0)[0][0]
    assert np.array_equal(np.asarray(first), np.asarray(second))
    assert repr(pickle.loads(pickle.dumps(smooth))) == repr(smooth)
    for wrong in ({"restitution": 2}, {"tangential_restitution": -2}, {"friction": -1}, {"inertia": 0}):
        with pytest.raises(ks.InvalidValue, match=f"Roughness: {next(iter(wrong))} must"):
            ks.Roughness(**wrong)
