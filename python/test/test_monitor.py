"""Monitors: reports in arrays, events in tables, held against closed forms that NumPy computes."""

import copy
import io
import pickle
import signal
import threading
from collections.abc import Callable
from itertools import combinations
from typing import Any, Optional

import numpy as np
import numpy.typing as npt
import pytest

import kinesphere as ks
from kinesphere import MonitorEventKind, Separation, SeparationRule, TrackClass, Verdict

Doubles = npt.NDArray[np.float64]
nan, inf = float("nan"), float("inf")
largest_id = 2**64 - 1


def watching(*levels: Separation, limit: Any = 1.0, **settings: Any) -> ks.Monitor:
    return ks.Monitor(
        classes=[TrackClass(acceleration_limit=limit)],
        separations=[SeparationRule(0, 0, list(levels) or [Separation.sphere(10.0)])],
        **settings,
    )


class Sky:
    """Tracks that fly straight on in a flat box, and their reports: late, irregular, and off by up to the errors."""

    def __init__(self, seed: int, tracks: int = 40, reports: int = 3000, seconds: float = 30.0) -> None:
        rng = np.random.default_rng(seed)
        self.seconds, self.ids = seconds, np.sort(rng.choice(2**63, tracks).astype(np.uint64) * 2 + 1)
        self.start = rng.uniform(-1, 1, (tracks, 3)) * (80, 80, 10)
        self.velocity = rng.uniform(-1, 1, (tracks, 3)) * (8, 8, 0.5)
        who = np.concatenate([np.arange(tracks), rng.integers(tracks, size=reports - tracks)])
        self.arrivals = np.concatenate([np.zeros(tracks), np.sort(rng.uniform(0, seconds, reports - tracks))])
        stamps = self.arrivals - rng.uniform(0, 0.5, reports)
        self.columns: dict[str, Any] = {
            "ids": self.ids[who],
            "timestamps": stamps,
            "positions": self.at(who, stamps) + rng.uniform(-0.1, 0.1, (reports, 3)),
            "velocities": self.velocity[who] + rng.uniform(-0.05, 0.05, (reports, 3)),
            "position_errors": 0.2,
            "velocity_errors": np.full(reports, 0.1),
        }

    def at(self, who: Any, time: Any) -> Doubles:
        places: Doubles = self.start[who] + self.velocity[who] * np.asarray(time)[..., None]
        return places

    def rows(self, part: Any) -> dict[str, Any]:
        return {
            name: column if np.isscalar(column) else column[part] for name, column in self.columns.items()
        }

    def pair(self, first: Any, second: Any) -> tuple[Doubles, Doubles]:
        a, b = np.searchsorted(self.ids, first), np.searchsorted(self.ids, second)
        return self.start[b] - self.start[a], self.velocity[b] - self.velocity[a]


def distance(place: Doubles, velocity: Doubles, time: Any) -> float:
    return float(np.linalg.norm(place + velocity * time))


def least_distance(place: Doubles, velocity: Doubles, begin: float, end: float) -> float:
    closest = np.clip(-(place @ velocity) / (velocity @ velocity), begin, end)
    return distance(place, velocity, closest)


