"""Plots of events and approaches, what notebooks show, and the notebook of the examples."""

import builtins
import json
import os
from pathlib import Path
from typing import Any, Iterator

import numpy as np
import pytest

import kinesphere as ks
from conftest import pair

NOTEBOOK = Path(__file__).parents[1] / "examples" / "seen.ipynb"


@pytest.fixture
def pyplot() -> Iterator[Any]:
    """pyplot without a screen; without matplotlib the test is skipped."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    yield pyplot
    pyplot.close("all")


def crossing(dates: bool = False) -> ks.Approaches:
    """Three bodies: 7 meets 8 at 5 s at a distance of 1, and 9 at a distance of 2."""
    t = np.tile(np.arange(0.0, 11.0), 3)
    x = np.concatenate([np.zeros(11), np.arange(-5.0, 6), np.arange(5.0, -6, -1)])
    y = np.repeat([0.0, 1.0, -2.0], 11)
    when = np.datetime64("2026-05-01T23:59:58") + (t * 1000).astype("timedelta64[ms]") if dates else t
    return ks.tracks(when, x, y, id=np.repeat([7, 8, 9], 11), distance=2.5)


def texts(axes: Any) -> list[str]:
    legend = axes.get_legend()
    return [text.get_text() for text in legend.get_texts()] if legend else []


def test_approaches_have_a_map_a_time_and_a_histogram(pyplot: Any) -> None:
    found = crossing()
    assert len(found) == 2
    figure = found.plot(tracks=([0.0, 1.0], [0.0, 1.0]))
    over, when, many = figure.axes
    assert over.get_title() == "2 approaches" and over.get_xlabel() == "x"
    assert texts(over) == texts(when) == ["7 and 8", "7 and 9"]
    colours = [
        [line.get_color() for line in axes.lines if line.get_label() in texts(over)] for axes in (over, when)
    ]
    assert colours[0] == colours[1] and len(set(colours[0])) == 2, "a pair has one colour"
    marks = [line.get_xydata().tolist() for line in when.lines if line.get_label() == "7 and 8"]
    assert marks[0] == [pytest.approx([5.0, 1.0])]
    assert sum(patch.get_height() for patch in many.patches) == 2
    figure.canvas.draw()
    assert found[:1].plot("map").axes[0].get_title() == "1 approach"


def test_clock_times_are_read_as_such(pyplot: Any) -> None:
    figure = crossing(dates=True).plot("time")
    figure.canvas.draw()
    axes = figure.axes[0]
    day = axes.xaxis.get_major_formatter().get_offset()
    assert axes.get_xlabel() == "UTC" and day.startswith("2026-May-02"), day


def test_events_have_a_map_a_time_and_a_histogram(pyplot: Any) -> None:
    world, motion = pair()
    events = world.run(10.0, motion)
    over, when, fast = events.plot().axes
    assert texts(over) == texts(when) == ["contact_begin", "contact_end"]
    assert when.lines[0].get_xydata().tolist() == [pytest.approx([4.0, 1.0])]
    assert sum(patch.get_height() for patch in fast.patches) == 1
    # One part, into axes of one's own.
    axes = pyplot.figure().add_subplot()
    assert events.plot("histogram", axes=axes) is axes.figure and axes.get_xlabel() == "approach speed"


def test_nothing_to_draw_is_said(pyplot: Any) -> None:
    for figure in (ks.Events().plot(), crossing()[:0].plot()):
        for axes in figure.axes:
            assert [text.get_text() for text in axes.texts] == ["none"]


def test_wrong_parts_are_named(pyplot: Any) -> None:
    with pytest.raises(ks.InvalidValue, match='Events.plot: part must be "map", "time", "histogram" or None'):
        ks.Events().plot("pie")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="Approaches.plot: axes take one part"):
        crossing().plot(axes=pyplot.figure().add_subplot())
    with pytest.raises(ks.InvalidValue, match="Approaches.plot: tracks must be two arrays of one length"):
        crossing().plot("map", tracks=([0.0, 1.0], [0.0]))


def test_without_matplotlib_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def without(name: str, *more: Any, **named: Any) -> Any:
        if name.startswith("matplotlib"):
            raise ImportError(name)
        return real(name, *more, **named)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ImportError, match="Events.plot: needs matplotlib, which is not installed"):
        ks.Events().plot()


def test_a_world_is_a_small_table() -> None:
    world, motion = pair()
    world.run(10.0, motion)
    html = world._repr_html_()
    assert "World of 2 bodies at time 10" in html and "without walls" in html
    assert "<th>contacts</th><td>1</td>" in html and "broken" not in html
    torus = ks.World(dimensions=2, box=((0, 0), (4, 5)), periodic="x")
    assert "World of 0 bodies" in torus._repr_html_()
    assert "plane, from (0, 0) to (4, 5), periodic along x" in torus._repr_html_()
    assert "with walls" in ks.World(box=((0, 0, 0), (1, 1, 1)))._repr_html_()


def test_alerts_have_names_and_times_that_people_read() -> None:
    verdict: dict[str, Any] = {
        "event": "verdict", "time": 1700000040.0, "first": "4ca1fa", "first_name": "RYR<1", "second": "4ca1fb",
        "verdict": "apart", "before": "within", "distance": [100.0, 12000.0], "closest_distance": 90.0,
        "closest_time": 1700000030.0, "since": None,
    }  # fmt: skip
    lost = {"event": "lost", "time": 1700000050.0, "track": "4ca1fb", "first": "4ca1fa", "second": "4ca1fb"}
    alerts = ks.Alerts([verdict, lost], {})
    assert str(alerts).splitlines() == [
        "2023-11-14 22:14:00  over  RYR<1 and 4ca1fb                   100 to 12,000  90 at 2023-11-14 22:13:50",
        "2023-11-14 22:14:10  lost  4ca1fa and 4ca1fb, 4ca1fb is lost",
    ]
    html = alerts._repr_html_()
    assert "2 alerts" in html and "<td>RYR&lt;1 and 4ca1fb</td>" in html and "22:14:00" in html
    assert str(ks.Alerts([{**verdict, "time": 3.25}], {})).startswith("3.2")
    assert "2026-05-01 10:00:00" in str(ks.Alerts([{**verdict, "time": "2026-05-01T10:00:00Z"}], {}))
    assert str(alerts[:0]) == "<0 alerts>"
    pytest.importorskip("pandas")
    frame = alerts.to_pandas()
    assert frame["time"][1] == np.datetime64("2023-11-14T22:14:10")


def test_the_notebook_runs(pyplot: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its cells run one after the other, as Jupyter runs them, and no outputs are stored."""
    program = os.environ.get("KINESPHERE_PROGRAM")
    if not program:
        pytest.skip("KINESPHERE_PROGRAM does not name the program")
    monkeypatch.setenv("PATH", os.path.dirname(program), prepend=os.pathsep)
    monkeypatch.chdir(NOTEBOOK.parent)
    names: dict[str, Any] = {}
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    for cell in cells:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
            exec(compile("".join(cell["source"]), NOTEBOOK.name, "exec"), names)
    assert len(names["events"]) > 100 and len(names["approaches"]) > 5 and len(names["alerts"]) > 3
    assert len(pyplot.get_fignums()) == 2
    assert "KIN0" in str(names["alerts"]) and "2023-11-14 22:" in str(names["alerts"])
