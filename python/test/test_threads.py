"""Threads, signals, callbacks that raise, and objects that are used while they work."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import types
import weakref
from collections.abc import Callable

import numpy as np
import pytest
from conftest import Doubles, Ids, hash_of, pair

import kinesphere as ks


def busy(bodies: int = 400, **settings: float) -> tuple[ks.World, ks.Motion, ks.Scene]:
    scene = ks.Scene("paper1", bodies=bodies, **settings)  # type: ignore[arg-type]
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    return world, motion, scene


def test_threads_share_the_work_with_the_same_outcome() -> None:
    hashes = set()
    every: list[int | ks.Workers] = [1, 2, ks.Workers(3)]
    for threads in every:
        world, motion, scene = busy()
        hashes.add(hash_of(world.run(1.0, motion, scene, threads=threads)))
    world, motion, scene = busy()
    hashes.add(hash_of(world.run(1.0, motion, ks.Bouncing(scene.masses, scene.restitution), threads=2)))
    world, motion, scene = busy()
    masses = scene.masses

    def respond(event: ks.Event) -> object:
        second = masses[event.second] if event.second is not None else 1.0
        return ks.bounce(event, masses[event.first], second, 1.0) if event.approach_speed > 0 else None

    hashes.add(hash_of(world.run(1.0, motion, respond, threads=2)))
    assert len(hashes) == 1
    with pytest.raises(ks.InvalidValue, match="threads"):
        world.run(2.0, motion, threads=0)


def steer(threads: int | ks.Workers | None) -> list[object]:
    """What a crowd meets whose velocities all change in each of four frames."""
    bodies = 5000
    random = np.random.default_rng(1)
    positions = np.stack(np.unravel_index(np.arange(bodies), (18, 18, 18)), axis=-1).astype(float)
    velocities = np.zeros((bodies, 3))
    began = 0.0

    def probe(ids: Ids, time: float) -> tuple[Doubles, Doubles]:
        return positions[ids] + velocities[ids] * (time - began), velocities[ids]

    world = ks.World()
    if threads is not None:
        world.use_threads(threads)
    ids = world.add(positions, radii=0.4)
    told: list[object] = []
    for frame in range(1, 5):
        velocities = random.uniform(-5.0, 5.0, (bodies, 3))
        world.set_velocity(ids, velocities)
        told.extend((event.time, event.first, event.second) for event in world.events(frame / 60.0, probe))
        positions, began = positions + velocities * (world.time - began), world.time
    return told


def test_threads_share_what_a_world_does_for_many_bodies() -> None:
    expected = steer(None)
    assert len(expected) > 100
    shared: list[int | ks.Workers] = [1, 2, ks.Workers(3)]
    for threads in shared:
        assert steer(threads) == expected
    with pytest.raises(ks.InvalidValue, match="threads"):
        ks.World().use_threads(0)


def test_the_gil_is_released_and_another_thread_is_refused() -> None:
    world, motion, scene = busy(2000, packing=0.05)
    outcome: list[object] = []
    runner = threading.Thread(target=lambda: outcome.append(world.run(4.0, motion, scene)))
    runner.start()
    refusals, turns = [], 0
    while runner.is_alive():
        turns += 1
        uses: list[Callable[[], object]] = [
            lambda: len(world),
            lambda: world.add((0, 0, 0)),
            lambda: motion.states(0.0),
            lambda: world.clone(),
        ]
        for use in uses:
            try:
                use()
            except ks.StateError as error:
                refusals.append(error)
            except ks.InvalidValue:
                pass  # the run is over
        time.sleep(0.001)
    runner.join()
    assert len(outcome) == 1 and isinstance(outcome[0], ks.Events) and world.time == 4.0
    assert refusals and {error.code for error in refusals} == {"in_use"} and turns > 3
    assert any("world must be used by one thread at a time" in str(error) for error in refusals)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_run_tells_how_far_it_is(threads: int) -> None:
    world, motion, scene = busy(2000, packing=0.05)
    told: list[float] = []
    read: list[float] = []

    def progress(t: float) -> None:
        told.append(t)
        other = threading.Thread(target=lambda: read.append(world.time))
        other.start()
        other.join()
        if len(told) == 4:
            raise ZeroDivisionError("progress")

    with pytest.raises(ZeroDivisionError, match="progress"):
        world.run(1e6, motion, scene, threads=threads, progress=progress)
    assert read == told == sorted(told) and 0 < told[2] < told[3] <= world.time
    end = world.time + 0.01
    world.run(end, motion, scene, threads=threads, progress=told.append)
    assert told[-1] == world.time == end


def test_a_slow_probe_of_python_tells_how_far_it_is_too() -> None:
    world, motion = pair()
    told: list[float] = []

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        time.sleep(0.06)
        return motion(ids, t)

    world.run(10.0, probe, progress=told.append)
    assert len(told) >= 2 and 0 < told[0] < told[-1] == 10.0
    with pytest.raises(TypeError, match="progress must be a bool or a function"):
        world.run(11.0, motion, progress=3)  # type: ignore[call-overload]


def test_a_bar_is_drawn_by_tqdm_if_it_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    class Drawn:
        n = 0.0
        closed = 0

        def __init__(self, total: float, **form: str) -> None:
            self.total = total
            bars.append(self)

        def update(self, step: float) -> None:
            self.n += step

        def close(self) -> None:
            self.closed += 1

    bars: list[Drawn] = []
    module = types.ModuleType("tqdm.auto")
    module.tqdm = Drawn  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", module)
    world, motion = pair(start_time=0.5)
    world.run(10.0, motion, progress=True)
    assert [(bar.total, bar.n, bar.closed) for bar in bars] == [(9.5, 9.5, 1)]
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)  # type: ignore[misc]
    with pytest.warns(UserWarning, match="progress=True needs tqdm"):
        world.run(11.0, motion, progress=True)


def test_what_a_probe_raises_comes_out_and_the_world_goes_on() -> None:
    world, motion = pair()
    expected = hash_of(world.run(10.0, motion))
    world, motion = pair()
    calls = 0

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        nonlocal calls
        calls += 1
        if calls % 2 == 1:
            raise KeyError("probe")
        return motion(ids, t)

    hash = ks.EventHash()
    for _ in range(50):
        try:
            hash.add(world.run(10.0, probe))
            break
        except KeyError as error:
            assert error.args == ("probe",)
    assert world.time == 10.0 and calls > 1 and str(hash) == expected


@pytest.mark.parametrize("threads", [1, 2])
def test_events_told_before_something_raised_are_not_lost(threads: int) -> None:
    world, motion, scene = busy()
    expected = world.run(1.0, motion, scene)
    world, motion, scene = busy()
    bouncing = ks.Bouncing(scene.masses, scene.restitution)
    broken = [expected[100].time]

    def respond(event: ks.Event) -> object:
        if broken and event.time >= broken[0]:
            broken.clear()
            raise ZeroDivisionError("respond")
        second = scene.masses[event.second] if event.second is not None else 1.0
        return ks.bounce(event, scene.masses[event.first], second) if event.approach_speed > 0 else None

    with pytest.raises(ZeroDivisionError, match="respond"):
        world.run(1.0, motion, respond, threads=threads)
    events = world.run(1.0, motion, bouncing, threads=threads)
    assert hash_of(events) == hash_of(expected)


def test_a_sink_is_told_each_event() -> None:
    world, motion, scene = busy()
    expected = hash_of(world.run(1.0, motion, scene))
    world, motion, scene = busy()
    hash, touching = ks.EventHash(), 0

    def sink(event: ks.Event) -> None:
        nonlocal touching
        hash.add(event)
        touching += len(world.touching(event.first))
        if len(world) == 0:
            world.add((0, 0, 0))

    assert len(world.run(1.0, motion, scene, sink=sink)) == 0
    assert str(hash) == expected


def test_the_world_cannot_be_changed_inside_its_own_callbacks() -> None:
    world, motion = pair()
    codes = []

    def forbidden() -> None:
        uses: list[Callable[[], object]] = [
            lambda: world.add((50, 0, 0)),
            lambda: world.advance(11.0, motion),
            lambda: world.save(),
            lambda: world.clone(),
        ]
        for use in uses:
            with pytest.raises(ks.StateError) as caught:
                use()
            codes.append(caught.value.code)

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        forbidden()
        assert world.time <= t and len(world) == 2
        return motion(ids, t)

    world.run(5.0, probe, sink=lambda event: forbidden())
    assert set(codes) == {"run_in_progress"}
    world, motion = pair()
    codes.clear()
    assert world.advance(5.0, probe) is not None
    assert set(codes) == {"probe_in_progress"}
    asked: list[str] = []

    def respond(event: ks.Event) -> None:
        uses: list[Callable[[], object]] = [
            lambda: motion.states(event.time),
            lambda: motion.set_velocity(0, event.time, (0, 0, 0)),
        ]
        for use in uses:
            with pytest.raises(ks.StateError) as caught:
                use()
            asked.append(caught.value.code)

    world, motion = pair()
    world.run(10.0, motion, respond)
    assert set(asked) == {"in_use"}


def test_what_nobody_holds_any_more_lives_as_long_as_it_is_needed() -> None:
    events = ks.World().events(1.0, ks.Ballistic([]))
    assert list(events) == []
    world, motion = pair()
    loop = world.events(10.0, motion)
    gone = weakref.ref(world)
    del world, motion
    gc.collect()
    assert len(list(loop)) == 2
    del loop
    gc.collect()
    assert gone() is None
    # A probe that drops all references while it runs.
    world, motion = pair()
    holder = [world]

    def probe(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
        holder.clear()
        gc.collect()
        return np.zeros((len(ids), 3)) + ids[:, None] * 10, np.zeros((len(ids), 3))

    del world, motion
    holder[0].set_velocity(0, (0, 0, 0))
    holder[0].run(3.0, probe)


INTERRUPTED = """
import signal, sys, threading, os, time
import kinesphere as ks
scene = ks.Scene("paper1", bodies=3000, packing=0.1)
world, motion = ks.World(**scene.definition), scene.motion()
world.add_motion(motion, scene.radii)
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.monotonic()
try:
    world.run(1e6, motion, scene, threads=THREADS)
except KeyboardInterrupt:
    spent = time.monotonic() - start
    events = world.run(world.time, motion, scene)
    print("interrupted", spent < 5.0, len(events) > 0, world.audit() is None if len(world) < 10 else True)
"""


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_interrupts_a_run_without_any_python(threads: int) -> None:
    result = subprocess.run(
        [sys.executable, "-c", INTERRUPTED.replace("THREADS", str(threads))], capture_output=True, text=True, timeout=60)  # fmt: skip
    assert result.stdout.strip() == "interrupted True True True", result.stderr


def test_a_handler_of_signals_may_raise_what_it_likes() -> None:
    class Enough(Exception):
        pass

    def handler(number: int, frame: object) -> None:
        raise Enough

    world, motion, scene = busy(1000, packing=0.1)
    before = signal.signal(signal.SIGUSR1, handler)
    try:
        threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGUSR1)).start()
        with pytest.raises(Enough):
            world.run(1e6, motion, scene)
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert 0 < world.time < 1e6
    assert len(world.run(world.time + 0.01, motion, scene)) > 0