def test_certain_verdicts_agree_with_the_true_distances() -> None:
    sky, separation, tolerance = Sky(seed=1), 12.0, 0.5
    monitor = watching(Separation.sphere(separation), limit=0.5, tolerance=tolerance, start_time=0.0)
    events = monitor.feed(**sky.columns, arrivals=sky.arrivals)
    assert monitor.counters.late > 100 and set(events["kind"]) == {MonitorEventKind.verdict}
    histories: dict[tuple[int, int], list[tuple[float, Verdict]]] = {
        pair: [(0.0, Verdict.apart)] for pair in combinations(sky.ids.tolist(), 2)
    }
    for event in events:
        assert event.second is not None and event.verdict is not None
        history = histories[event.first, event.second]
        assert event.before == history[-1][1]
        history.append((event.time, event.verdict))
    counts = dict.fromkeys(Verdict, 0)
    for (first, second), history in histories.items():
        place, velocity = sky.pair(first, second)
        for k, (begin, verdict) in enumerate(history):
            end = history[k + 1][0] if k + 1 < len(history) else monitor.time
            counts[verdict] += 1
            if verdict == Verdict.apart and end > begin:
                assert least_distance(place, velocity, begin, end) > separation
            elif verdict == Verdict.within:  # the distance is convex in time
                farthest = max(distance(place, velocity, begin), distance(place, velocity, end))
                assert farthest <= separation + tolerance
    assert counts[Verdict.within] > 20 and counts[Verdict.apart] > len(histories), counts

    pairs = np.array(list(histories), dtype=np.uint64)
    answers = monitor.answer(pairs[:, 0], pairs[:, 1])
    places, velocities = sky.pair(pairs[:, 0], pairs[:, 1])
    true = np.linalg.norm(places + velocities * monitor.time, axis=1)
    assert np.all(answers["lower"] <= true) and np.all(true <= answers["upper"])
    assert np.array_equal(answers["verdict"], [histories[a, b][-1][1] for a, b in pairs.tolist()])
    one = monitor.answer(int(pairs[5, 0]), int(pairs[5, 1]))
    for name in ks.pair_answer_dtype.names or ():
        if name not in ("first", "second"):
            assert getattr(one, name) == answers[5][name], name
    opened = monitor.open_pairs()
    assert len(opened) == np.count_nonzero(answers["verdict"] != Verdict.apart) <= monitor.open_pair_count


def test_a_batch_is_a_loop_over_its_rows_and_a_snapshot_goes_on_equally() -> None:
    sky = Sky(seed=2, reports=1500)
    alone, fed = (watching(Separation.sphere(12.0, look_ahead=10.0)) for _ in range(2))
    events = []
    for k, arrival in enumerate(sky.arrivals):
        if k == 0 or arrival != sky.arrivals[k - 1]:
            events.append(alone.run(arrival).array)
        row = sky.rows(k)
        alone.report(int(row.pop("ids")), **row)
    events.append(alone.run(alone.time).array)
    half = len(sky.arrivals) // 2
    first = fed.feed(**sky.rows(slice(half)), arrivals=sky.arrivals[:half])
    others = [
        copy.copy(fed),
        copy.deepcopy(fed),
        pickle.loads(pickle.dumps(fed)),
        ks.Monitor.restore(fed.save()),
    ]
    for monitor in [fed, *others]:
        rest = monitor.feed(**sky.rows(slice(half, None)), arrivals=sky.arrivals[half:])
        together = np.concatenate([first.array, rest.array])
        assert np.array_equal(together, np.concatenate(events))
        assert monitor.save() == alone.save()
    assert len(first) > 100 and len(rest) > 20


def test_predictions_come_when_straight_paths_say_so() -> None:
    sky, separation, ahead = Sky(seed=3, tracks=60), 10.0, 8.0
    monitor = watching(Separation.sphere(separation, look_ahead=ahead))
    monitor.report(sky.ids, 0.0, sky.start, sky.velocity)
    events = monitor.run(sky.seconds)
    found = {(event.first, event.second): event for event in events.of_kind(MonitorEventKind.predicted)}
    true: set[tuple[int, Optional[int]]] = set()
    for first, second in combinations(sky.ids.tolist(), 2):
        place, velocity = sky.pair(first, second)
        closest = -(place @ velocity) / (velocity @ velocity)
        least = distance(place, velocity, closest)
        if least > separation:
            continue
        half = np.sqrt((separation**2 - least**2) / (velocity @ velocity))
        begin = max(0.0, min(closest - ahead, closest - half))
        if closest + half >= 0.0 and begin <= sky.seconds:
            true.add((first, second))
            event = found[first, second]
            assert event.time == pytest.approx(begin, abs=2e-3)
            if closest > 0:
                assert event.closest_time == pytest.approx(closest)
                assert event.closest_distance == pytest.approx(least)
    assert found.keys() == true and len(true) > 20
    now = monitor.predicted_pairs()
    assert len(now) > 0 and all(
        monitor.answer(int(a), int(b)).predicted for a, b in zip(now["first"], now["second"])
    )
    over = events.of_kind(MonitorEventKind.prediction_ended)
    assert len(over) == len(found) - len(now)


