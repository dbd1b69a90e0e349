"""What a world tells, and what can be asked of it and changed."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from conftest import Doubles, Ids, hash_of, pair

import kinesphere as ks
from kinesphere import EventKind


def test_ten_lines() -> None:
    world, motion = pair()
    events = [(event.kind, event.first, event.second) for event in world.events(10.0, motion)]
    assert events == [(EventKind.contact_begin, 0, 1), (EventKind.contact_end, 0, 1)]
    assert world.time == 10.0


def test_a_probe_of_numpy_tells_the_same() -> None:
    world, motion = pair()
    expected = hash_of(world.run(10.0, motion))
    asked: list[Ids] = []

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        assert ids.dtype == np.int64 and ids.ndim == 1 and isinstance(t, float)
        asked.append(ids)
        places = np.array([[2 * t, 0, 0], [10, 0, 0]])
        return places[ids], np.array([[2.0, 0, 0], [0, 0, 0]])[ids]

    other, _ = pair()
    assert hash_of(other.run(10.0, probe)) == expected
    assert other.counters.probes == sum(len(ids) for ids in asked)
    # Arrays of earlier calls are unchanged.
    assert all(set(ids.tolist()) <= {0, 1} for ids in asked)


def test_a_loop_and_advance_and_run_tell_the_same() -> None:
    scene = ks.Scene("paper1", bodies=60, seconds=1.0)
    hashes = set()
    for way in ("run", "events", "advance"):
        world, motion = ks.World(**scene.definition), scene.motion()
        world.add_motion(motion, scene.radii)
        hash = ks.EventHash()
        if way == "run":
            hash.add(world.run(1.0, motion))
        elif way == "events":
            for event in world.events(1.0, motion):
                hash.add(event)
        else:
            while (next_event := world.advance(1.0, motion)) is not None:
                hash.add(next_event)
        assert world.time == 1.0
        hashes.add(str(hash))
    assert len(hashes) == 1


@pytest.mark.parametrize("threads", [1, 2])
def test_a_response_removes_disables_and_puts_to_sleep(threads: int) -> None:
    world, motion = pair()
    kinds = [
        str(event.kind) for event in world.run(10.0, motion, lambda event: (None, "remove"), threads=threads)
    ]
    assert kinds == ["contact_begin", "contact_end"]
    assert len(world) == 1

    for name in ("disable", "sleep"):
        world, motion = pair()
        world.run(10.0, motion, lambda event: (name if event.kind == EventKind.contact_begin else None, None))
        assert len(world) == 2
        assert world.body(0).enabled == (name == "sleep") and world.body(0).sleeping == (name == "sleep")


Answer = tuple[str, str, str] | None


def shooting() -> (
    tuple[ks.World, ks.Ballistic, ks.BodyMap, Callable[[ks.Event], Answer], Callable[[ks.Event], None]]
):
    """A bullet flies at a rock, and both burst into fragments; the world, the motion, the map, and what is done."""
    motion = ks.Ballistic([(0, 0, 0), (5, 0, 0), (0, 20, 0)], [(10, 0, 0), (0, 0, 0), (1, 0, 0)])
    world, bodies = ks.World(), ks.BodyMap()
    bullet, *_ = bodies.add_all(world, motion, 0.5)

    def respond(event: ks.Event) -> Answer:
        hit = event.kind == EventKind.contact_begin and event.first == bullet
        return ("remove", "remove", "stop") if hit else None

    def burst(event: ks.Event) -> None:
        assert world.time == event.time and bullet not in world
        for turn in np.arange(4) * np.pi / 2:
            away = np.array([0, np.cos(turn), np.sin(turn)])
            bodies.add(world, motion, motion.add(world.time, event.point + away, away), 0.1)

    return world, motion, bodies, respond, burst


@pytest.mark.parametrize("threads", [1, 2])
def test_a_run_stops_so_that_bodies_can_be_added(threads: int) -> None:
    world, motion, bodies, respond, burst = shooting()
    events = world.run(3.0, bodies, respond, at_stop=burst, threads=threads)
    assert [str(event.kind) for event in events] == ["contact_begin", "contact_end"]
    assert len(world) == 5 and len(motion) == 5, "the two that burst have left the motion, too"
    assert all(bodies.find(body) is not None for body in world.bodies())

    looped, motion_there, bodies_there, _, burst_there = shooting()
    for event in looped.events(3.0, bodies_there):
        if respond(event) is None:
            continue
        bodies_there.remove(looped, event.first)
        assert event.second is not None
        bodies_there.remove(looped, event.second)
        burst_there(event)
    assert (world.bodies() == looped.bodies()).all()
    assert (np.asarray(motion.states(3.0)) == np.asarray(motion_there.states(3.0))).all()


def test_what_at_stop_raises_comes_out_at_the_stop() -> None:
    world, motion, bodies, respond, burst = shooting()
    told: list[float] = []

    def fail(event: ks.Event) -> None:
        motion.add(world.time, (0, 50, 0), (0, 0, 0))
        with pytest.raises(ks.StateError, match="run"):
            world.run(9.0, lambda ids, t: (np.zeros((len(ids), 3)), np.zeros((len(ids), 3))))
        told.append(event.time)
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        world.run(3.0, bodies, respond, at_stop=fail)
    assert told == [world.time]
    bodies.set_velocity(world, 2, (0, 0, 0))  # neither map nor motion is in use any more
    assert [str(event.kind) for event in world.run(3.0, bodies, respond, at_stop=burst)] == [
        "contact_begin",
        "contact_end",
    ]
    with pytest.raises(TypeError, match="at_stop must be a function of an event, but is 5"):
        world.run(4.0, bodies, respond, at_stop=5)  # type: ignore[call-overload]


def test_an_event_says_what_happened() -> None:
    world, motion = pair()
    event = world.advance(10.0, motion)
    assert event is not None
    assert (
        event.kind == EventKind.contact_begin
        and str(event.kind) == "contact_begin"
        and f"{event.kind:>14}" == " contact_begin"
    )
    assert event.time == pytest.approx(4.0, abs=1e-5)
    assert event.normal.tolist() == [1, 0, 0]
    assert event.point == pytest.approx([9, 0, 0], abs=1e-5)
    assert event.first_velocity.tolist() == [2, 0, 0] and event.second_position.tolist() == [10, 0, 0]
    assert event.approach_speed == 2.0 and 0 <= event.gap <= 1e-6
    assert event.wall is None and event.sensor is None and not event.repeated
    assert repr(event).startswith("<Event contact_begin at 3.99")
    first, second = ks.bounce(event, 1.0, 1.0)
    assert second is not None
    assert first.tolist() == [0, 0, 0] and second.tolist() == [2, 0, 0]


def test_walls_bounces_and_a_ready_made_response() -> None:
    world, motion = pair(box=((-5, -5, -5), (15, 5, 5)))
    events = world.run(20.0, motion, ks.Bouncing())
    kinds = [EventKind(kind) for kind in events["kind"]]
    assert kinds[:2] == [EventKind.contact_begin, EventKind.contact_end]
    wall = events.of_kind(EventKind.wall_begin)[0]
    assert wall.wall == ks.Wall.x_upper and wall.first == 1 and wall.second is None
    own, moved = pair(box=((-5, -5, -5), (15, 5, 5)))
    answers = own.run(20.0, moved, lambda event: ks.bounce(event) if event.approach_speed > 0 else None)
    assert hash_of(answers) == hash_of(events)


def test_a_response_turns_fixed_bodies_into_walls() -> None:
    motion = ks.Ballistic([[0.0, 0, 0]], [[1.0, 0, 0]])
    world = ks.World(contacts="impacts")
    world.add_motion(motion, radii=1.0)
    post = world.add_static(ks.Ball((5, 0, 0), 1))
    floor = world.add_static(ks.HalfSpace((1, 0, 0), -4))
    events = world.run(30.0, motion, ks.Bouncing(masses=[2.0]))
    assert events["second"].tolist()[:3] == [post, floor, post]


def test_bodies_change_in_the_loop() -> None:
    world, motion = pair(contacts="impacts")
    for event in world.events(20.0, motion):
        assert event.second is not None
        first, second = ks.bounce(event, 1.0, 1.0)
        assert second is not None
        for body, velocity in ((event.first, first), (event.second, second)):
            motion.set_velocity(body, event.time, velocity)
            world.set_velocity(body, velocity)
    assert motion.states(20.0)[0][1, 0] == pytest.approx(42.0)


def test_removed_bodies_are_stale_and_foreign_ones_are_noticed() -> None:
    world, motion = pair()
    extra = world.add((50, 0, 0))
    assert isinstance(extra, ks.BodyId)
    world.remove(extra)
    assert extra not in world and len(world) == 2
    again = world.add((60, 0, 0))
    assert again != extra and again.index == extra.index and again.generation == 1
    assert str(again) == "2 (generation 1)"
    assert ks.index_of([again]).tolist() == [2] and ks.index_of(again) == 2
    with pytest.raises(ks.BodyError) as caught:
        world.set_radius(extra, 1.0)
    assert caught.value.code == "stale_body" and caught.value.body == extra
    other, _ = pair()
    foreign = other.add((90, 0, 0))
    with pytest.raises(LookupError, match="foreign|another world"):
        world.teleport(foreign, (0, 0, 0))
    with pytest.raises(IndexError):
        np.zeros(3)[again]


def test_many_bodies_are_changed_at_once() -> None:
    world = ks.World()
    ids = world.add(np.arange(30.0).reshape(10, 3) * 10)
    world.set_velocity(ids, np.ones((10, 3)))
    world.set_radius(ids[2:4], [0.5, 0.25])
    world.set_radius_rate(ids[2:4], [0.5, -0.25])
    world.teleport(ids[:2], [[1, 1, 1], [5, 5, 5]])
    world.set_user_data(ids, np.arange(10, dtype=np.uint64) + 2**63)
    world.set_motion_limits(ids, 3.0, planned_acceleration=(0, 0, -1))
    assert world.user_data(3) == 2**63 + 3
    assert world.body(3).radius == 0.25 and world.body(3).acceleration_limit == 3.0
    with pytest.raises(ks.StateError, match="radius_rate"):
        world.sleep(3)
    world.set_radius_rate(ids, 0)
    world.disable(ids[:5])
    assert not world.body(0).enabled
    world.enable(ids[:5], np.zeros((5, 3)) + [[0], [20], [40], [60], [80]], np.zeros((5, 3)))
    world.sleep(ids[5])
    assert world.body(5).sleeping
    world.wake(ids[5])
    world.remove(ids[[1, 2]])
    assert len(world) == 8 and world.bodies().tolist() == [0, 3, 4, 5, 6, 7, 8, 9]


def test_sensors_and_zones() -> None:
    world, motion = pair()
    world.set_sensor(1, [3.0, 1.0])
    world.set_sensor_class(1, 1)
    zone = world.add_zone(ks.Box((3, -1, -1), (5, 1, 1)), user_data=7)
    events = world.run(10.0, motion)
    entered = events.of_kind(EventKind.sensor_enter)
    assert [(event.sensor, event.visitor, event.distance) for event in entered] == [
        (zone, 0, 0.0), (1, 0, 3.0), (1, 0, 1.0)]  # fmt: skip
    assert entered[0].second_user_data == 7 and entered[0].senses == ks.Senses.second
    assert len(events.of_kind(EventKind.sensor_leave)) == 3
    assert world.sensor_overlaps(1) == [] and world.sensor(1)[0].tolist() == [3.0, 1.0]
    assert world.shape_of(zone) == ks.Box((3, -1, -1), (5, 1, 1))


def test_filters() -> None:
    world, motion = pair()
    world.set_filter(0, category=2)
    world.set_filter(1, mask=1)
    assert len(world.run(10.0, motion)) == 0
    world, motion = pair()
    asked: list[tuple[int, int]] = []

    def no_pair(first: int, second: int) -> bool:
        asked.append((first, second))
        return False

    world.set_pair_filter(no_pair)
    assert len(world.run(10.0, motion)) == 0 and (0, 1) in [(min(both), max(both)) for both in asked]
    with pytest.raises(TypeError, match="set_pair_filter"):
        world.set_pair_filter(5)  # type: ignore[arg-type]


def test_what_a_pair_filter_raises_comes_out() -> None:
    def broken(first: ks.BodyId, second: ks.BodyId) -> bool:
        raise KeyError("filter")

    world, motion = pair()
    world.set_pair_filter(broken)
    with pytest.raises(KeyError, match="filter"):
        world.run(10.0, motion)
    world.set_pair_filter(None)
    assert len(world.run(10.0, motion)) <= 2 and world.time == 10.0


def test_certificates_and_queries() -> None:
    world, motion = pair()
    assert world.safe_until(0, 1).time == pytest.approx(4.0, abs=1e-4)
    assert world.safe_until().time <= 4.0 and world.safe_until(0).time <= 4.0
    assert world.safe_until(0, 1, 3.0).time == pytest.approx(2.5, abs=1e-4)
    contact = world.earliest_contact(0, probe=motion)
    assert contact.partner == 1 and contact.wall is None and not contact.touching
    approach = world.earliest_approach(0, 3.0)
    assert approach.partner == 1 and not approach.within and approach.time == pytest.approx(2.5, abs=1e-4)
    limits = world.distance_limits(0, 1, 2.0)
    assert limits.lower <= 4.0 <= limits.upper
    found = world.nearest((11.5, 0, 0), 1, probe=motion)
    assert (
        found["body"].tolist() == [1] and found["certain"].all() and found["lower"][0] == pytest.approx(0.5)
    )
    assert world.overlapping((0, 0, 0), 0.5)["body"].tolist() == [0]
    assert world.overlapping_box(((9, -1, -1), (11, 1, 1)))["body"].tolist() == [1]
    assert world.ray_cast((-5, 0, 0), (1, 0, 0), 50.0)["body"].tolist() == [0]
    assert world.sphere_cast((10, 20, 0), 1.0, (0, -1, 0), 50.0)["body"].tolist() == [1]


def test_many_queries_at_once() -> None:
    world, motion = pair()
    rays = world.ray_cast_all(
        [(-5, 0, 0), (-5, 9, 0)], [(1, 0, 0), (1, 0, 0)], 50.0, [0.0, 8.5], without=[0, 1]
    )
    assert rays["query"].tolist() == [0, 1] and rays["body"].tolist() == [1, 0]
    near = world.nearest_all([(0, 0, 0), (10, 0, 0), (0, 0, 0)], 1, without=0, threads=2)
    assert near["query"].tolist() == [0, 1, 2] and near["body"].tolist() == [1, 1, 1]
    assert near.dtype.names == ("query", "body", "certain", "lower", "upper")
    within = world.overlapping_all([(0, 0, 0), (5, 0, 0)], [0.5, 9.0])
    assert within["query"].tolist() == [0, 1, 1] and within["body"].tolist() == [0, 0, 1]
    exact = world.nearest_all([(2, 0, 0), (8, 0, 0)], 1, probe=motion)
    assert exact["certain"].all() and exact["body"].tolist() == [0, 1]
    assert len(world.overlapping_all([(0, 0, 0)], 9.0, mask=2)) == 0
    assert len(world.overlapping_all(np.empty((0, 3)), 9.0)) == 0
    with pytest.raises(ks.InvalidValue, match="ray_cast_all: query 1, direction must not be zero"):
        world.ray_cast_all([(0, 0, 0)] * 2, [(1, 0, 0), (0, 0, 0)], 1.0)
    with pytest.raises(ValueError, match="nearest_all: without must have an id for each of the 2 queries"):
        world.nearest_all([(0, 0, 0)] * 2, 1, without=[0, 1, 0])


def test_inspection() -> None:
    world, motion = pair()
    world.set_profiling(True)
    world.run(4.2, motion)
    assert world.touching(0).tolist() == [1]
    centres, radii = world.bounds()
    assert centres.shape == (2, 3) and radii.tolist() == [1, 1]
    assert world.audit() is None
    assert world.counters.count(EventKind.contact_begin) == 1
    assert world.memory()["bodies"] > 0 and world.timings()["advances"] > 0
    assert all(isinstance(box, ks.Box) for box, _ in world.cells())
    assert isinstance(world.certificates(), list)
    assert world.body(0).image == (0, 0, 0)


def test_busiest_names_what_costs_probes_and_why() -> None:
    world = ks.World()
    world.add_static(ks.HalfSpace((0, 0, 1), 0.0))
    places = np.array([[0, 0, 1], [4, 0, 1], [8, 0, 1], [0, 50, 50]], dtype=float)
    *balls, far = world.add(places, acceleration_limits=[10.0, 10.0, 10.0, 0.0])
    with pytest.raises(ks.StateError, match="set_profiling") as error:
        world.busiest()
    assert error.value.code == "not_profiling"
    world.set_profiling(True)

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        return places[ids - 1], np.zeros((len(ids), 3))

    world.run(0.2, probe)
    busiest = world.busiest()
    *touching, seldom = busiest
    assert sorted(one.body for one in touching) == balls
    # The far one promises to stay where it is: spot checks alone ask about it.
    assert seldom.body == far and seldom.windows == seldom.probes <= 5
    assert {one.reason for one in touching} == {"touching"} and "sleep" in busiest[0].advice
    assert busiest[0].touching > 100 and busiest[0].acceleration_limit == 10.0
    assert busiest[0].largest_acceleration == 0.0
    assert sum(one.probes for one in busiest) == world.counters.probes
    assert len(world.busiest(2)) == 2 and "touching" in repr(busiest[0])


def test_snapshots_clones_copies_and_pickles_go_the_same_way() -> None:
    scene = ks.Scene("paper1", bodies=60, seconds=1.0)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    world.run(0.5, motion, scene)
    ways = [
        world.clone(),
        copy.copy(world),
        copy.deepcopy(world),
        ks.World.restore(world.save()),
        pickle.loads(pickle.dumps(world)),
    ]
    motions = [copy.copy(motion) for _ in ways]
    expected = hash_of(world.run(1.0, motion, scene))
    assert {hash_of(way.run(1.0, moved, scene)) for way, moved in zip(ways, motions)} == {expected}
    world.set_pair_filter(lambda a, b: True)
    with pytest.raises(TypeError, match="pair filter"):
        pickle.dumps(world)


def test_events_are_kept_as_asked() -> None:
    scene = ks.Scene("paper1", bodies=60, seconds=2.0)

    def made() -> tuple[ks.World, ks.Motion]:
        world, motion = ks.World(**scene.definition), scene.motion()
        world.add_motion(motion, scene.radii)
        return world, motion

    def run(**asked: Any) -> Any:
        world, motion = made()
        return world.run(2.0, motion, scene, **asked)

    every = run()
    columns = ("time", "first", "normal", "repeated", "kind")
    some = run(events=columns)
    assert some.dtype.names == columns and some.dtype.itemsize == 8 + 8 + 24 + 1 + 1
    assert len(every) > 20 and all((some[name] == every[name]).all() for name in columns)
    assert len(run(events="none")) == len(run(events=[])) == 0
    assert run(events="all").array.tobytes() == every.array.tobytes()
    for wrong in ("some", ["time", "frist"]):
        with pytest.raises(ks.InvalidValue, match="run: events must"):
            run(events=wrong)

    # Those of an interrupted run come first in what the next one returns.
    told = 0

    def stumble(event: ks.Event) -> None:
        nonlocal told
        told += 1
        if told == 10:
            raise KeyError("stumbled")

    world, motion = made()
    silent, _ = made()
    expected = silent.run(2.0, scene.motion(), lambda event: None, events=["time"])
    with pytest.raises(KeyError, match="stumbled"):
        world.run(2.0, motion, stumble, events=["time"])
    with pytest.raises(ks.StateError, match="as in the run that was interrupted"):
        world.run(2.0, motion, stumble)
    assert (world.run(2.0, motion, stumble, events=["time"]) == expected).all()


def test_recordings_are_repeated_without_the_motion() -> None:
    world, motion = pair()
    world.start_recording()
    assert world.recording
    events = world.run(10.0, motion)
    recording = world.stop_recording()
    replay = ks.Replay(recording)
    again = ks.EventHash()
    while not replay.finished:
        event = replay.advance()
        if event is not None:
            again.add(event)
    assert str(again) == hash_of(events) and replay.world().time == 10.0
    run = ks.read_recording(recording)
    assert hash_of(run.events) == hash_of(events) and run.end_time == 10.0
    assert run.positions.shape == (len(run.times), 3) == run.velocities.shape and len(run.bodies) == len(
        run.times
    )


def test_space_that_repeats() -> None:
    motion = ks.Ballistic([(0.5, 0.5, 0.5), (9.5, 0.5, 0.5)], [(-1, 0, 0), (0, 0, 0)])
    world = ks.World(box=((0, 0, 0), (10, 10, 10)), periodic=True)
    world.add_motion(motion, radii=0.2)
    event = world.advance(5.0, motion)
    assert event is not None and event.normal.tolist() == [-1, 0, 0]
    assert world.definition["periodic"] == "xyz"
    assert ks.World(box=((0, 0, 0), (10, 10, 10)), periodic="xy").definition["periodic"] == "xy"


def test_images_of_a_box_that_shears_slide() -> None:
    motion = ks.Ballistic([(5, 9), (1, 1)], [(0, 1), (0, 0)])
    world = ks.World(dimensions=2, box=((0, 0), (10, 10)), periodic="xy", shear_rate=0.2)
    world.add_motion(motion, radii=0.5)
    # The image of the first ball below the box goes to the left at speed 2.
    events = world.run(5.0, motion, ks.Bouncing()).of_kind(EventKind.contact_begin)
    assert [event.time for event in events] == pytest.approx([2 - 5**-0.5])
    assert events[0].first_velocity.tolist() == [-2, 1, 0]
    assert motion.states(3.0)[1] == pytest.approx(np.array([[2, 0, 0], [-2, 1, 0]]), abs=1e-6)
    assert world.definition["shear_rate"] == 0.2
    with pytest.raises(ValueError, match="shear_rate"):
        ks.World(shear_rate=1.0)


def test_a_definition_makes_the_same_world_again() -> None:
    settings = dict(box=ks.Box((0, 0, 0), (1, 2, 3)), contact_tolerance=1e-4, zeno_interval=0.1, start_time=5.0,
                    allow_overlap=False, contacts="impacts", separation_distance=0.01, dimensions=3,
                    wall_filter={"category": 2, "mask": 5, "group": -1}, spread_window_starts=True,
                    adopt_observed_limits=False)  # fmt: skip
    world = ks.World(**settings)  # type: ignore[arg-type]
    again = ks.World(**world.definition).definition
    assert {name: again[name] for name in settings} == settings and world.time == 5.0  # type: ignore[literal-required]


def test_walls_with_a_filter_let_some_bodies_pass() -> None:
    def escapes(mask: int) -> bool:
        motion = ks.Ballistic([(5, 5)], [(1, 0)])
        world = ks.World(dimensions=2, box=((0, 0), (10, 10)), wall_filter={"category": 2})
        world.add_motion(motion, masks=mask)
        return world.advance(20.0, motion) is None

    assert escapes(1) and not escapes(3)
    with pytest.raises(ks.InvalidValue, match="wall_filter must have no other keys .* has masks"):
        ks.World(wall_filter={"masks": 2})  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="wall_filter must be a dict of whole numbers"):
        ks.World(wall_filter={"mask": "all"})  # type: ignore[typeddict-item]


def test_a_mesh() -> None:
    vertices = np.array([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]], dtype=float)
    motion = ks.Ballistic([[3.0, 4, 5]], gravity=(0, 0, -10))
    world = ks.World(contacts="impacts")
    world.add_motion(motion, radii=0.5)
    floor = world.add_mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]), user_data=7)
    assert floor == 1
    event = world.advance(5.0, motion)
    assert event is not None and event.second == floor and event.second_user_data == 7
    assert event.time == pytest.approx(np.sqrt(2 * 4.5 / 10), abs=1e-4)
    assert event.normal.tolist() == [0, 0, -1]
    assert event.second_part == 1 and event.first_part == 0
    with pytest.raises(ks.InvalidValue, match="triangle 1: corners must be less than the number of vertices"):
        world.add_mesh(vertices, [[0, 1, 2], [0, 1, 4]])


def test_a_mesh_is_a_shape() -> None:
    vertices = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    mesh = ks.Mesh(vertices, [(0, 1, 2), (0, 2, 3)])
    assert len(mesh) == 2 and repr(mesh) == "Mesh(4 vertices, 2 triangles)"
    assert mesh.vertices.tolist() == [list(map(float, vertex)) for vertex in vertices]
    assert mesh.corners.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert mesh == ks.Mesh(vertices, mesh.corners) and mesh != ks.Mesh(vertices, [(0, 1, 2)])
    assert pickle.loads(pickle.dumps(mesh)) == mesh
    world = ks.World(contacts="impacts")
    zone = world.add_zone(mesh)
    assert world.shape_of(zone) == mesh
    world.set_shape(zone, ks.Mesh(vertices, [(0, 1, 2)]))
    world.remove(zone)
    lift = world.add_moving_shape(mesh, (0, 0, 0), (0, 0, 1), mass=float("inf"))
    ball = world.add((2, 1, 3), radii=0.5)
    starts = np.array([[0.0, 0, 0], [2, 1, 3]])
    velocities = np.array([[0.0, 0, 1], [0, 0, 0]])

    def states(ids: Ids, time: float) -> tuple[Doubles, Doubles]:
        rows = np.where(ids == lift, 0, 1)
        return starts[rows] + time * velocities[rows], velocities[rows]

    event = world.advance(3.0, states)
    assert event is not None and event.kind == EventKind.contact_begin
    assert (event.first, event.second) == (lift, ball)
    assert event.time == pytest.approx(2.5, abs=1e-4)
    with pytest.raises(ks.StateError, match="add_static: shape must be a mesh that Mesh::chain"):
        ks.World(dimensions=2).add_static(mesh)


def test_a_chain_is_the_ground_of_a_plane() -> None:
    motion = ks.Ballistic([[3.0, 4, 0]], gravity=(0, -10, 0))
    world = ks.World(dimensions=2, contacts="impacts")
    world.add_motion(motion, radii=0.5)
    ground = world.add_static(ks.Mesh.chain([(x, 0.0) for x in range(9)]))
    event = world.advance(5.0, motion)
    assert event is not None and event.second == ground
    assert event.time == pytest.approx(np.sqrt(2 * 3.5 / 10), abs=1e-4)
    assert event.normal.tolist() == [0, -1, 0] and event.second_part // 2 in (2, 3)
    with pytest.raises(ks.InvalidValue, match="Mesh::chain: points must be at least two"):
        ks.Mesh.chain([(0, 0)])


def test_a_periodic_plane_is_made_of_corners_with_two_numbers() -> None:
    world = ks.World(dimensions=2, box=((0, 0), (9, 5)), periodic=True)
    assert (
        world.definition["periodic"] == "xy" and ks.World(**world.definition).definition == world.definition
    )
    world.add([(8.5, 1), (1, 1)], [(1, 0), (0, 0)], radii=0.25)
    assert world.overlapping_box(((8, 0), (9, 2)))["body"].tolist() == [0]
    event = world.advance(5.0, ks.Ballistic([(8.5, 1), (1, 1)], [(1, 0), (0, 0)]))
    assert event is not None and event.time == pytest.approx(1.0, abs=1e-5)
    assert (
        ks.World(dimensions=2).add_zone(ks.Box((0, 0), (2, 4))) == 0 and ks.Box((0, 0), (2, 4)).lower[2] == -2
    )
    assert ks.Ball((1, 2), 3) == ks.Ball((1, 2, 0), 3) and ks.HalfSpace((0, 1), 2) == ks.HalfSpace(
        (0, 1, 0), 2
    )
    with pytest.raises(ks.InvalidValue, match="Box: upper must have the shape of lower"):
        ks.Box((0, 0), (1, 1, 1))
    with pytest.raises(
        ks.InvalidValue, match=r"World: box must .* of shape \(2, 3\); \(2, 2\) is for dimensions=2"
    ):
        ks.World(box=((0, 0), (9, 9)))
    with pytest.raises(ks.InvalidValue, match="^World: contact_tolerance must be at least .* for a box"):
        ks.World(box=((0, 0, 0), (1, 1, 1e12)))


def test_positions_are_unwrapped_by_arrays() -> None:
    length = np.array([10.0, 10.0, 50.0])
    rng = np.random.default_rng(17)
    places, speeds = rng.uniform(0, 10, (30, 3)), rng.uniform(-40, 40, (30, 3)) * [1, 1, 0]
    world = ks.World(box=((0, 0, 0), length), periodic="xy", contacts="impacts")
    motion = ks.Ballistic(places, speeds)
    world.add_motion(motion, 0.01)
    world.run(3.3, motion)
    path = places + 3.3 * speeds
    wrapped = np.where([True, True, False], np.mod(path, length), path)
    assert np.abs(world.unwrapped(wrapped) - path).max() < 1e-9
    assert np.abs(world.unwrapped(wrapped[[4, 2]] + length * [3, -2, 0], [4, 2]) - path[[4, 2]]).max() < 1e-9
    images = world.images()
    assert images.dtype == np.int64 and tuple(images[5]) == world.body(5).image and np.abs(images).max() > 5
    assert not images[:, 2].any() and world.images([7]).shape == (1, 3)
    with pytest.raises(ks.InvalidValue, match="positions must have shape"):
        world.unwrapped(wrapped[:3])
