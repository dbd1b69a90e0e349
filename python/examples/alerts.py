"""Alerts from a recorded stream of air traffic: who comes near whom, a minute ahead, and who certainly does.

The stream is JSON of readsb (aircraft.json), a document in each line. Aircraft shall keep 5 nautical miles or
1,000 feet apart.
Usage: alerts.py [sky.json]
"""

import json
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import kinesphere as ks

FOOT, KNOT, MILE = 0.3048, 1852 / 3600, 1852.0
METRES_IN_DEGREE = 111_319.5
default = Path(__file__).parents[2] / "examples" / "streams" / "sky.json"
file = Path(sys.argv[1]) if len(sys.argv) > 1 else default

# Airliners turn with at most 6 m/s^2, and change their climb with at most 3 m/s^2.
monitor = ks.Monitor(
    classes=[
        ks.TrackClass(
            acceleration_limit=ks.ErrorBound.cylinder(6.0, 3.0),
            largest_speed=ks.ErrorBound.cylinder(400.0, 60.0),
        )
    ],
    separations=[ks.SeparationRule(0, 0, [ks.Separation.cylinder(5 * MILE, 1000 * FOOT, look_ahead=60.0)])],
    tolerance=1.0,
    stale_after=30.0,
    prediction_hold=60.0,
)
names: dict[int, str] = {}


def tell(event: ks.MonitorEvent) -> None:
    clock = time.strftime("%H:%M:%SZ", time.gmtime(event.time))
    if event.second is None:
        return print(f"{clock}  {names[event.first]}: {event.kind}")
    who = f"{names[event.first]} and {names[event.second]}"
    if event.kind == ks.MonitorEventKind.predicted:
        ahead = event.closest_time - event.time
        print(f"{clock}  {who}: closest {event.closest_distance / MILE:.2f} NM in {ahead:.0f} s")
    elif event.verdict == ks.Verdict.within:
        answer = monitor.answer(event.first, event.second)
        print(f"{clock}  {who}: within, {answer.lower / MILE:.2f} to {answer.upper / MILE:.2f} NM apart")
    elif event.before == ks.Verdict.within:
        print(f"{clock}  {who}: no longer certainly within")
    elif event.kind == ks.MonitorEventKind.prediction_ended:
        print(f"{clock}  {who}: over")


def columns(aircraft: list[dict[str, Any]], *keys: str) -> list[Any]:
    return [np.array([one[key] for one in aircraft], dtype=float) for key in keys]


origin = None
for line in file.read_text().splitlines():
    document = json.loads(line)
    for event in monitor.events(document["now"]):
        tell(event)
    wanted = {"hex", "lat", "lon", "alt_baro", "gs", "track", "baro_rate", "seen_pos", "rc", "nac_v"}
    aircraft = [one for one in document["aircraft"] if wanted <= one.keys() and one["alt_baro"] != "ground"]
    latitude, longitude, feet, knots, course, climb, age, radius, nac_v = columns(
        aircraft, "lat", "lon", "alt_baro", "gs", "track", "baro_rate", "seen_pos", "rc", "nac_v"
    )
    # Metres east and north in a plane, which does for a region of this size.
    if origin is None:
        origin = latitude.mean(), longitude.mean()
    east = METRES_IN_DEGREE * np.cos(np.radians(origin[0])) * (longitude - origin[1])
    north = METRES_IN_DEGREE * (latitude - origin[0])
    angle, speed = np.radians(course), knots * KNOT
    # The containment radius, and altitudes in steps of 25 ft; velocities by their category of accuracy (DO-260B).
    velocity_errors = 2.5 * np.array([np.inf, 10.0, 3.0, 1.0, 0.3])[nac_v.astype(int)]
    ids = np.array([int(one["hex"].lstrip("~"), 16) for one in aircraft])
    names.update((int(id), one.get("flight", one["hex"]).strip()) for id, one in zip(ids, aircraft))
    monitor.report(
        ids,
        document["now"] - age,
        np.stack([east, north, feet * FOOT], axis=1),
        np.stack([speed * np.sin(angle), speed * np.cos(angle), climb * FOOT / 60], axis=1),
        position_errors=np.stack([radius, np.full(len(ids), 75 * FOOT)], axis=1),
        velocity_errors=velocity_errors,
    )
for event in monitor.events(monitor.time):
    tell(event)

print(f"{monitor.counters.reports:,} reports of {len(monitor)} aircraft")
for pair in monitor.predicted_pairs():
    print(f"still ahead: {names[int(pair['first'])]} and {names[int(pair['second'])]}")