def test_well_clear_agrees_with_its_definition() -> None:
    """DO-365's predicate, sampled along straight paths, with a tolerance on both sides."""
    horizontal, vertical, tau = 1222.32, 137.16, 35.0
    rng = np.random.default_rng(4)
    times = np.linspace(0.0, 120.0, 1201)

    def lost(place: Doubles, velocity: Doubles, wider: float) -> npt.NDArray[np.bool_]:
        s = place[:2] + velocity[:2] * times[:, None]
        r2, closing, speed2 = np.sum(s * s, axis=1), s @ velocity[:2], velocity[:2] @ velocity[:2]
        d2 = (horizontal + wider) ** 2
        at_closest = r2 - closing**2 / speed2
        soon = (closing < 0) & (at_closest <= d2) & (d2 - r2 >= tau * np.minimum(closing, 0.0))
        flat = (r2 <= d2) | soon
        result: npt.NDArray[np.bool_] = flat & (np.abs(place[2] + velocity[2] * times) <= vertical + wider)
        return result

    losses = 0
    for _ in range(30):
        monitor = watching(
            Separation.well_clear(horizontal, vertical, tau, look_ahead=55.0), limit=0.0, tolerance=0.5
        )
        place = rng.uniform(-1, 1, 3) * (6000, 6000, 200)
        velocity = rng.uniform(-1, 1, 3) * (50, 50, 2) - place * (1, 1, 0) / rng.uniform(30, 100)
        monitor.report([7, 9], 0.0, np.stack([0 * place, place]), np.stack([0 * place, velocity]))
        events = monitor.run(times[-1])
        verdicts = events.of_kind(MonitorEventKind.verdict)
        began = np.searchsorted(verdicts["time"], times, side="right") - 1
        stands = np.where(began >= 0, verdicts["verdict"][began] if len(verdicts) else 0, Verdict.apart)
        assert not np.any(lost(place, velocity, 0.0) & (stands == Verdict.apart))
        assert not np.any(~lost(place, velocity, 0.5) & (stands == Verdict.within))
        # Without acceleration and errors next to nothing is undecided.
        assert np.mean(stands == Verdict.undecided) < 0.01
        if lost(place, velocity, 0.0).any():
            losses += 1
            predicted = events.of_kind(MonitorEventKind.predicted)
            begin = times[np.argmax(lost(place, velocity, 0.0))]
            assert predicted["time"][0] == pytest.approx(max(0.0, begin - 55.0), abs=0.2)
    assert losses > 5


def test_what_happens_to_tracks_is_told() -> None:
    monitor = ks.Monitor(
        classes=[TrackClass(2.0, largest_speed=30.0), TrackClass(0.05, largest_speed=1.0)],
        separations=[SeparationRule(0, 0, [Separation.sphere(50.0), Separation.cylinder(20.0, 10.0)])],
        stale_after=5.0,
        drop_after=20.0,
    )
    places = [(0, 0, 0), (0, 60, 0), (0, 0, 900)]
    monitor.report([1, 2, largest_id], 0.0, places, np.zeros((3, 3)), track_classes=[0, 0, 1])
    assert 1 in monitor and largest_id in monitor and 4 not in monitor and len(monitor) == 3
    assert monitor.tracks().tolist() == [1, 2, largest_id] and monitor.tracks().dtype == np.uint64
    assert repr(monitor) == "<Monitor of 3 tracks at 0.0>"
    seen: list[tuple[str, int, Optional[int], int]] = []

    def see(events: Any) -> None:
        seen.extend((str(event.kind), event.first, event.second, event.level) for event in events)

    see(monitor.events(6.0))
    assert seen[:2] == [("verdict", 1, 2, 0), ("verdict", 1, 2, 1)]
    assert seen[2:] == [("stale", id, None, 0) for id in (1, 2, largest_id)]
    assert monitor.crowd(0).tolist() == [1] and len(monitor.open_pairs()) == 2
    # A vessel anchors, so its class has no separation; another is where it cannot be.
    seen.clear()
    monitor.report(2, 6.0, (0, 60, 0), (0, 0, 0), track_classes=1)
    monitor.report(1, 6.0, (200, 0, 0), (0, 0, 0))
    wrong = monitor.run(6.0)
    see(wrong)
    assert ("reclassified", 2, None, 0) == seen[0]
    assert {("contradiction", 1, None, 0), ("resumed", 1, None, 0)} <= set(seen)
    (contradiction,) = wrong.of_kind(MonitorEventKind.contradiction)
    assert 100 < contradiction.position_excess < 200 and contradiction.second is None
    view = monitor.track(1)
    assert (view.id, view.track_class, view.timestamp, view.stale) == (1, 0, 6.0, False)
    assert sorted(place.centre[0] for place in view.places) == [0.0, 200.0]
    assert len(monitor.open_pairs()) == 0
    seen.clear()
    monitor.report(1, 7.0, (200, 0, 0), (0, 0, 0))
    monitor.remove([2])
    see(monitor.run(40.0))
    assert seen[:2] == [("dropped", 2, None, 0), ("resolved", 1, None, 0)]
    assert seen[2:] == [("stale", 1, None, 0), ("dropped", largest_id, None, 0), ("dropped", 1, None, 0)]
    assert len(monitor) == 0 and monitor.counters.contradictions == 1


