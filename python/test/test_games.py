"""Worlds that move their own bodies."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import kinesphere as ks


def falling(respond: Any = None, **settings: Any) -> tuple[ks.GameWorld, int]:
    """A ball of radius 1/2 that falls from a height of 5."""
    settings = {"box": ((0, 0, 0), (10, 10, 10)), "contacts": "impacts", **settings}
    game = ks.GameWorld(gravity=(0, 0, -10), respond=respond, **settings)
    return game, game.add((5, 5, 5), radii=0.5)


def test_a_game_moves_its_bodies() -> None:
    game, ball = falling(ks.Bouncing(restitution=0.5, resting_speed=0.1))
    assert len(game.step(0.5)) == 0 and game.time == 0.5
    assert game.ids.tolist() == [ball] and game.velocities.tolist() == [[0, 0, -5]]
    before = game.positions
    for array in (before, game.velocities):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
    assert before == pytest.approx(np.array([[5, 5, 3.75]]), abs=1e-12)
    others = game.add([(2, 2, 2), (8, 8, 8)], radii=[0.5, 1])
    game.remove(ball)
    assert game.ids.tolist() == [others[1], others[0]] and len(game) == 2 and ball not in game
    assert game.index_of(others[0]) == 1 and before.shape == (1, 3)
    game.set_gravity((0, 0, 0))
    game.set_velocities([(0, 1, 0), (0, 0, 0)])
    game.set_acceleration(others[0], (0, 0, 4))
    for one in (game, game.clone(), copy.deepcopy(game), pickle.loads(pickle.dumps(game))):
        assert isinstance(one, ks.GameWorld) and not one.gravity.any()
        one.step(0.5)
        assert one.velocities.tolist() == [[0, 1, 0], [0, 0, 2]]
        assert one.overlapping((2, 2, 2.5), 0.1)["body"].tolist() == [others[0]]
    assert repr(game) == "<GameWorld of 2 bodies at 1.0>"


def test_all_calls_of_worlds_change_games() -> None:
    game, ball = falling()
    other = game.add((2, 5, 5), radii=0.5)
    game.teleport(ball, (5, 5, 8), (0, 0, -3))
    game.set_velocity([ball, other], [(1, 0, 0), (0, 1, 0)])
    game.disable(other)
    game.enable(other, (3, 5, 5), (0, 0, 1))
    game.sleep(other)
    assert game.positions.tolist() == [[5, 5, 8], [3, 5, 5]] and game.velocities.tolist() == [
        [1, 0, 0],
        [0, 0, 0],
    ]
    game.wake(other)
    game.add_moving_shape(ks.Box((-1, -1, 0), (1, 1, 0.5)), (8, 8, 1), planned_acceleration=(0, 0, 10))
    game.add_rigid_body([ks.Ball((0, 0, 0), 0.5)], (8, 8, 5), angular_velocity=(0, 0, 1))
    game.add_zone(ks.Box((0, 0, 0), (10, 10, 3)))
    kinds = [str(event.kind) for event in game.step(0.6).of_kind(ks.EventKind.woke)]
    assert kinds == ["woke"] and len(game.ids) == 4 and len(game) == 5
    assert game.velocities[:, 2] == pytest.approx([-6, -6, 0, -6])


def test_a_response_answers_events() -> None:
    calls = []

    def respond(event: ks.Event) -> Any:
        calls.append(event)
        if len(calls) == 2:
            raise RuntimeError("a slip of the pen")
        return ks.bounce(event) if len(calls) == 1 else ("remove", None)

    game, ball = falling(respond)
    event = game.advance(2.0)
    assert event is not None and event.kind == ks.EventKind.wall_begin and event.first == ball
    assert game.time == event.time and game.velocities[0, 2] > 0
    assert list(game.events(2.0)) == [] and game.time == 2.0
    with pytest.raises(RuntimeError, match="a slip of the pen"):
        game.step(2.0)
    assert len(game.step(2.0)) == 1 and len(game.ids) == 0
    game.respond = None
    assert game.respond is None
    with pytest.raises(TypeError, match="GameWorld: respond must be a Bouncing"):
        game.respond = 3  # type: ignore[assignment]


def test_wells_hold_the_bodies_of_a_game() -> None:
    game = ks.GameWorld(contacts="impacts")
    game.respond = ks.StepPotential(game, [0.5], [-1.0])
    game.set_sensor(0, [0.5])
    game.add([(0, 0, 0), (1.2, 0, 0)], [(0.5, 0, 0), (-0.5, 0, 0)], radii=0.5)
    events = game.step(40.0)
    assert len(events.of_kind(ks.EventKind.sensor_leave)) == pytest.approx(40, abs=1)
    assert abs(game.positions[1, 0] - game.positions[0, 0]) < 1.5 + 1e-6


def test_wrong_use_is_told() -> None:
    game, ball = falling()
    for dt in (0.0, np.nan):
        with pytest.raises(ks.InvalidValue, match="GameWorld::step: dt must be"):
            game.step(dt)
    with pytest.raises(ks.InvalidValue, match="velocities must have one entry per body, 1, but is 2"):
        game.set_velocities(np.zeros((2, 3)))
    with pytest.raises(ks.InvalidValue, match="velocity of body 0 must be finite"):
        game.set_velocities([(0, np.nan, 0)])
    with pytest.raises(ks.KinesphereError, match="gravity must be finite"):
        ks.GameWorld((0, 0, np.inf))
    with pytest.raises(TypeError, match="no_such_thing"):
        ks.GameWorld(no_such_thing=1)
    still = ks.Ballistic([(0, 0, 0)], [(0, 0, 0)])
    calls: list[Callable[[], object]] = [
        lambda: ks.World.advance(game, 1.0, still),
        lambda: game.run(1.0, still),
        lambda: game.add_motion(still),
        lambda: game.set_motion_limits(ball, 1.0),
        lambda: next(ks.World.events(game, 1.0, still)),
    ]
    for call in calls:
        with pytest.raises(ks.StateError, match="world must be moved by others, but a GameWorld moves"):
            call()
    game.remove(ball)
    with pytest.raises(ks.KinesphereError, match="has been removed"):
        game.index_of(ball)
    with pytest.raises(ks.InvalidValue, match="snapshot"):
        ks.World.restore(game.save())

    def call_back(event: ks.Event) -> None:
        game.step(1.0)

    game.respond = call_back
    game.add((5, 5, 5), radii=0.5)
    with pytest.raises(ks.StateError, match="must not be called inside its own response"):
        game.step(2.0)
