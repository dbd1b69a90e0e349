"""Approaches in recorded tracks."""

import gzip
import re
from datetime import timedelta
from typing import Optional

import numpy as np
import numpy.typing as npt
import pytest
from conftest import data_file, native

import kinesphere as ks

t = np.arange(0.0, 10.5, 0.5)
east = np.stack([t, 0 * t], axis=1)  # meets `north` at time 5, at distance 0
north = np.stack([5 + 0 * t, t - 5], axis=1)
times = np.tile(t, 2)
x, y = np.concatenate([east, north]).T
who = np.repeat([7, 3], len(t))


def test_two_that_cross() -> None:
    found = ks.tracks(times, x, y, None, who, 1.0)
    assert len(found) == 1 and (found["first"][0], found["second"][0]) == (3, 7)
    half = 1 / np.sqrt(2)  # |(t - 5, t - 5)| = 1
    assert found["begin"][0] == pytest.approx(5 - half, abs=1e-5) and found["end"][0] == pytest.approx(
        5 + half, abs=1e-4
    )
    assert found["closest_time"][0] == pytest.approx(5) and found["closest_distance"][0] == pytest.approx(
        0, abs=1e-9
    )
    assert found["first_position"][0] == pytest.approx([5, 0, 0], abs=1e-9)
    assert found["relative_speed"][0] == pytest.approx(np.sqrt(2)) and not found["ends_with_track"][0]
    assert found.probes > 0 and "1 approaches" in repr(found)
    assert len(found.to_pandas()) == 1


def test_the_order_of_rows_the_origin_and_the_kind_of_ids_do_not_matter() -> None:
    expected = ks.tracks(times, x, y, None, who, 1.0)
    shuffled = np.random.default_rng(5).permutation(len(times))
    names = np.where(who == 7, "walker", "another")
    found = ks.tracks(
        times[shuffled] + 1.7e9, x[shuffled] + 5e5, y[shuffled] + 6e6, 0 * x, names[shuffled], 1.0
    )
    assert (found["first"][0], found["second"][0]) == ("another", "walker")
    assert found["begin"][0] - 1.7e9 == pytest.approx(expected["begin"][0], abs=1e-4)
    assert found["second_position"][0] == pytest.approx([500005, 6e6, 0])
    straight = ks.tracks(times.astype(np.float32), x, y, None, who, 1.0, interpolate="linear")
    assert straight["begin"][0] == pytest.approx(expected["begin"][0], abs=1e-5)


def test_a_data_frame_is_a_recording() -> None:
    pandas = pytest.importorskip("pandas")
    expected = ks.tracks(times, x, y, None, who, 1.0)
    frame = pandas.DataFrame({"t": times, "x": x, "y": y, "id": who, "width": np.where(who == 7, 0.25, 0.5)})
    assert np.array_equal(ks.tracks(frame, distance=1.0).array, expected.array)
    other = frame.rename(columns={"t": "seconds", "id": "ship"}).sample(frac=1, random_state=3)
    found = ks.tracks(other, distance=1.0, columns={"t": "seconds", "id": "ship"})
    assert np.array_equal(found.array, expected.array)
    with pytest.raises(
        ks.InvalidValue, match="columns must say which is t, as there is no 't' among seconds"
    ):
        ks.tracks(other, distance=1.0)
    with pytest.raises(ks.InvalidValue, match="names speed"):
        ks.tracks(frame, distance=1.0, columns={"speed": "x"})
    sized = ks.tracks(frame, distance=1.0, columns={"radii": "width"})
    assert sized["closest_distance"][0] == pytest.approx(-0.75) and sized["begin"][0] < expected["begin"][0]
    shown = sized[:1].to_pandas()
    assert shown["least_time_to_collision"][0] == 0.0 and "1 approaches" in (sized._repr_html_() or "")


