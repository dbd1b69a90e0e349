"""Wrong use in the 48 ways of examples/wrong_use.cpp, translated, and those that only Python has.

Nothing crashes, nothing is silently wrong: each is answered with an exception that names the call, the
argument and, where there is one, the body.
"""

import threading
from collections.abc import Callable
from typing import Any, Optional

import numpy as np
import pytest
from conftest import Doubles, Ids

import kinesphere as ks

nan = float("nan")
nobody: Any = None


class Things:
    """Of every way."""

    def __init__(self) -> None:
        self.motion = ks.Ballistic([(0, 0, 0), (10, 0, 0), (0, 30, 0)], [(1, 0, 0), (0, 0, 0), (0, 0, 0)])
        room = ((-99, -99, -99), (99, 99, 99))
        self.w, self.another, self.tight = (
            ks.World(box=room),
            ks.World(box=room),
            ks.World(allow_overlap=False),
        )
        self.plane = ks.World(dimensions=2)
        definitions = [self.motion.definitions(0.0, k) for k in range(3)]
        self.a, self.b, self.gone = (self.w.add(**each)[0] for each in definitions)
        self.foreign = self.another.add((0.0, 0.0, 0.0))
        self.post = self.w.add_static(ks.Ball((50, 0, 0), 1))
        self.w.remove(self.gone)
        self.tight.add((0.0, 0.0, 0.0))
        self.half = self.w.save()[: len(self.w.save()) // 2]

    def probe_with_nan(self, ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        return np.full((len(ids), 3), nan), np.zeros((len(ids), 3))

    def probe_that_saves(self, ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        self.w.save()
        return self.motion(ids, t)


# The call, the code of the error, and the named argument and body.
Way = tuple[Callable[[Things], Any], str, str, Optional[str]]
ways: list[Way] = [
    (lambda o: o.w.remove(77), "unknown_body", "body", "77"),
    (lambda o: o.w.set_velocity(ks.no_body, (0, 0, 0)), "unknown_body", "body", None),
    (lambda o: o.w.set_radius(o.gone, 1), "stale_body", "body", "2"),
    (lambda o: o.w.teleport(o.foreign, (0, 0, 0)), "foreign_body", "body", "0"),
    (lambda o: o.w.remove([o.a, o.a]), "stale_body", "bodies", "0"),
    (lambda o: o.w.safe_until(o.a, o.a), "out_of_range", "second", "0"),
    (lambda o: o.w.safe_until(o.a, o.foreign, 50.0), "foreign_body", "body", "0"),
    (lambda o: o.w.earliest_approach(o.a, -1.0), "out_of_range", "distance", None),
    (lambda o: o.w.add((0, 0, 0), (0, nan, 0)), "not_finite", "velocity", None),
    (lambda o: o.w.add((0, 0, 0), radii=-0.5), "out_of_range", "radius", None),
    (lambda o: o.w.set_radius(o.a, nan), "not_finite", "radius", "0"),
    (lambda o: o.w.sleep(o.post), "static_body", "body", "3"),
    (lambda o: o.w.set_motion_limits(o.a, -1), "out_of_range", "acceleration_limit", "0"),
    (lambda o: o.w.set_velocity(o.a, (nan, 0, 0)), "not_finite", "velocity", "0"),
    (lambda o: o.w.add((500, 0, 0)), "outside_domain", "position", None),
    (lambda o: o.w.teleport(o.a, (0, 0, -101)), "outside_domain", "position", "0"),
    (lambda o: o.tight.add((1e9, 0, 0)), "out_of_range", "position", None),
    (lambda o: o.tight.add((1, 0, 0)), "overlapping", "position", None),
    (lambda o: ks.World(contact_tolerance=0), "out_of_range", "contact_tolerance", None),
    (lambda o: ks.World(dimensions=4), "out_of_range", "dimensions", None),
    (lambda o: ks.World(box=((0, 0, 0), (1, 0, 1))), "out_of_range", "box", None),
    (lambda o: ks.World(periodic="x"), "out_of_range", "periodic", None),
    (lambda o: ks.World(box=((0, 0, 0), (1, 1, 1e12))), "out_of_range", "contact_tolerance", None),
    (lambda o: ks.World(box=((0, 0, 0), (9, 9, 9)), periodic="z", dimensions=2), "out_of_range", "periodic", None),
    (lambda o: o.plane.add((0, 0, 1)), "out_of_range", "position", None),
    (lambda o: o.plane.add_zone(ks.Triangle((0, 0, 0), (1, 0, 0), (0, 1, 0))), "unsupported", "shape", None),
    (lambda o: o.w.add_static(ks.Box((1, 1, 1), (0, 2, 2))), "out_of_range", "shape", None),
    (lambda o: o.w.add_zone(ks.Triangle((0, 0, 0), (1, 0, 0), (2, 0, 0))), "out_of_range", "shape", None),
    (lambda o: o.w.set_sensor(1, [5.0, -1.0]), "out_of_range", "sensor", None),
    (lambda o: o.w.set_velocity(o.post, (0, 0, 0)), "static_body", "body", "3"),
    (lambda o: o.w.enable(o.a, (0, 0, 0)), "enabled_body", "body", "0"),
    (lambda o: o.w.ray_cast((0, 0, 0), (0, 0, 0), 1.0), "out_of_range", "direction", None),
    (lambda o: o.w.nearest((nan, 0, 0), 1), "not_finite", "point", None),
    (lambda o: o.w.advance(nan, o.motion), "not_finite", "until", None),
    (lambda o: o.w.advance(-1, o.motion), "time_backwards", "until", None),
    (lambda o: o.w.advance(1, nobody), "null_probe", "probe", None),
    (lambda o: o.w.run(1, nobody), "null_probe", "probe", None),
    (lambda o: o.w.advance(20, o.probe_with_nan), "not_finite", "position", "any"),
    (lambda o: o.w.advance(10, o.probe_that_saves), "probe_in_progress", "", None),
    (lambda o: ks.World.restore(o.half), "bad_snapshot", "snapshot", None),
    (lambda o: ks.Replay(o.half), "bad_recording", "recording", None),
    (lambda o: o.w.stop_recording(), "not_recording", "", None),
    (lambda o: o.motion.set_velocity(9, 0, (0, 0, 0)), "unknown_body", "body", "9"),
    (lambda o: o.w.body(o.gone), "stale_body", "body", "2"),
    (lambda o: o.motion.states(0, 9), "unknown_body", "body", "9"),
    (lambda o: o.w.add([(0, 0, 0), (5, 0, 0)], radii=[1, -1]), "out_of_range", "radius", None),
    (lambda o: ks.BodyMap().set_velocity(o.w, o.a, (0, 0, 0)), "unknown_body", "body", "0"),
    (lambda o: in_another_thread(o), "in_use", "world", None),
]  # fmt: skip


def in_another_thread(things: Things) -> None:
    """A world that is used while it is used: the way of Python's that has the place of a world that was moved from."""
    raised: list[ks.StateError] = []

    def use() -> None:
        try:
            len(things.w)
        except ks.StateError as error:
            raised.append(error)

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        other = threading.Thread(target=use)
        other.start()
        other.join()
        return things.motion(ids, t)

    things.w.run(20.0, probe)
    raise raised[0]


@pytest.mark.parametrize("number", range(len(ways)))
def test_a_wrong_way_is_named(number: int) -> None:
    wrong, code, argument, body = ways[number]
    things = Things()
    with pytest.raises(ks.KinesphereError) as caught:
        wrong(things)
    error = caught.value
    assert error.code == code and str(error)
    if argument:
        assert argument in error.argument or argument in str(error)
    if body not in (None, "any"):
        assert str(error.body) == body
    assert body is None or error.body is not None
    # The wrong calls have changed nothing, and the world goes on.
    assert len(things.w) == 3 and things.w.audit() is None
    things.w.remove(things.post)
    things.w.run(things.w.time + 5.0, things.motion)


def test_there_are_48_ways() -> None:
    assert len(ways) == 48


Answer = Callable[[Ids], Any]
answers: list[tuple[Answer, type[Exception], str]] = [
    (lambda ids: None, ks.InvalidValue, r"probe must return \(positions, velocities\), but returned NoneType"),
    (lambda ids: (np.zeros((len(ids), 3)),), ks.InvalidValue, "but returned 1 things"),
    (lambda ids: np.zeros((2, len(ids), 3)), ks.InvalidValue, "but returned ndarray"),
    (lambda ids: (np.zeros((len(ids) + 1, 3)), np.zeros((len(ids), 3))), ks.InvalidValue, r"positions of the probe must have shape \(n, 3\) with n = \d+"),
    (lambda ids: (np.zeros((len(ids), 3)), np.zeros((len(ids), 2))), ks.InvalidValue, "velocities of the probe must have shape"),
    (lambda ids: (np.zeros((len(ids), 3)), np.zeros(3)), ks.InvalidValue, "velocities of the probe must have shape"),
    (lambda ids: (np.zeros((len(ids), 3), dtype=complex), np.zeros((len(ids), 3))), TypeError, "positions of the probe must be real numbers"),
    (lambda ids: ([["a", "b", "c"]] * len(ids), np.zeros((len(ids), 3))), TypeError, "real numbers"),
    (lambda ids: (np.full((len(ids), 3), np.inf), np.zeros((len(ids), 3))), ks.InvalidValue, "of body . must be finite|finite"),
    (lambda ids: (np.full((len(ids), 3), 1e300), np.zeros((len(ids), 3))), ks.InvalidValue, "position"),
    (lambda ids: 1 / 0, ZeroDivisionError, "division"),
]  # fmt: skip


@pytest.mark.parametrize("number", range(len(answers)))
def test_wrong_answers_of_a_probe_are_named_and_dropped(number: int) -> None:
    answer, kind, message = answers[number]
    things = Things()
    things.w.remove(things.post)

    def probe(ids: Ids, t: float) -> Any:
        return answer(ids)

    for _ in range(2):
        with pytest.raises(kind, match=message):
            things.w.run(20.0, probe)
    expected = ks.World(**things.w.definition)
    expected.add(**things.motion.definitions(0.0, [0, 1]))
    assert str(ks.EventHash().add(things.w.run(20.0, things.motion))) == str(
        ks.EventHash().add(expected.run(20.0, things.motion))
    )


def test_a_probe_may_return_views_lists_float32_and_read_only_arrays() -> None:
    hashes = set()
    table = np.zeros((3, 8), order="F")
    for kind in range(4):
        things = Things()
        things.w.remove(things.post)

        def probe(ids: Ids, t: float) -> Any:
            places, speeds = things.motion(ids, t)
            places = places.astype(np.float32).astype(np.float64)
            if kind == 0:
                return [list(row) for row in places], tuple(tuple(row) for row in speeds)
            if kind == 1:
                return places.astype(np.float32), speeds.astype(np.int8)
            if kind == 2:
                table[ids, :3], table[ids, 5:] = places, speeds
                return table[ids][:, :3], table[ids][::-1, 5:][::-1]
            places.flags.writeable = False
            return [places, speeds]

        hashes.add(str(ks.EventHash().add(things.w.run(20.0, probe))))
    assert len(hashes) == 1


respond_answers: list[tuple[Any, type[Exception], str]] = [
    (
        5,
        ks.InvalidValue,
        r"respond must return None, \(first velocity, second velocity\) or .*, but returned 5",
    ),
    (((1, 2), None), ks.InvalidValue, r"first_velocity must have shape \(3,\)"),
    (((nan, 0, 0), None), ks.InvalidValue, "first_velocity"),
    (
        ("up", None),
        ks.InvalidValue,
        "first_velocity must be a velocity, None, 'remove', 'disable' or 'sleep'",
    ),
    ((None, None, None), ks.InvalidValue, "respond must return"),
    ((None, None, "halt"), ks.InvalidValue, "respond must return .*'stop'.*, but returned .*halt"),
    ((None, None, "stop"), TypeError, "'stop' needs at_stop"),
]


@pytest.mark.parametrize("number", range(len(respond_answers)))
def test_wrong_answers_of_a_response_are_named(number: int) -> None:
    answer, kind, message = respond_answers[number]
    things = Things()
    for threads in (1, 2):
        with pytest.raises(kind, match=message):
            things.w.run(20.0, things.motion, lambda event: answer, threads=threads)
    things.w.remove(things.post)
    assert len(things.w.run(20.0, things.motion, ks.Bouncing())) > 0


def test_wrong_kinds_of_things_are_named() -> None:
    things = Things()
    wrong: list[tuple[Callable[[], Any], type[Exception], str]] = [
        (lambda: things.w.remove("all"), TypeError, "remove: bodies must be"),  # type: ignore[arg-type]
        (lambda: things.w.remove(1.0), TypeError, "remove: bodies must be"),  # type: ignore[arg-type]
        (lambda: things.w.remove(np.array([0.0])), TypeError, "whole numbers"),
        (lambda: things.w.remove(np.array([True, False])), TypeError, "whole numbers"),
        (lambda: things.w.remove([True, False]), TypeError, "bodies must be the id of a body, but is True"),
        (lambda: things.w.body(True), TypeError, "must be the id of a body, but is True"),
        (lambda: things.w.remove(np.zeros((2, 2), dtype=int)), ks.InvalidValue, r"shape \(n,\)"),
        (lambda: things.w.body(-1), ks.BodyError, "body"),
        (lambda: things.w.body(2**70), ks.BodyError, "body"),
        (lambda: things.w.body(None), ks.BodyError, "body"),  # type: ignore[arg-type]
        (lambda: things.w.body("0"), TypeError, "must be the id of a body"),  # type: ignore[arg-type]
        (lambda: things.w.run(1, 5), TypeError, "probe must be a motion or a function"),  # type: ignore[call-overload]
        (lambda: things.w.run(1, things.motion, 5), TypeError, "respond must be"),  # type: ignore[call-overload]
        (lambda: things.w.run(1, things.probe_that_saves, ks.Bouncing()), TypeError, "loop over world.events"),
        (lambda: things.w.run(1, things.motion, threads=-3), ks.InvalidValue, "threads"),
        (lambda: things.w.add_static((0, 0, 0)), TypeError, "shape must be a Ball, Box, HalfSpace, Triangle or Mesh"),  # type: ignore[arg-type]
        (lambda: things.w.add((0, 0, 0), sensor_classes=300), ks.InvalidValue, r"\[0, 255\]"),
        (lambda: things.w.add((0, 0, 0), masks=-1), ks.InvalidValue, "2\\^64"),
        (lambda: things.w.add((0, 0, 0), group=2**40), ks.InvalidValue, "32 bits"),
        (lambda: ks.Bouncing(masses=[1.0, -1]), ks.InvalidValue, "masses must be > 0"),
        (lambda: ks.Bouncing(0.5), ks.InvalidValue, "masses must have one number for each body .*restitution=0.5"),
        (lambda: ks.Bouncing(restitution=2), ks.InvalidValue, "restitution"),
        (lambda: ks.Bouncing(masses=np.ones((2, 2))), ks.InvalidValue, "masses must have shape"),
        (lambda: things.w.run(20, things.motion, ks.Bouncing(masses=[1.0])), ks.InvalidValue, "masses must have one number for each body"),
        (lambda: ks.bounce(things.w.clone().run(20.0, things.motion, ks.Bouncing())[0], 0.5), ks.InvalidValue, "second_mass must be given with .*restitution=0.5"),
        (lambda: ks.bounce(things.w.clone().run(20.0, things.motion, ks.Bouncing())[0], restitution=5), ks.InvalidValue, "bounce: restitution must lie in"),
        (lambda: ks.bounce_rigid(things.w.clone().run(20.0, things.motion, ks.Bouncing())[0], -1), ks.InvalidValue, "bounce_rigid: restitution must lie in"),
        (lambda: ks.settle(things.w.clone().run(20.0, things.motion, ks.Bouncing())[0], 1, 1, 0.5, np.nan), ks.InvalidValue, "settle: resting_speed must be finite"),
        (lambda: ks.World(periodic="w"), ks.InvalidValue, "letters x, y and z"),
        (lambda: ks.World(box=((0, 0, 0), (9, 9, 9)), periodic="xyz", dimensions=2), ks.InvalidValue, 'such as "xy", but is .xyz.'),
        (lambda: ks.World(periodic=3), TypeError, "periodic"),  # type: ignore[arg-type]
        (lambda: ks.World(contacts="some"), ks.InvalidValue, "begin_and_end"),  # type: ignore[arg-type]
        (lambda: things.w.add((0, 0, 0), contacts="some"), ks.InvalidValue, "add: contacts must be"),  # type: ignore[call-overload]
        (lambda: things.w.busiest(), ks.StateError, "set_profiling"),
        (lambda: ks.World(separation_distance=nan), ks.InvalidValue, "separation_distance"),
        (lambda: ks.World(box=(1, 2, 3)), ks.InvalidValue, "box"),
        (lambda: ks.World.restore("text"), TypeError, "snapshot must be bytes"),  # type: ignore[arg-type]
        (lambda: ks.World.restore(b""), ks.InvalidValue, "snapshot"),
        (lambda: ks.SteeredMotion([(0, 0, 0)]).read_body(b"junk"), ks.InvalidValue, "read_body"),
        (lambda: ks.read_recording(things.another.save()), ks.InvalidValue, "recording"),
    ]  # fmt: skip
    for call, kind, message in wrong:
        with pytest.raises(kind, match=message):
            call()


def test_calls_that_fit_no_function_name_the_argument() -> None:
    things = Things()
    w, motion = things.w, things.motion
    frames = ks.FrameMotion([(0, 0, 0)])
    wrong: list[tuple[Callable[[], Any], str]] = [
        (lambda: ks.World(contact_tolerence=1e-3), "World: there is no argument contact_tolerence; the nearest is contact_tolerance"),  # type: ignore[call-arg]
        (lambda: w.add((0, 0, 0), radius=1.0), "add: there is no argument radius; the nearest is radii"),  # type: ignore[call-overload]
        (lambda: ks.Ball((0, 0, 0), r=1.0), "Ball: there is no argument r; the nearest is radius"),  # type: ignore[call-arg]
        (lambda: ks.Scene("paper1", colour=1), "Scene: there is no argument colour; "),  # type: ignore[call-arg]
        (lambda: ks.Separation.sphere(dist=3.0), "sphere: there is no argument dist; the nearest is distance"),  # type: ignore[call-arg]
        (lambda: ks.place_spheres(0.5, ((0, 0, 0), (9, 9, 9)), pack=0.2), "place_spheres: there is no argument pack; the nearest is packing"),  # type: ignore[call-arg]
        (lambda: frames.push(positons=[(0, 0, 0)]), "push: there is no argument positons; the nearest is positions"),  # type: ignore[call-overload]
        (lambda: w.run(1.0), "run: motion is missing"),  # type: ignore[call-overload]
        (lambda: w.run(1.0, motion, until=2.0), "run: until is given twice"),  # type: ignore[call-overload]
        (lambda: w.run(1.0, motion, None, 2), "run: takes at most 3 arguments without a name, but has 4; .*threads.* need theirs"),  # type: ignore[call-overload]
        (lambda: w.run(motion, 1.0), "run: until must be a number, but is <"),  # type: ignore[call-overload]
        (lambda: ks.Ball(1.0, (0, 0, 0)), r"Ball: radius must be a number, but is \(0, 0, 0\)"),  # type: ignore[arg-type]
        (lambda: w.add_motion(w), "add_motion: motion must be a Motion, but is <"),  # type: ignore[arg-type]
        (lambda: w.add_zone(ks.Ball((0, 0, 0), 1.0), -1), "add_zone: user_data must be a whole number in its range, but is -1"),
        (lambda: w.set_solid(0, "no"), "set_solid: solid must be True or False, but is 'no'"),  # type: ignore[arg-type]
        (lambda: w.run(np.datetime64("2024-01-01"), motion), "run: until must be a number, but is "),  # type: ignore[call-overload]
        (lambda: motion.states(np.array([0, 1]), 0.1), "states: t must be a number, but is "),  # type: ignore[arg-type]
        (lambda: w.run(1.0, motion, ks.Bouncing), "run: respond must be a Bouncing, a Roughness, a StepPotential, a dict of these, a Scene or a function of an event, but is <class "),  # type: ignore[arg-type]
        (lambda: w.run(1.0, ks.Ballistic), "run: probe must be a motion or a function .*, but is <class "),  # type: ignore[arg-type]
        (lambda: w.run(1.0, motion.states), "states: t must be a number, but is "),  # type: ignore[arg-type]
        (lambda: ks.World(dimensions=2.5), "World: dimensions must be a whole number, but is 2.5"),  # type: ignore[arg-type]
    ]  # fmt: skip
    for call, message in wrong:
        with pytest.raises(TypeError, match=message) as raised:
            call()
        assert "\n" not in str(raised.value) and len(str(raised.value)) < 400
    with pytest.raises(TypeError, match="supported"):  # which of the two was meant is not known
        frames.push(1, 2, 3, 4)  # type: ignore[call-overload]


def test_a_motion_that_nobody_added_is_not_a_run_without_events() -> None:
    things = Things()
    source = ks.MotionSource(lambda ids, t, since, places, speeds: (places, speeds), [(0, 0, 0)])
    world = ks.World()
    world.add_static(ks.Ball((0, 0, 0), 1.0))
    probes: list[Any] = [things.motion, source]
    calls: list[Callable[..., Any]] = [world.run, world.advance, lambda *given: next(world.events(*given))]
    for probe in probes:
        for call in calls:
            with pytest.raises(
                ks.InvalidValue, match=r"motion must move bodies that have been added .*add_motion"
            ):
                call(1.0, probe)
    world.add((50.0, 0, 0))
    world.run(1.0, things.motion)
    world.remove(world.bodies())
    assert len(world.run(2.0, things.motion)) == 0, "all were removed"
    assert len(ks.World().run(1.0, ks.Ballistic([]))) == 0
    assert len(ks.World().run(1.0, things.probe_with_nan)) == 0, "a function may wait for bodies"


def test_errors_can_be_caught_as_python_does_and_pickled() -> None:
    import pickle

    things = Things()
    with pytest.raises(ValueError) as value:
        things.w.add((0, 0, nan))
    with pytest.raises(LookupError):
        things.w.body(77)
    with pytest.raises(RuntimeError):
        things.w.stop_recording()
    again = pickle.loads(pickle.dumps(value.value))
    assert (again.code, again.argument, str(again)) == ("not_finite", "position", str(value.value))


def test_a_refused_change_through_a_map_leaves_the_motion() -> None:
    motion = ks.Ballistic([(1, 1, 1)], [(1, 0, 0)])
    world, bodies = ks.World(box=((0, 0, 0), (9, 9, 9))), ks.BodyMap()
    ids = bodies.add_all(world, motion, 0.5)
    with pytest.raises(ks.InvalidValue, match="position of body 0 must lie in the box"):
        bodies.teleport(world, int(ids[0]), (99, 0, 0), (0, 0, 0))
    assert np.array_equal(motion.states(0.0)[0], [(1, 1, 1)])


def test_a_map_that_served_another_world_since_says_so() -> None:
    world, other, bodies = ks.World(), ks.World(), ks.BodyMap()
    bodies.add_all(world, ks.Ballistic([(0, 0, 0), (5, 0, 0)], [(1, 0, 0), (0, 0, 0)]), 0.5)
    bodies.add_all(other, ks.Ballistic([(0, 9, 0), (5, 0, 0)], [(0, 0, 0), (0, 0, 0)]), 0.5)
    with pytest.raises(ks.BodyError, match="the map has served another world since"):
        world.run(10.0, bodies)


def test_a_body_that_sleeps_and_moves_on_breaks_its_promise() -> None:
    motion, world = ks.Ballistic([(0, 0, 0)], [(1, 0, 0)]), ks.World()
    ids = world.add_motion(motion, 0.5)
    world.sleep(ids)
    assert [event.kind for event in world.events(1.0, motion)] == [ks.EventKind.bound_violation]
