"""What goes to another process and comes back: it goes on as it would have here."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from conftest import hash_of, pair

import kinesphere as ks

rng = np.random.default_rng(13)
positions = rng.uniform(5, 45, (12, 3))
velocities = rng.uniform(-3, 3, (12, 3))
box = ks.Box((0, 0, 0), (50, 50, 50))


def through(value: Any) -> Any:
    return pickle.loads(pickle.dumps(value))


makers: dict[str, Callable[[], Any]] = {
    "ballistic": lambda: ks.Ballistic(positions, velocities, gravity=(0, 0.5, -1)),
    "random forces": lambda: ks.RandomForces(positions, velocities, 5.0, interval=0.15, seed=2**63 + 5),
    "steered": lambda: ks.SteeredMotion(positions, velocities, np.full(12, 2.0)),
    "velocity field": lambda: ks.VelocityField(
        ks.Circulation(box, 4.0), positions, velocities, 6.0, interval=0.3, response_time=0.7
    ),
}


@pytest.mark.parametrize("name", makers)
def test_a_motion_comes_back_with_its_changes_and_gaps(name: str) -> None:
    motion = makers[name]()
    motion.set_velocity([1, 3], 0.4, [(1, 2, 3), (4, 5, 6)])
    if name == "steered":
        motion.steer(2, 0.5, (0, 1.5, 0))
    for number in (7, 2, 9):
        motion.remove(number)
    limit = () if name == "ballistic" else (1.0,)
    motion.add(0.6, (1, 1, 1), (0, 0, 0), *limit)
    again = through(motion)
    assert type(again) is type(motion) and 7 not in again and 2 not in again and 9 in again
    for here in (motion, again):
        assert [here.add(0.7, (2, 2, 2), (1, 0, 0), *limit) for _ in range(3)] == [2, 7, 12]
    for t in (0.75, 3.0):
        assert all(np.array_equal(a, b) for a, b in zip(motion.states(t), again.states(t)))
    assert again.definitions(3.0).keys() == motion.definitions(3.0).keys()


def test_tracks_and_sources_come_back() -> None:
    tracks = ks.RecordedTracks([([0, 1, 3], rng.uniform(0, 9, (3, 3))), ([0, 4], rng.uniform(0, 9, (2, 3)))])
    tracks.remove(0)
    again = through(tracks)
    assert 0 not in again and np.array_equal(again.states(2.0)[0], tracks.states(2.0)[0])
    vanishing = through(ks.RecordedTracks([([0, 1], [[0, 0, 0], [1, 0, 0]])], outside="vanish"))
    with pytest.raises(ks.InvalidValue, match="has vanished"):
        vanishing.states(2.0)
    source = ks.MotionSource(moved, positions, velocities)
    source.set_origin(20, 1.0, (1, 2, 3), (4, 5, 6))
    assert (
        np.array_equal(through(source)([3, 20], 2.0)[0], source([3, 20], 2.0)[0])
        and len(through(source)) == 21
    )


Game = tuple[ks.World, ks.FrameMotion, ks.BodyMap]


def game_of(frames: int) -> Game:
    """After some frames in which bodies came and went; the first has a limit."""
    limits = np.where(np.arange(6) == 0, 9.0, np.inf)
    motion = ks.FrameMotion(
        positions[:6], velocities[:6], limits, interval=0.1, position_error=1e-7, start_time=2.0
    )
    world, bodies = ks.World(start_time=2.0), ks.BodyMap()
    ids = bodies.add_all(world, motion, 0.1)
    for frame in range(frames):
        for number in {1: [4, 2], 2: [1], 3: [5]}.get(frame, []):
            bodies.remove(world, ids[number])
        if frame == 2:
            number = motion.add(motion.latest_time, (9, 9, 9), (1, 0, 0))
            assert number == 2 and bodies.add(world, motion, number) is not None
        step((world, motion, bodies), 0.01 * frame)
    return world, motion, bodies


def step(game: Game, distance: float) -> None:
    world, motion, bodies = game
    bodies.push(world, motion, motion.latest() + (distance, 0, 0))
    for _ in world.events(motion.latest_time, bodies):
        pass


@pytest.mark.parametrize("frames", [0, 1, 2, 3, 4, 7])
@pytest.mark.parametrize("removed", [(), (0,), (3, 0)])
def test_frames_come_back_and_use_numbers_again_in_the_same_order(
    frames: int, removed: tuple[int, ...]
) -> None:
    world, motion, bodies = game = game_of(frames)
    for number in removed:
        bodies.remove(world, number)
    again = through(game)
    assert again[1].latest_frame == frames and again[1].violation_count == 0
    for distance in (0.3, 0.2):
        there = [number for number in range(len(motion)) if number in motion]
        assert there == [number for number in range(len(again[1])) if number in again[1]]
        here, back = (one.definitions(motion.latest_time, there) for one in (motion, again[1]))
        assert [np.array_equal(a, b) for a, b in zip(here.values(), back.values())] == [True] * 6
        new = [
            [one.add(one.latest_time, (40, 40, 40), (0, 0, 0)) for _ in range(4)]
            for one in (motion, again[1])
        ]
        assert new[0] == new[1]
        for one in (game, again):
            for number in new[0]:
                one[2].add(one[0], one[1], number, 0.1)
            step(one, distance)
        np.testing.assert_array_equal(motion.latest(), again[1].latest())
        assert motion.previous_time == again[1].previous_time


def test_a_map_comes_back_with_its_world_and_motions() -> None:
    world, flight, frames = (
        ks.World(),
        ks.Ballistic(positions[:3]),
        ks.FrameMotion(positions[3:5], interval=0.5),
    )
    bodies = ks.BodyMap()
    gone = bodies.add(world, flight, 1)
    bodies.remove(world, gone)
    ids = [
        *bodies.add_all(world, frames, 0.1),
        bodies.add(world, flight, 0, 0.1),
        bodies.add(world, flight, 2, 0.1),
    ]
    game = (world, flight, frames, bodies)
    again = through(game)
    assert again[3].find(ids[0])[0] is again[2] and again[3].find(ids[2])[0] is again[1]
    assert [again[3].find(one)[1] for one in ids] == [bodies.find(one)[1] for one in ids]  # type: ignore[index]
    assert again[3].find(gone) is None
    for here, free, stepped, known in (game, again):
        known.set_velocity(here, ids[3], (0, 0, 5))
        known.push(here, stepped, stepped.latest() + 0.25)
        assert list(here.events(0.5, known)) == []
    assert np.array_equal(frames.latest(), again[2].latest())
    assert np.array_equal(flight.states(0.5, [0, 2])[0], again[1].states(0.5, [0, 2])[0])


@pytest.mark.parametrize("times", [[], [0.3], [0.1, 0.3], [0.1, 0.15, 0.3, 0.4]])
@pytest.mark.parametrize("turns", [False, True])
def test_frames_with_times_and_rotations_come_back(times: list[float], turns: bool) -> None:
    size = 5
    at = np.arange(3.0 * size).reshape(size, 3)
    turned = np.array([(1.0, 0, 0, 0)] * size) if turns else None
    motion = ks.FrameMotion(at, acceleration_limits=1.0, interval=0.1, rotations=turned)
    for k, time in enumerate(times):
        motion.push(at + 1e-3 * k, time, rotations=turned)
    again = through(motion)
    for frame in range(2):
        assert again.latest_time == motion.latest_time and again.previous_time == motion.previous_time
        assert again.has_equal_frames == motion.has_equal_frames and again.latest_frame == len(times) + frame
        np.testing.assert_array_equal(again.latest(), motion.latest())
        here, back = motion.latest_rotations(), again.latest_rotations()
        assert (here is not None) == (back is not None) == turns
        if here is not None and back is not None:
            np.testing.assert_array_equal(back, here)
        for one in (motion, again):
            one.push(one.latest() + 1e-3, rotations=turned)


def moved(ids: Any, t: float, since: Any, places: Any, speeds: Any) -> tuple[Any, Any]:
    return places + speeds * (t - since), speeds


def test_a_run_goes_on_in_another_process_to_the_last_bit() -> None:
    scene = ks.Scene("paper1", bodies=60, seconds=2.0, seed=5)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    world.run(1.0, motion, scene)
    world2, motion2, scene2 = through((world, motion, scene))
    assert repr(scene2) == repr(scene) == "<Scene paper1: 60 bodies, until 2.0>"
    assert hash_of(world.run(2.0, motion, scene)) == hash_of(world2.run(2.0, motion2, scene2))


def test_results_come_back() -> None:
    world, motion = pair()
    event = world.run(10.0, motion)[0]
    for value in (event, world.counters, ks.Circulation(box, 2.0), ks.Bouncing([1.0, 2.0], 0.5, 0.1)):
        assert repr(through(value)) == repr(value) == repr(copy.copy(value))
    assert through(event) == event and {event: 1}[through(event)] == 1
    assert through(world.counters) == world.counters != ks.World().counters


def test_everything_says_what_it_is() -> None:
    world, motion = pair()
    bodies = ks.BodyMap()
    shown = [
        motion, bodies, world.body(0), world.counters, world.safe_until(), world.safe_until(0, 1, 1.0),
        world.earliest_contact(0), world.earliest_approach(0, 1.0), world.distance_limits(0, 1, 1.0), ks.Bouncing(),
        ks.Workers(1), ks.Circulation(box, 1.0), ks.MotionSource(moved, positions), world.events(1.0, motion),
        ks.Scene("paper1", bodies=5),
    ]  # fmt: skip
    assert [repr(one) for one in shown if " object at 0x" in repr(one)] == []
    assert repr(motion) == "<Ballistic of 2 bodies>"
    assert repr(world.safe_until()).startswith("SafeTime(time=")