def test_degrees_and_texts_are_refused_and_durations_are_seconds() -> None:
    pandas = pytest.importorskip("pandas")
    twice = np.array([0.0, 1.0, 0.0, 1.0])
    frame = pandas.DataFrame({"id": [1, 1, 2, 2], "t": twice, "lon": 8.0, "lat": [47.0, 47.0, 47.5, 47.5]})
    for columns in (None, {"x": "lon", "y": "lat"}):
        with pytest.raises(ks.InvalidValue, match="lengths as x and y, but 'lon' has degrees"):
            ks.tracks(frame, distance=1.0, columns=columns)
    place = [0.0, 0.0, 0.5, 0.5]
    with pytest.raises(TypeError, match="pandas.to_datetime makes dates of texts"):
        ks.tracks(["a", "b", "a", "b"], place, place, id=[1, 1, 2, 2], distance=1.0)
    durations = (twice * 1000).astype("timedelta64[ms]")
    assert ks.tracks(durations, place, place, id=[1, 1, 2, 2], distance=1.0)["end"][0] == 1.0


def test_times_to_collision_are_those_of_straight_motion() -> None:
    apart = ks.tracks(times, x, y + np.where(who == 3, 0.4, 0.0), None, who, 1.0, radii=0.1)
    # The way is (t - 5, t - 5 + 0.4) for two of radius 0.1: at least 0.4 / sqrt(2) - 0.2 apart, on no course.
    assert apart["closest_distance"][0] == pytest.approx(0.4 / np.sqrt(2) - 0.2)
    assert np.isinf(apart["least_time_to_collision"][0]) and np.isnan(apart["least_time_at"][0])
    meet = np.array([4.0, 4.5, 5.0, 5.5])
    # Two on one line, 4 apart at time 4, that close at speed 2 until one turns off at 5.
    along, aside = np.concatenate([meet, 12 - meet]), np.array([0, 0, 0, 0, 0, 0, 0, 3.0])
    ids = np.repeat(["a", "b"], 4)
    near = ks.tracks(np.tile(meet, 2), along, aside, None, ids, 5.0, interpolate="linear", radii=0.5)
    # At time 5 they are 2 apart, less their radii 1, and close at speed 2.
    assert near["least_time_to_collision"][0] == pytest.approx(0.5, abs=1e-4)
    assert near["least_time_at"][0] == pytest.approx(5.0, abs=1e-4)


def test_post_encroachment_times_are_those_of_discs() -> None:
    # One passes the crossing at 5 s at 2 m/s, the other at 8 s at 1 m/s; their radii are 1 m.
    moments, ids = np.array([0.0, 10.0, 0.0, 10.0]), np.array([1, 1, 2, 2])
    east, north = np.array([-10.0, 10.0, 0.0, 0.0]), np.array([0.0, 0.0, -8.0, 2.0])

    def found(y: npt.NDArray[np.float64], radii: Optional[float]) -> ks.Approaches:
        return ks.tracks(moments, east, y, None, ids, 100.0, radii=radii, interpolate="linear", max_gap=100.0)

    crossing = found(north, 1.0)
    assert crossing["post_encroachment_time"][0] == pytest.approx(3.0 - np.sqrt(5.0), abs=1e-4)
    assert crossing["time_of_entry"][0] == pytest.approx(8.0 - 4.0 / np.sqrt(5.0), abs=1e-2)
    beside = found(np.array([0.0, 0.0, 8.0, 9.0]), 1.0)
    assert np.isinf(beside["post_encroachment_time"][0]) and np.isnan(beside["time_of_entry"][0])
    points = found(north, None)
    assert "post_encroachment_time" not in (points.array.dtype.names or ())


