"""Approaches on known paths."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import data_file

import kinesphere as ks

chebval: Any = np.polynomial.chebyshev.chebval
examples = Path(__file__).resolve().parent.parent / "examples"


def two(**arguments: Any) -> ks.PolynomialPaths:
    coefficients = [[[0, 1], [0, 0], [0, 0]], [[9, -1], [0, 0], [2, 0]]]
    return ks.PolynomialPaths([0, 1], [0.0, 0.0], [10.0, 10.0], coefficients, basis="monomial", **arguments)


def test_two_that_pass_each_other() -> None:
    found = two().approaches(3.0)
    assert len(found) == 1 and repr(found) == "<1 approaches with 1 minima>"
    row, minimum = found.approaches[0], found.minima[0]
    assert (row["first"], row["second"], row["closest"]) == (0, 1, 0) and row["is_certain"]
    assert row["begin"] == pytest.approx(4.5 - 5**0.5 / 2) and row["end"] == pytest.approx(
        4.5 + 5**0.5 / 2
    )
    assert minimum["time"] == pytest.approx(4.5) and minimum["distance"] == pytest.approx(2.0)
    assert minimum["relative_speed"] == pytest.approx(2.0) and not minimum["is_cut_off"]
    assert minimum["second_position"] == pytest.approx([4.5, 0, 2])
    # The first moves straight away from the origin.
    assert minimum["relative_velocity_rtn"] == pytest.approx([-2, np.nan, np.nan], nan_ok=True)
    assert found.to_pandas()["second_position_z"][0] == pytest.approx(2.0)


def test_options() -> None:
    assert len(two().approaches(3.0, end=3.0)) == 0 and len(two().approaches(3.0, begin=5.0, end=8.0)) == 1
    assert not two(errors=0.6).approaches(3.0).approaches["is_certain"][0]
    assert len(two(errors=[0.0, 0.2]).approaches(1.9)) == 1
    done: list[float] = []
    assert len(two().approaches(3.0, body=1, threads=2, progress=done.append)) == 1
    assert done[-1] == 1.0 and done == sorted(done)

    def stop(done: float) -> None:
        raise KeyError(done)

    with pytest.raises(KeyError):
        two().approaches(3.0, progress=stop)


def test_chebyshev_is_that_of_numpy() -> None:
    random = np.random.default_rng(3)
    coefficients = random.uniform(-1, 1, (40, 3, 6))
    paths = ks.PolynomialPaths(np.arange(40), np.zeros(40), np.full(40, 4.0), coefficients)
    found = paths.approaches(0.3)
    assert len(found) > 10
    for row in found.minima:
        for who in ("first", "second"):
            place = chebval(row["time"] / 2 - 1, coefficients[row[who]].T)
            assert row[f"{who}_position"] == pytest.approx(place, abs=1e-12)


def test_wrong_arrays_are_refused() -> None:
    good: Any = [0, 1], [0.0, 0.0], [1.0, 1.0], np.zeros((2, 3, 1))
    for wrong, name in [
        ([[0.5, 1], *good[1:]], "bodies"), ([[-1, 1], *good[1:]], "bodies"), ([good[0], [0.0], *good[2:]], "begins"),
        ([*good[:2], [1.0], good[3]], "ends"), ([*good[:3], np.zeros((2, 3))], "coefficients"),
    ]:  # fmt: skip
        with pytest.raises(ks.InvalidValue, match=name):
            ks.PolynomialPaths(*wrong)
    with pytest.raises(ks.InvalidValue, match="paths.bodies of arc 1|paths.bodies"):
        ks.PolynomialPaths([1, 0], *good[1:]).approaches(1.0)
    with pytest.raises(ks.InvalidValue, match="paths.coefficients"):
        ks.PolynomialPaths(good[0], good[1], good[2], np.full((2, 3, 1), np.nan)).approaches(1.0)
    with pytest.raises(ks.InvalidValue, match="distance"):
        two().approaches(0.0)


def conjunctions() -> Any:
    pytest.importorskip("sgp4")
    spec = importlib.util.spec_from_file_location("conjunctions", examples / "conjunctions.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_conjunctions_are_those_of_sgp4() -> None:
    """Brute force by SGP4 itself, at steps of 4 s on a few objects, misses nothing that was found, and the reverse."""
    module = conjunctions()
    try:
        satellites = module.read(data_file("tle/catalogue_2026-05-30.tle.gz"))[::80]
    except pytest.skip.Exception:
        satellites = module.invented()
    start, seconds, distance, step = module.start_of(satellites), 3600.0, 60.0, 4.0
    found = module.fit(satellites, seconds, start).approaches(distance)
    times = np.arange(0.0, seconds, step)
    fractions = start[1] + times / 86400
    places = np.stack([one.sgp4_array(np.full(len(times), start[0]), fractions)[1] for one in satellites])
    seen = np.zeros((len(satellites), len(satellites)), bool)
    for at in range(len(times)):
        square = np.sum((places[:, None, at] - places[None, :, at]) ** 2, axis=2)
        seen |= square < distance**2
    first, second = np.nonzero(np.triu(seen, 1))
    of_pair = set(zip(found.approaches["first"], found.approaches["second"]))
    assert len(first) > 0 and set(zip(first, second)) <= of_pair
    for row in found.minima:
        pair = [
            satellites[row[who]].sgp4(start[0], start[1] + row["time"] / 86400)[1]
            for who in ("first", "second")
        ]
        assert np.linalg.norm(np.subtract(*pair)) == pytest.approx(row["distance"], abs=2 * module.fit_error)


def test_messages_have_the_keywords_of_the_standard(tmp_path: Path) -> None:
    pytest.importorskip("sgp4")
    subprocess.run(
        [sys.executable, str(examples / "conjunctions.py"), "--distance", "50", "--hours", "3",
         "--table", str(tmp_path / "table.csv"), "--cdm", str(tmp_path / "messages")], check=True, capture_output=True)  # fmt: skip
    rows: Any = np.genfromtxt(tmp_path / "table.csv", delimiter=",", names=True)
    assert len(rows) > 0 and (rows["distance_km"] <= 50.002).all()
    message = (tmp_path / "messages" / "conjunction_0.cdm").read_text()
    values = dict(re.findall(r"^(\w+) = ([-\d.]+) \[m\]$", message, re.M))
    parts = [float(values[f"RELATIVE_POSITION_{axis}"]) for axis in "RTN"]
    assert np.linalg.norm(parts) == pytest.approx(float(values["MISS_DISTANCE"]), abs=0.01)
    for keyword in ("CCSDS_CDM_VERS", "TCA", "OBJECT", "X_DOT", "CNDOT_NDOT"):
        assert re.search(rf"^{keyword} = ", message, re.M)
