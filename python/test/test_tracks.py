"""Approaches in recorded tracks."""

import gzip
import re

import numpy as np
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
    found = ks.tracks(table[:, 0] / 25, table[:, 2], table[:, 4], None, table[:, 1].astype(int), 0.4, interpolate=interpolate)  # type: ignore[arg-type]
    assert len(found) > 100
    if printed is not None:
        counted = re.search(r"^approaches +([\d,]+)", printed, re.MULTILINE)
        assert counted is not None and len(found) == int(counted[1].replace(",", ""))
