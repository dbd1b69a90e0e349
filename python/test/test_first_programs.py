"""What people write first is right: no ball leaves its box or passes through another, energy is kept."""

import inspect
import textwrap
import warnings
from typing import Any, Callable

import numpy as np
import pytest
from numpy.typing import NDArray

import kinesphere as ks

Doubles = NDArray[np.float64]


def deepest(positions: Doubles, radius: float, size: float) -> float:
    """The deepest overlap of balls with each other and with the walls of a box from 0 to size."""
    offsets = positions[:, None] - positions[None]
    distances = np.sqrt((offsets**2).sum(2)) + np.where(np.eye(len(positions)) > 0, np.inf, 0)
    return float(
        max(2 * radius - distances.min(), (radius - positions).max(), (positions + radius - size).max())
    )


def test_the_program_of_the_docstring() -> None:
    text = inspect.getdoc(ks)
    assert text is not None
    program = textwrap.dedent("\n".join(line for line in text.splitlines() if line.startswith("    ")))
    names: dict[str, Any] = {}
    exec(program, names)
    world, motion = names["world"], names["motion"]
    assert world.time == 10.0 and len(names["events"]) > 100
    assert deepest(np.asarray(motion.states(10.0)[0]), 1.0, 100.0) < 1e-6


@pytest.mark.parametrize("contacts", ["all", "impacts", "begin_and_end", None])
@pytest.mark.parametrize(
    ("balls", "radius", "gravity", "restitution"),
    [(8, 0.415, 0.0, 1.0), (5, 0.49, 0.0, 1.0), (3, 0.5, 0.0, 1.0), (6, 0.4, 10.0, 0.9), (6, 0.4, 10.0, 0.5)],
)
def test_bouncing_balls_never_pass(
    contacts: str | None, balls: int, radius: float, gravity: float, restitution: float
) -> None:
    rng = np.random.default_rng(1)
    size = float(balls)
    positions = np.stack(np.meshgrid(*[np.arange(balls) + 0.5] * 3, indexing="ij"), -1).reshape(-1, 3)
    velocities = rng.normal(0, 1, positions.shape)
    motion = ks.Ballistic(positions, velocities, gravity=(0, 0, -gravity))
    choice: dict[str, Any] = {} if contacts is None else {"contacts": contacts}
    world = ks.World(box=((0, 0, 0), (size, size, size)), contact_tolerance=1e-6, **choice)
    world.add_motion(motion, radii=radius)
    for step in range(1, 11):
        world.run(0.1 * step, motion, ks.Bouncing(restitution=restitution))
        now, speeds = (np.asarray(part) for part in motion.states(world.time))
        assert deepest(now, radius, size) < 2e-6, step
    energy = 0.5 * (speeds**2).sum() + gravity * now[:, 2].sum()
    before = 0.5 * (velocities**2).sum() + gravity * positions[:, 2].sum()
    if restitution == 1.0 and radius < 0.5:
        assert energy == pytest.approx(before, rel=1e-9)
    else:  # without any room, jammed contacts return no speed
        assert energy < before


def test_bodies_ask_for_their_own_events() -> None:
    kinds = {}
    for contacts in ("all", "begin_and_end", "impacts", None):
        world = ks.World(contacts="impacts")
        world.add([[0.0, 0, 0]], [[1.0, 0, 0]])
        world.add([[5.0, 0, 0]], contacts=contacts)  # type: ignore[arg-type]
        events = world.run(
            10.0,
            lambda ids, t: (
                np.stack([np.where(ids == 0, t, 5.0), 0 * ids, 0 * ids], -1),
                np.stack([np.where(ids == 0, 1.0, 0), 0 * ids, 0 * ids], -1),
            ),
        )
        kinds[contacts] = [str(event.kind) for event in events]
    both = ["contact_begin", "contact_end"]
    assert kinds == {"all": both, "begin_and_end": both, "impacts": both[:1], None: both[:1]}
    with pytest.raises(ks.InvalidValue, match='add: contacts must be "all", "begin_and_end" or "impacts"'):
        ks.World().add([[0.0, 0, 0]], contacts="hits")  # type: ignore[call-overload]


def test_a_motion_of_ones_own_is_asked_once_for_each_instant() -> None:
    scene = ks.Scene("periodic_gas", bodies=200, packing=0.3, seconds=40)
    positions, velocities = (np.asarray(part) for part in scene.motion().states(0.0))
    asked: list[tuple[float, tuple[int, ...]]] = []

    def straight_on(
        ids: NDArray[Any], t: float, since: Doubles, places: Doubles, speeds: Doubles
    ) -> tuple[Doubles, Doubles]:
        if len(ids) <= 2:
            asked.append((t, tuple(sorted(int(body) for body in ids))))
        return places + speeds * (t - since), speeds

    world = ks.World(**scene.definition)
    world.add(positions, velocities, scene.radii)
    events = world.run(2.0, ks.MotionSource(straight_on, positions, velocities), ks.Bouncing())
    calls = {event.time: [] for event in events}  # type: dict[float, list[tuple[int, ...]]]
    for t, bodies in asked:
        if t in calls:
            calls[t].append(bodies)
    assert len(events) > 500
    pairs = {
        event.time: tuple(sorted((int(event.first), int(event.second))))
        for event in events
        if event.second is not None
    }
    alone = [t for t, bodies in calls.items() if bodies == [pairs[t]]]
    assert len(alone) > 0.95 * len(calls)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_stack_that_hops_for_ever_warns_and_names_what_lets_it_settle(restitution: float) -> None:
    def run(**resting: float) -> float:
        motion = ks.Ballistic([(5, 5, 1.2 + 2.2 * k) for k in range(3)], gravity=(0, 0, -10))
        world = ks.World(box=((0, 0, 0), (10, 10, 30)))
        world.add_motion(motion, radii=1.0)
        for step in range(1, 21):  # as a game has it
            world.run(0.5 * step, motion, ks.Bouncing(restitution=restitution, **resting))
        return float((np.asarray(motion.states(world.time)[1]) ** 2).sum())

    with pytest.warns(RuntimeWarning, match="contacts followed another one at once.*resting_speed") as told:
        run()
    assert len(told) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert run(resting_speed=0.1) < 0.1