def test_plans_and_errors_are_those_of_their_rows() -> None:
    """Compared with the same reports one by one, in a snapshot of each."""
    whole, single = (watching(limit=ks.ErrorBound.cylinder(2.0, 1.0), start_time=0.0) for _ in range(2))
    ids, positions, velocities = [1, 2, 3], np.diag([10.0, 20, 30]), np.ones((3, 3))
    errors, accelerations = np.array([(1.0, 0.5), (2.0, 0.1), (3.0, 0.0)]), -np.ones((3, 3))
    ends, stamp_errors = [5.0, -inf, 9.0], np.array([0.0, 0.1, 0.2], dtype=np.float32)
    whole.report(
        ids, 0.0, positions, velocities, errors, 0.5, timestamp_errors=stamp_errors,
        plan_accelerations=accelerations, plan_acceleration_limits=[0.1, 0.2, 0.3], plan_valid_until=ends,
    )  # fmt: skip
    for k, id in enumerate(ids):
        plan: dict[str, Any] = {
            "plan_accelerations": accelerations[k],
            "plan_acceleration_limits": (0.1, 0.2, 0.3)[k],
            "plan_valid_until": ends[k],
        }
        single.report(
            id, 0.0, positions[k], velocities[k], ks.ErrorBound.cylinder(*errors[k]), 0.5,
            timestamp_errors=stamp_errors[k], **({} if k == 1 else plan),
        )  # fmt: skip
    assert single.save() == whole.save()
    assert whole.track(1).places[0].radius.vertical == pytest.approx(0.5)
    plane = watching(dimensions=2)
    plane.report([1, 2], 0.0, [(0, 0), (30, 0)], [(0, 0), (-10, 0)])
    assert set(plane.run(3.0)["first"].tolist()) == {1}
    unknown = ks.Monitor(classes=[TrackClass(largest_speed=2.0)], separations=[])
    unknown.report([1, 2], 0.0, [(0, 0, 0), (9, 0, 0)])
    unknown.run(1.0)
    assert unknown.track(2).places[0].radius.total == pytest.approx(2.0)


