"""Ships in a harbour, 30 to 400 m long: capsules that turn slowly, and of which only limits are known.

Two pass each other with 77 m between the hulls, which circles around them would call a collision; a third runs into
the long one's side.
"""

import numpy as np
import numpy.typing as npt

import kinesphere as ks

Doubles = npt.NDArray[np.float64]
Ids = npt.NDArray[np.int64]

names = ["tanker", "ferry", "tug"]
lengths, beams = [400.0, 160.0, 30.0], [60.0, 26.0, 10.0]
starts = np.array([(0, 0, 0), (120, 900, 0), (-520, 520, 0)], dtype=float)
velocities = np.array([(0, 6, 0), (0, -9, 0), (5, 0.4, 0)])
headings, turns = np.radians([90, -90, 6]), np.radians([0, 0, 0.5])  # from east to north, and per second


def report(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
    return starts[ids] + velocities[ids] * t, velocities[ids]


def rotation(ids: Ids, t: float) -> tuple[Doubles, Doubles]:
    half, zero = (headings + turns * t)[ids] / 2, np.zeros(len(ids))
    orientations = np.stack([np.cos(half), zero, zero, np.sin(half)], axis=1)
    return orientations, np.stack([zero, zero, turns[ids]], axis=1)


# In the plane; a contact counts within a centimetre. Nobody knows the courses, only that a ship changes its velocity
# by at most 0.05 m/s^2 and turns by at most 2 degrees a second, with at most 0.5 degrees / s^2.
world = ks.World(dimensions=2, contact_tolerance=0.01)
for ship, (length, beam) in enumerate(zip(lengths, beams)):
    half = (length - beam) / 2
    orientations, spins = rotation(np.array([ship]), 0.0)
    world.add_rigid_body(
        [ks.Capsule((-half, 0), (half, 0), beam / 2)],
        starts[ship],
        velocities[ship],
        acceleration_limit=0.05,
        orientation=orientations[0],
        angular_velocity=spins[0],
        angular_acceleration_limit=np.radians(0.5),
        largest_angular_speed=np.radians(2),
    )
world.set_rotation_probe(rotation)

least, touched = np.inf, []
for second in range(1, 101):
    for event in world.events(second, report):
        assert event.second is not None
        pair = f"{names[event.first]} and {names[event.second]}"
        print(f"{event.time:6.2f} s: {pair} {event.kind} at ({event.point[0]:.1f}, {event.point[1]:.1f})")
        touched.append(pair)
    least = min(least, world.distance_limits(0, 1, second, report).lower)
print(f"tanker and ferry pass each other at {least:.1f} m; circles around them would overlap")
print(f"{world.counters.probes} reports")
assert 70 < least < 80 and touched[0] == "tanker and tug"