@pytest.mark.parametrize("gap, restitution", [(2e-7, 1.0), (1e-4, 1.0)])
def test_a_crystal_without_room_warns_once_that_it_loses_energy(gap: float, restitution: float) -> None:
    side = 3
    pitch = (1 + gap) * np.sqrt(2)
    corners = np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])
    cells = np.stack(np.meshgrid(*[range(side)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    positions = ((cells + corners) * pitch).reshape(-1, 3)
    motion = ks.Ballistic(positions, np.random.default_rng(1).normal(size=positions.shape))
    world = ks.World(box=((0,) * 3, (side * pitch,) * 3), periodic=True, contacts="impacts")
    world.add_motion(motion, radii=0.5)

    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        for step in range(1, 4):
            world.run(4 * step * gap, motion, ks.Bouncing(restitution=restitution))
    jammed = world.counters.jammed_contacts
    if gap > 1e-6:
        assert jammed == 0 and not told
    else:
        assert jammed > 0 and len(told) == 1
        assert "contacts were jammed" in str(told[0].message) and "contact_tolerance" in str(told[0].message)


def falling(**limits: Any) -> tuple[ks.World, Any]:
    """A ball that falls from 10 onto another one at 0, and its probe."""
    world = ks.World()
    world.add([(0, 0, 10), (0, 0, 0)], radii=1.0, **limits)

    def probe(ids: NDArray[Any], t: float) -> tuple[Doubles, Doubles]:
        return np.array([(0, 0, 10 - 5 * t * t), (0, 0, 0)])[ids], np.array([(0, 0, -10 * t), (0, 0, 0)])[ids]

    return world, probe


def test_a_forgotten_gravity_warns_once_in_runs_and_loops() -> None:
    ways: list[Callable[[ks.World, Any], object]] = [
        lambda world, probe: [world.run(t, probe) for t in (0.5, 1.0, 2.0)],
        lambda world, probe: [event for t in (0.5, 1.0, 2.0) for event in world.events(t, probe)],
    ]
    for go in ways:
        with pytest.warns(
            RuntimeWarning, match="body 0 broke its promise.*contacts may have been missed"
        ) as told:
            go(*falling())
        assert len(told) == 1
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            go(*falling(planned_accelerations=[(0, 0, -10), (0, 0, 0)]))


def test_a_warning_that_is_an_error_loses_no_event() -> None:
    expected = [[str(event.kind) for event in world.run(2.0, probe)] for world, probe in [falling()]][0]
    assert "bound_violation" in expected
    world, probe = falling()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(RuntimeWarning):
            world.run(2.0, probe)
        assert [str(event.kind) for event in world.run(2.0, probe)] == expected
        world, probe = falling()
        found = []
        for raises in (True, False):
            try:
                for event in world.events(2.0, probe):
                    found.append(str(event.kind))
            except RuntimeWarning:
                assert raises
        assert found == expected


def test_the_length_of_a_step_in_place_of_its_end_warns() -> None:
    def play(until: Any) -> int:
        motion = ks.Ballistic([(0, 0, 0), (5, 0, 0)], [(1, 0, 0), (0, 0, 0)])
        world = ks.World()
        world.add_motion(motion, radii=1.0)
        return sum(len(world.run(until(world, 0.1), motion)) for _ in range(100))

    with pytest.warns(RuntimeWarning, match=r"until is a time, not a duration.*world.time \+ dt") as told:
        assert play(lambda world, dt: dt) == 0
    assert len(told) == 1
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert play(lambda world, dt: world.time + dt) == 2


def test_kinds_are_no_texts() -> None:
    world, probe = falling(planned_accelerations=[(0, 0, -10), (0, 0, 0)])
    events = world.run(2.0, probe)
    kind = events[0].kind
    assert kind == ks.EventKind.contact_begin and kind != ks.EventKind.contact_end and kind == 1 and kind != 2
    assert {kind: "begin"}[1] == "begin"  # type: ignore[index]
    with pytest.raises(TypeError, match="compare with EventKind.contact_end, not with 'contact_end'"):
        kind == "contact_end"
    with pytest.raises(TypeError, match="compare with EventKind.contact_begin, not with 'contact'"):
        kind != "contact"
    with pytest.raises(TypeError, match="Verdict.within"):
        ks.Verdict.apart in ("within", "undecided")
    with pytest.raises(
        TypeError, match="of_kind: kinds must be .*EventKind.bound_violation, but one is 'contact_begin'"
    ):
        events.of_kind("contact_begin")  # type: ignore[arg-type]
