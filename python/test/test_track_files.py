"""Approaches in files, read by the program."""

import os
from pathlib import Path

import numpy as np
import pytest

import kinesphere as ks

pytestmark = pytest.mark.skipif(
    not os.environ.get("KINESPHERE_PROGRAM"), reason="KINESPHERE_PROGRAM does not say where the program is"
)
program = os.environ.get("KINESPHERE_PROGRAM")


def written(folder: Path, text: str) -> Path:
    file = folder / "t.csv"
    file.write_text(text)
    return file


walk = "id,t,x,y\nu,0,0,0\nu,1,1,0\nu,2,2,0\nv,0,2,0.5\nv,1,1,0.5\nv,2,0,0.5\n"


def test_files_and_arrays_have_the_same_approaches(tmp_path: Path) -> None:
    found = ks.tracks_in(written(tmp_path, walk), 1, interpolate="linear", program=program)
    ids, t, x, y = np.array([line.split(",") for line in walk.splitlines()[1:]]).T
    same = ks.tracks(t.astype(float), x.astype(float), y.astype(float), None, ids, 1.0, interpolate="linear")
    assert len(found) == 1 and found.probes > 0
    assert (found["first"][0], found["second"][0]) == ("u", "v")
    for column in ("begin", "end", "closest_time", "closest_distance", "relative_speed"):
        assert found[column][0] == pytest.approx(same[column][0], abs=1e-6)
    assert found["first_position"][0][:2] == pytest.approx(same["first_position"][0][:2], abs=1e-6)
    assert (found["first_before"][0], found["second_after"][0], found["samples_apart"][0]) == (1, 1, 0)
    assert np.isnan(found["first_position"][0][2]) and not found["begins_with_track"][0]


def test_every_option_of_reading_reaches_the_program(tmp_path: Path) -> None:
    rows = "".join(
        f"{body};{day}/04/2025;{8 + 0.01 * body};47;{body}\n" for body in (1, 2) for day in (3, 4, 5)
    )
    file = written(tmp_path, "who;when;a;b;keep\n" + rows + "3;03/04/2025;;47;0\n3;03/04/2025;8;47;1\n")
    with pytest.warns(UserWarning, match="alone between two gaps"):
        found = ks.tracks_in(
            [file], "1km", format="table", columns="id=who,time=when,x=a,y=b", where="keep != 0",
            dates="day-first", positions="lonlat", projection="plane", missing="skip", duplicates="first",
            max_speed=1e3, max_gap=1e6, interpolate="spline", tolerance=0.01, program=program,
        )  # fmt: skip
    assert len(found) == 1 and found["begin"][0] == np.datetime64("2025-04-03")
    frames = written(tmp_path, "id frame x y\n1 0 0 0\n1 25 0 0\n2 0 90 0\n2 25 90 0\n")
    assert ks.tracks_in(frames, 1, frame_rate=25, unit="cm", program=program)["end"][0] == 1.0
    assert len(ks.tracks_in(frames, 1, time_unit="frames", frame_rate=25, program=program)) == 0
    assert len(ks.tracks_in(frames, 95, columns="id=1,time=2,x=3,y=4", time_unit="ms", program=program)) == 1


def test_rectangles_and_errors(tmp_path: Path) -> None:
    rows = [f"a,{t},{10 * t},0,4,2\nb,{t},{100 - 10 * t},3.5,4,2\n" for t in range(11)]
    file = written(tmp_path, "id,time,x_m,y_m,length_m,width_m\n" + "".join(rows))
    beside = ks.tracks_in(file, 2, sizes=True, heading="motion", program=program)
    assert len(beside) == 1 and beside["closest_distance"][0] == pytest.approx(1.5)
    possible = ks.tracks_in(file, 1, sizes=True, error="0.3m", program=program)
    assert list(possible["certain"]) == [False]
    assert list(ks.tracks_in(file, 3, sizes=True, error="0.3m:1m/s", program=program)["certain"]) == [True]
    assert len(ks.tracks_in(file, 1, sizes=True, acceleration="1m/s2", program=program)) == 0
    between = ks.tracks_in(file, 1, sizes=True, acceleration="5m/s2", largest_speed="20m/s", program=program)
    assert list(between["certain"]) == [False, False], "at their samples they are where they say"


