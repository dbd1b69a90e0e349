"""Alerts of the program on recorded streams."""

import os
from pathlib import Path

import numpy as np
import pytest

import kinesphere as ks

program = os.environ.get("KINESPHERE_PROGRAM")
pytestmark = pytest.mark.skipif(not program, reason="KINESPHERE_PROGRAM does not say where the program is")
streams = Path(__file__).parents[2] / "examples" / "streams"
drones = {"acceleration": 5, "position_error": 2, "velocity_error": 0.3}


def test_a_file_and_its_lines_have_the_alerts_of_the_docs() -> None:
    file = streams / "drones.csv"
    alerts = ks.watch(file, "sphere:15", **drones, program=program)
    assert [alert["event"] for alert in alerts] == ["predicted", "verdict"]
    assert alerts.summary["reports"] == 2400 and repr(alerts) == "<2 alerts>"
    assert ks.watch(file.read_text().splitlines(), "sphere:15", **drones, program=program).rows == alerts.rows
    assert (
        ks.watch(file.read_bytes().splitlines(), "sphere:15", **drones, program=program).rows == alerts.rows
    )
    assert alerts["time"] == pytest.approx([20.2, 29.1], abs=0.1) and alerts["time"].dtype == np.float64
    assert list(alerts["first"]) == ["d1", "d1"] and np.isnan(alerts["inevitable_by"][0])
    assert len(alerts[1:]) == 1 and alerts[1:][0] is alerts[1] and alerts.of("verdict").rows == [alerts[1]]
    assert list(alerts.to_pandas()["closest_distance"]) == list(alerts["closest_distance"])
    with pytest.raises(KeyError):
        alerts["colour"]


def test_options_reach_the_program() -> None:
    two = ks.watch(
        streams / "drones.csv", ["sphere:15", "sphere:30"], **drones, only=["within", "lost"], program=program
    )
    assert set(two["separation"]) == {"sphere:15", "sphere:30"} and len(two.of("predicted")) == 0
    own = ks.watch(
        streams / "harbour.nmea", "sphere:0.5NM:12min", own=211000001, no_classes=True, program=program
    )
    assert len(own) > 0 and all("211000001" in (one["first"], one["second"]) for one in own)


def test_what_the_program_refuses_is_an_error() -> None:
    with pytest.raises(ks.InvalidValue, match="watch: --acceleration, --largest-speed: expected one of them"):
        ks.watch(streams / "drones.csv", "sphere:15", program=program)
    with pytest.raises(ks.InvalidValue, match="empty") as refused:
        ks.watch([], "sphere:15", program=program)
    assert refused.value.argument == "stream"
    with pytest.raises(TypeError, match="serve"):
        ks.watch([], "sphere:15", serve=8080, program=program)
    with pytest.raises(FileNotFoundError):
        ks.watch([], "sphere:15", program="/nonexistent")
