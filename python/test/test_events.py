"""Tables of events."""

import io
import pickle

import numpy as np
import pytest
from conftest import hash_of

import kinesphere as ks
from kinesphere import EventKind, _kinesphere


@pytest.fixture(scope="module")
def events() -> ks.Events:
    scene = ks.Scene("paper1", bodies=100, seconds=2.0)
    world, motion = ks.World(**scene.definition), scene.motion()
    world.add_motion(motion, scene.radii)
    return world.run(2.0, motion, scene)


def test_names_are_the_librarys() -> None:
    assert [str(kind) for kind in EventKind] == _kinesphere.event_kind_names()
    assert [str(wall) for wall in ks.Wall] == _kinesphere.wall_names()


def test_a_table_has_columns_rows_and_parts(events: ks.Events) -> None:
    assert len(events) > 50 and events.array.dtype == ks.event_dtype
    assert np.all(np.diff(events["time"]) >= 0) and events["normal"].shape == (len(events), 3)
    begins = events.of_kind(EventKind.contact_begin)
    walls = events.of_kind(EventKind.wall_begin, EventKind.wall_end)
    assert len(begins) + len(walls) == len(events)
    assert set(walls["second"].tolist()) == {ks.no_body}
    assert isinstance(events[2:5], ks.Events) and len(events[2:5]) == 3 and len(events[[0, 3]]) == 2
    assert events[-1].time == events["time"][-1]
    with pytest.raises(IndexError):
        events[len(events)]
    assert "contact_begin" in repr(events) and repr(events[:0]) == "<Events: none>"


def test_a_row_is_the_event(events: ks.Events) -> None:
    for k, event in enumerate(events[:20]):
        row = events.array[k]
        for name in ks.event_dtype.names or ():
            value = getattr(event, name)
            if value is None:
                value = ks.no_body if name == "second" else 0
            assert np.array_equal(value, row[name]), name


def test_hashes(events: ks.Events) -> None:
    one, parts = ks.EventHash().add(events), ks.EventHash().add(events[10:])
    parts += ks.EventHash().add(events[:10])
    singly = ks.EventHash()
    for event in events:
        singly.add(event)
    assert one == parts == singly == pickle.loads(pickle.dumps(one)) and one.count == len(events)
    assert str(one) == f"{one.value:016x}"
    assert ks.EventHash() != one and hash_of(events[::2]) != str(one)
    assert hash_of(events[::-1]) == str(one)


def test_numpy_saves_and_loads_tables(events: ks.Events) -> None:
    file = io.BytesIO()
    np.save(file, events.array)
    file.seek(0)
    loaded = np.load(file)
    assert hash_of(ks.Events(loaded)) == hash_of(events) and ks.Events(loaded)[3] == events[3]
    names = ks.event_dtype.names or ()
    packed = np.zeros(len(events), dtype=[(name, *ks.event_dtype.fields[name][:1]) for name in names[::-1]])  # type: ignore[index]
    for name in names:
        packed[name] = events[name]
    assert hash_of(ks.Events(packed)) == hash_of(events)
    world = ks.World()
    world.add([[0.0, 0, 0], [5, 0, 0]])
    np.save(io.BytesIO(), world.nearest((0, 0, 0), 2))
    with pytest.raises(ks.InvalidValue, match="Events: rows must be an array with the columns of Events"):
        ks.Events(np.zeros(3, dtype=[("time", "f8")]))


def test_events_add_up_and_are_made_from_single_ones(events: ks.Events) -> None:
    parts = [events[:10], events[10:11], events[11:]]
    assert hash_of(sum(parts, ks.Events())) == hash_of(events) == hash_of(ks.Events(list(events)))
    both = parts[0] + parts[2]
    assert both.array.dtype == ks.event_dtype and np.array_equal(both["time"][10:], events["time"][11:])
    assert ks.Events(event for event in events if event.kind == EventKind.wall_begin)[0] in list(events)
    with pytest.raises(TypeError):
        events + ks.MonitorEvents()  # type: ignore[operator]


def test_a_notebook_shows_the_first_rows(events: ks.Events) -> None:
    pytest.importorskip("pandas")
    shown = events._repr_html_()
    assert shown is not None and "&lt;Events: " in shown and f"... and {len(events) - 10} more" in shown
    assert shown.count("<tr>") == 10 and ks.Events()._repr_html_() is not None


def test_pandas(events: ks.Events) -> None:
    pandas = pytest.importorskip("pandas")
    frame = events.to_pandas()
    assert len(frame) == len(events) and frame["kind"].iloc[0] == str(events[0].kind)
    assert frame["first_position_y"].to_numpy() == pytest.approx(events["first_position"][:, 1])
    walls = frame[frame["kind"] == "wall_begin"]
    assert walls["second"].isna().all() and not walls["wall"].isna().any()
    assert frame[frame["kind"] == "contact_begin"]["wall"].isna().all()
    assert isinstance(frame, pandas.DataFrame) and len(events[:0].to_pandas()) == 0


def test_tables_are_pickled(events: ks.Events) -> None:
    assert hash_of(pickle.loads(pickle.dumps(events))) == hash_of(events)


def test_a_fixed_body_is_infinitely_heavy_for_bounce_and_bouncing() -> None:
    velocities = []
    for ready_made in (True, False):
        motion = ks.Ballistic([[0.0, 0, 0]], [[10.0, 0, 0]])
        world = ks.World(contacts="impacts")
        world.add_motion(motion, 1.0)
        post = world.add_static(ks.Ball((5, 0, 0), 1.0))
        if ready_made:
            event = world.run(2.0, motion, ks.Bouncing(restitution=0.7))[0]
        else:
            event = next(iter(world.events(2.0, motion)))
            first, second = ks.bounce(event, restitution=0.7)
            assert second is not None and not second.any()
            motion.set_velocity(0, event.time, first)
            world.set_velocity(0, first)
        assert event.second_is_static and not event.first_is_static and event.second_mass == np.inf
        assert event.partner_of(0) == post and event.partner_of(post) == 0 and event.partner_of(7) is None
        velocities.append(motion.states(2.0)[1][0, 0])
    assert velocities == [-7.0, -7.0]


def test_a_zone_finds_its_events_if_the_visitor_senses_too_and_changes_its_shape() -> None:
    motion = ks.Ballistic([[0.0, 0, 0]], [[10.0, 0, 0]])
    world = ks.World()
    world.set_sensor(1, [0.0])
    ball = world.add([0.0, 0, 0], [10.0, 0, 0], sensor_classes=1, masses=2.5)
    zone = world.add_zone(ks.Box((5, -1, -1), (6, 1, 1)))
    enter = next(iter(world.events(2.0, motion)))
    assert enter.is_sensed_by(zone) and enter.is_sensed_by(ball) and enter.sensor == ball
    assert enter.first_mass == 2.5 and enter.second_is_zone
    world.set_mass(ball, 3.0)
    world.set_shape(zone, ks.Box((4, -1, -1), (9, 1, 1)))
    (leave,) = world.events(2.0, motion)
    assert leave.kind == ks.EventKind.sensor_leave and leave.time == pytest.approx(1.0)
    assert leave.first_mass == 3.0
    with pytest.raises(ks.StateError, match="body must have a shape"):
        world.set_shape(ball, ks.Ball((0, 0, 0), 1.0))