def test_separations_sizes_and_windows(tmp_path: Path) -> None:
    file = written(
        tmp_path,
        "id,time,x,y,z,length,width\n"
        + "".join(
            f"a,{t},{10 * t},0,0,4,2\nb,{t},10,{10 * t - 10},1,4,2\nc,{t},{10 * t},9,9,4,2\n"
            for t in range(3)
        ),
    )
    flat = ks.tracks_in(file, separation="cylinder:5m:2m", unit="m", program=program)
    assert len(flat) == 1 and flat["vertical_distance"][0] == pytest.approx(1.0)
    above = ks.tracks_in(file, 5, sizes=True, program=program)
    assert above["closest_distance"][0] == pytest.approx(1.0)
    assert [len(ks.tracks_in(file, 13, only=ids, program=program)) for ids in ("c", ["a", "c"])] == [2, 3]
    assert len(ks.tracks_in(file, 13, from_=0.5, until=1.5, min_duration=0.9, program=program)) == 2
    assert len(ks.tracks_in(file, 5, from_=1.9, program=program)) == 0
    for wrong in ({}, {"distance": 1.0, "separation": "sphere:5m"}):
        with pytest.raises(TypeError, match="either distance or separation"):
            ks.tracks_in(file, **wrong, program=program)  # type: ignore[arg-type]


def test_questions_are_errors_and_warnings_are_warnings(tmp_path: Path) -> None:
    with pytest.raises(ks.InvalidValue, match="the id -1 is that of nobody"):
        ks.tracks_in(written(tmp_path, "id,t,x,y\n-1,0,0,0\n"), 1, program=program)
    half = written(tmp_path, walk + "u,3,,\n")
    with pytest.warns(UserWarning, match="have no time or no position"):
        ks.tracks_in(half, 1, missing="skip", program=program)
    with pytest.raises(FileNotFoundError):
        ks.tracks_in(half, 1, program=tmp_path / "none")


def test_what_was_not_looked_at_is_a_warning_and_in_the_summary(tmp_path: Path) -> None:
    rows = [(0, 0, 50), (10, 10, 40), (20, 20, 30), (80, 80, -30), (90, 90, -40)]
    plans = written(
        tmp_path, "id,time,x,y\n" + "".join(f"a,{t},{x},0\nb,{t},50,{y}\n" for t, x, y in rows) + "c,30,0,0\n"
    )
    with pytest.warns(UserWarning) as warned:
        found = ks.tracks_in(plans, 5, program=program)
    said = [str(one.message) for one in warned]
    assert any("not looked for in 60 s of the 90 s" in text for text in said), said
    assert any("have no track" in text and "'c'" in text for text in said), said
    assert found.summary is not None
    assert (len(found), found.summary["not_looked_at_s"], found.summary["together_s"]) == (0, 60, 90)
    assert (found.summary["pairs"], found.summary["pairs_never_looked_at"]) == (3, 2)
    assert found[:0].summary == found.summary
    with pytest.warns(UserWarning, match="have no track"):
        flown = ks.tracks_in(plans, 5, plan=True, program=program)
    assert flown["closest_time"][0] == pytest.approx(50)
    assert flown.summary is not None and flown.summary["not_looked_at_s"] == 0


def test_a_body_that_stays_after_its_last_sample(tmp_path: Path) -> None:
    rows = "".join(f"hover,{t},50,0\n" for t in range(5)) + "".join(
        f"pass,{t},{2 * t},1\n" for t in range(50)
    )
    file = written(tmp_path, "id,t,x,y\n" + rows)
    with pytest.warns(UserWarning, match="'hover' vanishes at 4, 'pass' 1 from there at 25"):
        found = ks.tracks_in(file, 1.5, program=program)
    assert len(found) == 0 and found.summary is not None and found.summary["near_ends"] == 1
    assert ks.tracks_in(file, 1.5, outside="stay", program=program)["closest_time"][0] == pytest.approx(25)


def test_ids_that_are_one_body_or_of_no_interest(tmp_path: Path) -> None:
    rows = "".join(f"a,{t},{t},0\n" for t in range(50)) + "".join(f"b,{t},{t},0.1\n" for t in range(47, 99))
    rows += "".join(f"c,{t},{t},0.5\n" for t in range(99))
    file = written(tmp_path, "id,t,x,y\n" + rows)
    with pytest.warns(UserWarning, match="'a' goes on as 'b' at 47"):
        found = ks.tracks_in(file, 0.2, ignore="c", program=program)
    assert len(found) == 0 and found.summary is not None
    assert found.summary["handovers"] == [{"from": "a", "to": "b", "at": 47}]
    assert len(ks.tracks_in(file, 0.6, ignore=["a"], program=program)) == 1
    joined = ks.tracks_in(file, 0.6, same={"a": "b"}, duplicates="first", program=program)
    assert len(joined) == 1 and joined["begin"][0] == 0