@pytest.mark.parametrize("unit", ["s", "ms", "ns"])
def test_dates_come_back_as_dates(unit: str) -> None:
    pandas = pytest.importorskip("pandas")
    expected = ks.tracks(times, x, y, None, who, 1.0)
    start = np.datetime64("2024-02-28T23:59:55", "ns")
    dates = start + (times * 1e9).astype("timedelta64[ns]")
    kept = times % 1 == 0 if unit == "s" else times >= 0
    found = ks.tracks(dates[kept].astype(f"datetime64[{unit}]"), x[kept], y[kept], None, who[kept], 1.0)
    assert found["begin"].dtype == np.dtype("datetime64[ns]")
    assert (found["closest_time"][0] - start) / np.timedelta64(1, "s") == pytest.approx(5, abs=1e-8)
    assert (found["begin"][0] - start) / np.timedelta64(1, "s") == pytest.approx(
        expected["begin"][0], abs=1e-4
    )
    zoned = pandas.Series(dates).dt.tz_localize("UTC").dt.tz_convert("Asia/Tokyo")
    in_zone = ks.tracks(zoned, x, y, None, who, 1.0, max_gap=np.timedelta64(5, "s"))
    assert (
        in_zone["begin"][0]
        == ks.tracks(dates, x, y, None, who, 1.0, max_gap=timedelta(seconds=5))["begin"][0]
    )
    dates[6] = np.datetime64("NaT")
    with pytest.raises(ks.InvalidValue, match="t must be times, but is NaT at 6"):
        ks.tracks(dates, x, y, None, who, 1.0)


def test_a_gap_ends_a_track() -> None:
    kept = ~((who == 7) & (times > 3) & (times < 7))
    assert len(ks.tracks(times[kept], x[kept], y[kept], None, who[kept], 1.0)) == 0
    assert len(ks.tracks(times[kept], x[kept], y[kept], None, who[kept], 1.0, max_gap=10.0)) == 1


def test_nothing_and_one_are_no_tracks() -> None:
    assert len(ks.tracks([], [], [], None, [], 1.0)) == 0
    assert len(ks.tracks([1.0], [1.0], [1.0], None, [1], 1.0)) == 0


def test_wrong_samples_are_named() -> None:
    wrong = [
        ((times, x[:-1], y, None, who, 1.0), {}, "x must have shape"),
        ((times, x, y, None, who[:-1], 1.0), {}, "id must have shape"),
        (
            (np.where(times == 3, np.nan, times), x, y, None, who, 1.0),
            {},
            "t must be finite, but is not at 6",
        ),
        (
            (0 * times, x, y, None, who, 1.0),
            {},
            "t must have one sample of each id at a time, but id 3 has two at 0.0",
        ),
        ((times, x, y, None, who, 0.0), {}, "distance must be finite and > 0"),
        ((times, x, y, None, who, 1.0), {"tolerance": 2.0}, "tolerance must be from"),
        ((times, x, y, None, who, 1.0), {"interpolate": "cubic"}, "interpolate"),
    ]
    for arguments, options, message in wrong:
        with pytest.raises(ks.InvalidValue, match=message):
            ks.tracks(*arguments, **options)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="x must be real numbers"):
        ks.tracks(times, x.astype(str), y, None, who, 1.0)


@pytest.mark.parametrize("interpolate", ["spline", "linear"])
def test_a_recording_has_the_approaches_that_the_program_finds(interpolate: str) -> None:
    file = data_file("ucy_students03", "ucy_students03_obsmat.txt.gz")
    printed = native(
        "tracks", str(file), "--format", "ucy", "--distance", "0.4", "--interpolate", interpolate
    )
    with gzip.open(file) as lines:
        table = np.loadtxt(lines)
    found = ks.tracks(table[:, 0] / 25, table[:, 2], table[:, 4], None, table[:, 1].astype(int), 0.4, interpolate=interpolate)  # type: ignore[call-overload]
    assert len(found) > 100
    if printed is not None:
        counted = re.search(r"^approaches +([\d,]+)", printed, re.MULTILINE)
        assert counted is not None and len(found) == int(counted[1].replace(",", ""))
