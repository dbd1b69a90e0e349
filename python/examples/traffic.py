"""Traffic conflicts at a crossing: times to collision and post-encroachment times, from recorded tracks alone.

One stream goes east and one north, ten samples a second. Most drivers of the second see to it that they cross behind
who is there first; some look late. tracks() gives, for each pair that came near, the least time in which they would
have collided had both gone straight on, and how long after one had left a place the other entered it.
"""

import numpy as np
import numpy.typing as npt

import kinesphere as ks

Doubles = npt.NDArray[np.float64]

rng = np.random.default_rng(9)
radius, interval, start = 1.0, 0.1, -80.0  # metres, seconds, metres before the crossing
vehicles = 60


def drive(
    enters: float, speed: float, brakes_at: float, brake: float, slows_to: float
) -> tuple[Doubles, Doubles]:
    """Times, and the way along the road: at one speed, with one braking (m/s^2) to a lower speed."""
    t, way, now = [enters], [start], speed
    while way[-1] < -start:
        if way[-1] > brakes_at:
            now = max(slows_to, now - brake * interval)
        t.append(t[-1] + interval)
        way.append(way[-1] + now * interval)
    return np.array(t), np.array(way)


def reaches(t: Doubles, way: Doubles) -> float:
    return float(np.interp(0.0, way, t))


times, ids, positions = [], [], []
at_crossing: list[tuple[int, float]] = []
for vehicle in range(vehicles):
    eastbound = vehicle % 2 == 0
    enters, speed = 3.5 * (vehicle // 2) + rng.uniform(0, 1.0), rng.uniform(11.0, 15.0)
    t, way = drive(enters, speed, np.inf, 0.0, speed)
    ahead = [at for other, at in at_crossing if other % 2 == 0]
    if not eastbound and min(abs(reaches(t, way) - at) for at in ahead) < 1.0:
        looks_late = rng.uniform() < 0.4
        t, way = (
            drive(enters, speed, -25.0, 6.0, 0.35 * speed)
            if looks_late
            else drive(enters, speed, -60.0, 2.0, 0.75 * speed)
        )
    at_crossing.append((vehicle, reaches(t, way)))
    times.append(t)
    ids.append(np.full(len(t), vehicle))
    positions.append(np.stack([way, np.zeros(len(t))] if eastbound else [np.zeros(len(t)), way], axis=1))

x, y = np.concatenate(positions).T
found = ks.tracks(np.concatenate(times), x, y, None, np.concatenate(ids), distance=40.0, radii=radius)
crossing = found[found["first"] % 2 != found["second"] % 2]
collision, encroachment = crossing["least_time_to_collision"], crossing["post_encroachment_time"]
print(f"{vehicles} vehicles, {len(crossing)} pairs of both roads came within 40 m of each other")
print(f"time to collision below 1.5 s: {np.sum(collision < 1.5)}, post-encroachment time below 1 s: ", end="")
print(f"{np.sum(encroachment < 1.0)}, collisions: {np.sum(crossing['closest_distance'] <= 0)}")
print("the most dangerous:\n  east  north  time to collision  post-encroachment  closest")
for k in np.argsort(np.minimum(collision, encroachment))[:5]:
    pair = crossing.array[k]
    print(f"{pair['first']:6d} {pair['second']:6d} {collision[k]:16.2f} s {encroachment[k]:16.2f} s", end="")
    print(f" {pair['closest_distance']:6.2f} m")

# Who is second enters the middle of the crossing a radius before its centre does, and the first leaves it one later.
centre = dict(at_crossing)
between = np.abs([centre[int(one["first"])] - centre[int(one["second"])] for one in crossing.array])
seen = encroachment < np.inf
assert np.sum(seen) > 40 and np.all(
    encroachment[seen] <= np.maximum(between - 2 * radius / 15.0, 0.0)[seen] + 0.02
)
assert np.any(collision < 1.5) and np.any(encroachment < 1.0)