def test_a_poll_keeps_every_pair_decided_with_few_reports() -> None:
    rng = np.random.default_rng(5)
    ids = np.arange(1, 21, dtype=np.uint64)
    phase, centre = rng.uniform(0, 6, (20, 1)), rng.uniform(0, 40, (20, 3))

    def state(which: Any, time: float) -> tuple[Doubles, Doubles]:
        angle = 0.5 * time + phase[which] + np.array([0.0, 1.5, 3.0])
        return centre[which] + 4 * np.sin(angle), 2 * np.cos(angle)

    asked: list[int] = []

    def poll(which: npt.NDArray[np.uint64], time: float) -> Any:
        asked.append(len(which))
        assert monitor.time == time and which.dtype == np.uint64
        if silent and len(which) > 1:
            which = which[: len(which) // 2]
        positions, velocities = state(which.astype(int) - 1, time)
        answer = {"timestamps": time, "positions": positions, "velocities": velocities}
        return answer | {"ids": which} if silent else answer

    for silent in (False, True):
        monitor = watching(Separation.sphere(5.0), limit=1.8, tolerance=1.0)
        asked.clear()
        monitor.report(ids, 0.0, *state(np.arange(20), 0.0))
        events = list(monitor.events(5.0, poll)) + list(monitor.run(10.0, poll))
        assert {str(event.verdict) for event in events} == {"apart", "within"}
        assert 0 < sum(asked) == monitor.counters.polls < 20 * 10 * 10
        needed = monitor.needed(monitor.time + 1.0)
        assert np.all(needed["by"] >= monitor.time) and set(needed["track"].tolist()) <= set(ids.tolist())
    assert monitor.advance(20.0, lambda which, time: None) is not None


wrong_polls: list[tuple[Any, type[Exception], str]] = [
    (5, TypeError, "poll must be a function of .ids, time., but is 5"),
    (lambda ids, time: [1], TypeError, r"poll must return None or a dict .* but returned \[1\]"),
    (lambda ids, time: {"positon": 1}, TypeError, "poll must return arguments of report.., but returned 'positon'"),
    (lambda ids, time: {"timestamps": time}, TypeError, "positions"),
    (lambda ids, time: {"timestamps": time, "positions": [(0, 0, 0)] * 9}, ks.InvalidValue, r"with n = \d"),
    (lambda ids, time: {"ids": [77], "timestamps": time, "positions": [(0, 0, 0)]}, ks.InvalidValue, "each of the tracks that it is asked for .* returned 77 in row 0"),
    (lambda ids, time: {"timestamps": nan, "positions": [(0, 0, 0)] * len(ids)}, ks.InvalidValue, "report of track . timestamp must be finite|timestamp"),
    (lambda ids, time: 1 / 0, ZeroDivisionError, "division"),
]  # fmt: skip


@pytest.mark.parametrize("number", range(len(wrong_polls)))
def test_wrong_polls_are_named_and_can_be_repeated(number: int) -> None:
    poll, kind, message = wrong_polls[number]
    monitor, plain = watching(start_time=0.0), watching(start_time=0.0)
    for one in (monitor, plain):
        one.report([1, 2], 0.0, [(0, 0, 0), (30, 0, 0)], [(0, 0, 0), (-5, 0, 0)])
    for _ in range(2):
        with pytest.raises(kind, match=message):
            monitor.run(20.0, poll)
    assert np.array_equal(monitor.run(20.0).array, plain.run(20.0).array)


def test_a_poll_may_ask_but_neither_change_nor_be_in_another_thread() -> None:
    monitor = watching(start_time=0.0)
    monitor.report([1, 2], 0.0, [(0, 0, 0), (30, 0, 0)], [(0, 0, 0), (-5, 0, 0)])
    raised: list[ks.StateError] = []

    def in_another_thread() -> None:
        with pytest.raises(ks.StateError) as caught:
            monitor.answer(1, 2)
        raised.append(caught.value)

    def poll(ids: Any, time: float) -> None:
        assert monitor.answer(1, 2).lower >= 0.0 and len(monitor) == 2
        with pytest.raises(ks.StateError, match="a poll must not change the monitor"):
            monitor.remove(1)
        with pytest.raises(ks.StateError, match="a poll must not change the monitor"):
            monitor.report(1, time, (0, 0, 0), (0, 0, 0))
        thread = threading.Thread(target=in_another_thread)
        thread.start()
        thread.join()

    assert len(monitor.run(20.0, poll)) > 0
    assert {error.code for error in raised} == {"in_use"}


def test_an_interrupted_call_loses_no_event_and_no_report() -> None:
    sky = Sky(seed=8, reports=240_000)
    plain, stopped = (watching(Separation.sphere(12.0, look_ahead=10.0), start_time=0.0) for _ in range(2))
    expected = plain.feed(**sky.columns, arrivals=sky.arrivals)

    class Enough(Exception):
        pass

    def handler(number: int, frame: object) -> None:
        raise Enough

    # The process's own time, so that a busy machine does not interrupt it before the call.
    before = signal.signal(signal.SIGVTALRM, handler)
    try:
        with pytest.raises(Enough):
            signal.setitimer(signal.ITIMER_VIRTUAL, 0.02)
            stopped.feed(**sky.columns, arrivals=sky.arrivals)
    finally:
        signal.signal(signal.SIGVTALRM, before)
    with pytest.raises(ks.StateError, match="monitor must have delivered its events"):
        pickle.dumps(stopped)
    taken = stopped.counters.reports + stopped.counters.repeated
    assert 0 < taken < len(sky.arrivals)
    rest = stopped.feed(**sky.rows(slice(taken, None)), arrivals=sky.arrivals[taken:])
    assert np.array_equal(rest.array, expected.array) and stopped.save() == plain.save()


def test_shards_divide_the_pairs() -> None:
    sky, whole = Sky(seed=6, reports=800), []
    for shard in (ks.Shard(), ks.Shard(2, 0), ks.Shard(2, 1)):
        monitor = watching(Separation.sphere(12.0), shard=shard, start_time=0.0)
        whole.append(monitor.feed(**sky.columns, arrivals=sky.arrivals).of_kind(MonitorEventKind.verdict))
    assert len(whole[0]) == len(whole[1]) + len(whole[2]) and min(len(part) for part in whole) == 0
    of_three = [
        watching(Separation.sphere(12.0), shard=ks.Shard(3, k), start_time=0.0).feed(
            **sky.columns, arrivals=sky.arrivals
        )
        for k in range(3)
    ]
    together = np.sort(np.concatenate([part.array for part in of_three]), order=["time", "first", "second"])
    assert np.array_equal(together, np.sort(whole[0].array, order=["time", "first", "second"]))
    assert all(len(part) > 0 for part in of_three)


def test_tables_of_events() -> None:
    sky = Sky(seed=7, reports=600)
    monitor = watching(Separation.sphere(12.0, look_ahead=5.0), stale_after=2.0)
    events = monitor.feed(**sky.columns, arrivals=sky.arrivals)
    assert events.array.dtype == ks.monitor_event_dtype
    for k in [*range(0, len(events), 7), -1]:
        event, row = events[k], events.array[k]
        assert pickle.loads(pickle.dumps(event)) == event and event in events[k:]
        for name in ks.monitor_event_dtype.names or ():
            value = getattr(event, name)
            assert value is None or value == row[name], name
        assert (event.second is None) == (event.kind > MonitorEventKind.prediction_ended)
        assert (event.verdict is None) == (event.before is None) == (event.kind != MonitorEventKind.verdict)
    file = io.BytesIO()
    np.save(file, events.array)
    file.seek(0)
    assert np.array_equal(np.load(file), events.array)
    assert np.array_equal(pickle.loads(pickle.dumps(events)).array, events.array)
    text = repr(events)
    assert text.startswith("<MonitorEvents: ") and "predicted" in text and "stale" in text
    assert repr(events[:0]) == "<MonitorEvents: none>"
    (verdict,) = events.of_kind(MonitorEventKind.verdict)[:1]
    assert repr(verdict).startswith(
        f"<MonitorEvent verdict at {verdict.time!r}: {verdict.first}, {verdict.second}"
    )
    pytest.importorskip("pandas")
    frame = events.to_pandas()
    assert list(frame.columns) == list(ks.monitor_event_dtype.names or ())
    of_tracks = frame[frame["kind"] == "stale"]
    assert len(of_tracks) > 0 and of_tracks["second"].isna().all() and of_tracks["verdict"].isna().all()
    verdicts = frame[frame["kind"] == "verdict"]
    assert not verdicts["second"].isna().any() and set(verdicts["verdict"]) <= {str(kind) for kind in Verdict}
    assert len(events[:0].to_pandas()) == 0


def test_definitions_go_around() -> None:
    wide, narrow = Separation.well_clear(1222.0, 137.0, 35.0, look_ahead=55.0), Separation.ellipsoid(9.0, 4.0)
    monitor = ks.Monitor(
        classes=[TrackClass(ks.ErrorBound.cylinder(3, 1), (0, 0, -9.8)), TrackClass(largest_speed=7)],
        separations=[SeparationRule(1, 0, [wide, narrow])],
        dimensions=3,
        start_time=-5.0,
        drop_after=60.0,
        prediction_hold=3.0,
        shard=ks.Shard(4, 1, 2),
    )
    again = ks.Monitor(**monitor.definition)
    assert again.save() == monitor.save() and again.time == -5.0
    assert (
        repr(again.definition)
        == repr(monitor.definition)
        == repr(pickle.loads(pickle.dumps(monitor.definition)))
    )
    assert eval(repr(monitor.definition), {**vars(ks), "inf": inf})["separations"][0].levels == [wide, narrow]
    assert monitor.definition["classes"][0].acceleration_limit == ks.ErrorBound.cylinder(3.0, 1.0)
    assert monitor.definition["classes"][1].largest_speed == 7 and wide != narrow
    assert (wide.shape, wide.modified_tau, wide.look_ahead) == ("well_clear", 35.0, 55.0)
    assert "MonitorCounters: 0 reports" in repr(monitor.counters)


Wrong = tuple[Callable[[ks.Monitor], Any], type[Exception], str]
track = ([1, 2], 0.0, [(0, 0, 0), (9, 9, 9)], np.zeros((2, 3)))
places, still = np.zeros((3, 3)), np.zeros((3, 3))
three = [1, 2, 3]
wrong: list[Wrong] = [
    (lambda m: ks.Monitor(classes=[TrackClass(-1.0)], separations=[]), ks.InvalidValue, "classes, acceleration_limit 0, must be >= 0, but is -1"),
    (lambda m: ks.Monitor(classes=[TrackClass()], separations=[]), ks.InvalidValue, "must be finite where largest_speed is not"),
    (lambda m: ks.Monitor(classes=[], separations=[]), ks.InvalidValue, "classes must name at least one"),
    (lambda m: ks.Monitor(classes=[3.0], separations=[]), TypeError, r"Monitor: classes\[0\] must be a TrackClass, but is 3.0"),  # type: ignore[list-item]
    (lambda m: ks.Monitor(classes=TrackClass(1.0), separations=[]), TypeError, "classes must be a list"),  # type: ignore[arg-type]
    (lambda m: watching(Separation.sphere(-5.0)), ks.InvalidValue, "horizontal 0, must be > 0, but is -5"),
    (lambda m: watching(Separation.sphere(5.0, look_ahead=nan)), ks.InvalidValue, "look_ahead 0, must be finite"),
    (lambda m: SeparationRule(0, 0, ["sphere"]), TypeError, r"levels\[0\] must be a Separation"),  # type: ignore[list-item]
    (lambda m: Separation("cube", 1.0, 1.0), ks.InvalidValue, "shape must be .*but is \"cube\""),  # type: ignore[arg-type]
    (lambda m: ks.Monitor(classes=[TrackClass(1.0)], separations=[SeparationRule(0, 7, [])]), ks.InvalidValue, "must be less than the number of classes"),
    (lambda m: watching(tolerance=0.0), ks.InvalidValue, "tolerance must be > 0"),
    (lambda m: watching(tolerence=1.0), TypeError, "Monitor: there is no argument tolerence; the nearest is tolerance"),
    (lambda m: watching(shard=ks.Shard(2, 2)), ks.InvalidValue, "shard, first, must be"),
    (lambda m: m.report(three, 1.0, places, still, track_classes=[0, 0, 5]), ks.InvalidValue, "report: row 2, report of track 3, track_class, must be less than"),
    (lambda m: m.report(three, [1.0, nan, 1.0], places, still), ks.InvalidValue, "row 1, report of track 2, timestamp, must be finite, but is nan"),
    (lambda m: m.report(three, 1.0, places + [[0], [0], [inf]], still), ks.InvalidValue, "row 2, report of track 3, position, must be finite"),
    (lambda m: m.report(three, 1.0, places, still, position_errors=[1, -1, 1]), ks.InvalidValue, "row 1, .* position_error, must be >= 0"),
    (lambda m: m.report(three, 1.0, places), ks.InvalidValue, "row 0, .* velocity_error, must be finite where the class has no largest speed"),
    (lambda m: m.report(three, 1.0, places, velocity_errors=1.0), ks.InvalidValue, "velocity_errors must come with velocities"),
    (lambda m: m.report(three, 1.0, places, still, plan_valid_until=9.0), ks.InvalidValue, "plan_valid_until must come with plan_accelerations"),
    (lambda m: m.report(three, 1.0, places, still, plan_accelerations=still, plan_valid_until=0.5), ks.InvalidValue, "row 0, .* plan valid_until, must be later"),
    (lambda m: m.report(three, 1.0, places[:2], still), ks.InvalidValue, r"positions must have shape \(n, 3\) with n = 3, but has shape \(2, 3\)"),
    (lambda m: m.report(three, 1.0, places[:, :2], still), ks.InvalidValue, r"positions must have shape \(n, 3\)"),
    (lambda m: m.report(three, [1.0, 2.0], places, still), ks.InvalidValue, "timestamps must be one number, or one for each of 3 reports"),
    (lambda m: m.report(three, 1.0, places, still, position_errors=np.ones((3, 3))), ks.InvalidValue, r"position_errors must be a number, an ErrorBound"),
    (lambda m: m.report(three, 1.0, places, still, track_classes=[0, 1]), ks.InvalidValue, "track_classes must be one number, or one for each of 3"),
    (lambda m: m.report([1, -2, 3], 1.0, places, still), ks.InvalidValue, r"ids\[1\] must be a whole number from 0 to 2\^64 - 1, but is -2"),
    (lambda m: m.report(np.array([1, 2, -3]), 1.0, places, still), ks.InvalidValue, r"ids\[2\] must be a whole number .* but is -3"),
    (lambda m: m.report([1, 2, 2**64], 1.0, places, still), ks.InvalidValue, r"ids\[2\]"),
    (lambda m: m.report(np.array([1.0, 2, 3]), 1.0, places, still), TypeError, "ids must be whole numbers"),
    (lambda m: m.report(["a", "b", "c"], 1.0, places, still), TypeError, r"ids\[0\] must be a whole number, but is 'a'"),  # type: ignore[list-item]
    (lambda m: m.report(three, "now", places, still), TypeError, "timestamps must be real numbers"),
    (lambda m: m.report(three, 1.0, places, still, speed=3.0), TypeError, "report: there is no argument speed; "),  # type: ignore[call-arg]
    (lambda m: m.feed(three, [3.0, 2.0, 4.0], places, still), ks.InvalidValue, "arrivals must be given where timestamps are not in ascending order, but is 2.0 in row 1"),
    (lambda m: m.feed(three, 1.0, places, still, arrivals=[1.0, nan, 2.0]), ks.InvalidValue, "arrivals must be finite, but is nan in row 1"),
    (lambda m: m.feed(three, 1.0, places, still, arrivals=-5.0), ks.InvalidValue, "until must not lie before the time of the monitor"),
    (lambda m: m.feed(three, 1.0, places, still, position_errors=[0, 0, nan]), ks.InvalidValue, "feed: row 2, report of track 3, position_error, must be finite"),
    (lambda m: m.remove(9), ks.BodyError, "remove: there is no track 9"),
    (lambda m: m.remove([1, 9]), ks.BodyError, "remove: row 1, there is no track 9"),
    (lambda m: m.remove([1, 1]), ks.InvalidValue, "ids must all be different, but there are two 1"),
    (lambda m: m.track(9), ks.BodyError, "track: there is no track 9"),
    (lambda m: m.answer(1, 9), ks.BodyError, "answer: there is no track 9"),
    (lambda m: m.answer(1, 1), ks.InvalidValue, "second must be another track than first"),
    (lambda m: m.answer(1, 2, level=3), ks.InvalidValue, "level must be less than 1, but is 3"),
    (lambda m: m.answer([1, 1], [2, 9]), ks.BodyError, "answer: row 1, there is no track 9"),
    (lambda m: m.answer([1, 1], [2]), ks.InvalidValue, "second must have one id for each of first, 2, but has 1"),
    (lambda m: m.run(-1.0), ks.InvalidValue, "until must not lie before"),
    (lambda m: m.advance(nan), ks.InvalidValue, "until must be finite"),
    (lambda m: m.needed(nan), ks.InvalidValue, "until must be a number"),
    (lambda m: m.crowd(-1), TypeError, "crowd: pairs must be a whole number in its range, but is -1"),
    (lambda m: ks.Monitor.restore(m.save()[:-20]), ks.InvalidValue, "Monitor::restore"),
    (lambda m: ks.Monitor.restore(5), TypeError, "snapshot must be bytes"),  # type: ignore[arg-type]
    (lambda m: "a" in m, TypeError, "id must be a whole number"),  # type: ignore[operator]
]  # fmt: skip


@pytest.mark.parametrize("number", range(len(wrong)))
def test_wrong_use_is_named_and_changes_nothing(number: int) -> None:
    wrongly, kind, message = wrong[number]
    monitor = watching(start_time=0.0)
    monitor.report(*track)
    before = monitor.save()
    with pytest.raises(kind, match=message):
        wrongly(monitor)
    assert monitor.save() == before
