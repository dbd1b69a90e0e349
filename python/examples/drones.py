"""Drones and alarms: whoever comes within 5 m of another is told so, and when.

The world knows of each drone that it accelerates with at most 4 m/s^2, and asks for reports only when that
could matter.
Usage: drones.py [picture.png]
"""

import sys

import matplotlib
import numpy as np

import kinesphere as ks

matplotlib.use("Agg")
import matplotlib.pyplot as plt

rng = np.random.default_rng(4)
count, limit, flight = 60, 4.0, 120.0
centres, sizes = rng.uniform(0, 400, (count, 3)), rng.uniform(5, 40, (count, 3))
# Each swings around its centre, as fast as its acceleration limit allows.
rates = np.sqrt(limit / np.linalg.norm(sizes, axis=1))[:, None]
phases = rng.uniform(0, 2 * np.pi, (count, 3))


def report(ids: np.ndarray, t: float) -> tuple[np.ndarray, np.ndarray]:  # type: ignore[type-arg]
    angle = rates[ids] * t + phases[ids]
    return centres[ids] + sizes[ids] * np.sin(angle), sizes[ids] * rates[ids] * np.cos(angle)


world = ks.World(contact_tolerance=1e-3)
drones = world.add(*report(np.arange(count), 0.0), radii=0.5, acceleration_limits=1.001 * limit)
world.set_sensor(0, [5.0, 20.0])
events = world.run(flight, report)
alarms = events.of_kind(ks.EventKind.sensor_enter)
for kind in (ks.EventKind.sensor_enter, ks.EventKind.contact_begin):
    print(f"{len(events.of_kind(kind)):4} times {kind}")
print(f"{world.counters.probes / count / flight:.2f} reports per drone and second")
quiet = [world.earliest_approach(drone, 5.0).time - world.time for drone in drones]
print(f"certain now, whatever they do: no alarm of the median drone for {np.median(quiet):.2f} s")

plt.eventplot(
    [alarms["time"][alarms["distance"] == d] for d in (20.0, 5.0)], colors=["tab:orange", "tab:red"]
)
plt.yticks([0, 1], ["20 m", "5 m"])
plt.xlabel("time (s)")
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "drones.png")
