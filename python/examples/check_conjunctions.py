"""Holds the search of conjunctions.py against brute force, with which it shares nothing but the elements.

    check_conjunctions.py [catalogue.tle[.gz]] [--distance KM] [--hours H] [--every N]

SGP4 itself propagates every N-th object at steps of 10 s. Each pair that may come near within a step is sampled by
SGP4 every 0.05 s, and each minimum of the distance is evaluated by SGP4. Needs SciPy and minutes to hours, as sgp4 may
be plain Python. Exit status 1 if the search has missed a minimum, or has one that is none.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from conjunctions import day, fit, invented, read, start_of
from scipy.spatial import cKDTree

Doubles = npt.NDArray[np.float64]
Whole = npt.NDArray[np.int64]
Minimum = tuple[int, int, float, float]

step = 10.0
sampling = 0.05
largest_relative_speed = 22.0
"""Two objects at the speed of escape, above the atmosphere, in km/s."""
bend = 2.0
"""A straight relative path over half a step is right to within this, in km: 0.02 km/s^2 bends it by 0.25, and central
differences of the positions give velocities to within 0.3 km/s."""
shallow = 0.01
"""Minima within this of the distance limit (km) may be found by one side alone."""


def positions(satellite: Any, start: tuple[float, float], times: Doubles) -> Doubles:
    """In km, NaN where SGP4 fails and after that."""
    fractions = start[1] + times / day
    errors, found, _ = satellite.sgp4_array(np.full(len(times), start[0]), fractions)
    failed = np.flatnonzero(errors)
    if len(failed) > 0:
        found[failed[0] :] = np.nan
    return np.asarray(found)


def near_pairs(at: Doubles, distance: float) -> Whole:
    """Rows of step, first and second object that may be within the distance less than half a step from the step."""
    velocities = np.gradient(at, step, axis=0)
    rows: list[Whole] = []
    for k in range(len(at)):
        there = np.flatnonzero(np.isfinite(at[k]).all(axis=1))
        pairs = cKDTree(at[k, there]).query_pairs(
            distance + largest_relative_speed * step / 2, output_type="ndarray"
        )
        first, second = there[pairs].T
        r = at[k, second] - at[k, first]
        v = velocities[k, second] - velocities[k, first]
        v[~np.isfinite(v)] = 0.0  # beside a failure of SGP4: the candidate is then as good as its position
        until = np.clip(-(r * v).sum(1) / np.maximum((v * v).sum(1), 1e-12), -step / 2, step / 2)
        near = np.linalg.norm(r + v * until[:, None], axis=1) < distance + bend
        rows.append(np.column_stack([np.full(near.sum(), k), first[near], second[near]]))
    return np.concatenate(rows)


def minima_by_sampling(
    satellites: list[Any], start: tuple[float, float], seconds: float, distance: float
) -> list[Minimum]:
    """First and second object, time and distance of each minimum within the distance."""
    times = np.arange(0.0, seconds + step / 2, step)
    at = np.stack([positions(one, start, times) for one in satellites], axis=1)
    rows = near_pairs(at, distance)
    print(f"{len(satellites)} objects, {len(rows)} pairs and steps to sample", flush=True)
    # One sample more on each side, so that minima at the border of two steps are seen; each counts once.
    around = sampling * np.arange(-step / 2 / sampling - 1, step / 2 / sampling + 2)
    found = []
    for k, a, b in rows:
        t = times[k] + around
        squares = ((positions(satellites[a], start, t) - positions(satellites[b], start, t)) ** 2).sum(axis=1)
        left, here, right = squares[:-2], squares[1:-1], squares[2:]
        for m in np.flatnonzero((here <= left) & (here < right) & (here < (distance + 1) ** 2)):
            # The parabola through three squares has its minimum where a straight relative path has it.
            shift = 0.5 * (left[m] - right[m]) / (left[m] - 2 * here[m] + right[m])
            time = t[m + 1] + sampling * shift
            if not times[k] - step / 2 <= time < times[k] + step / 2 or not 0 < time < seconds:
                continue
            r = [positions(satellites[one], start, np.array([time]))[0] for one in (a, b)]
            least = float(np.linalg.norm(r[0] - r[1]))
            if least <= distance + shallow:
                found.append((int(a), int(b), float(time), least))
    return found


def certain(minima: list[Minimum], distance: float) -> list[Minimum]:
    """Those that both sides must find."""
    return [one for one in minima if one[3] <= distance - shallow]


def compared(
    truth: list[Minimum], searched: Any, distance: float
) -> tuple[list[Minimum], list[Minimum], str]:
    """The minima that the search has missed, those that are none, and how far all others differ."""
    by_pair: dict[tuple[int, int], list[tuple[float, float]]] = {}
    for row in searched:
        by_pair.setdefault((int(row["first"]), int(row["second"])), []).append((row["time"], row["distance"]))
    missed: list[Minimum] = []
    farthest, latest = 0.0, 0.0
    for a, b, time, least in truth:
        others = by_pair.get((a, b), [])
        same = min(others, key=lambda other: abs(other[0] - time), default=None)
        if same is None or abs(same[0] - time) > 2.0:
            missed.append((a, b, time, least))
            continue
        others.remove(same)
        farthest, latest = max(farthest, abs(same[1] - least)), max(latest, abs(same[0] - time))
    spare = [(*pair, *other) for pair, others in by_pair.items() for other in others]
    differences = f"distances differ by at most {farthest:.1g} km, times by {latest:.1g} s"
    return certain(missed, distance), certain(spare, distance), differences


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("catalogue", nargs="?", type=Path)
    parser.add_argument("--distance", type=float, default=5.0, help="km")
    parser.add_argument("--hours", type=float, default=12.0)
    parser.add_argument("--every", type=int, default=12)
    options = parser.parse_args()

    satellites = read(options.catalogue)[:: options.every] if options.catalogue else invented()
    seconds = options.hours * 3600
    start = start_of(satellites)
    paths = fit(satellites, seconds, start)
    ends = np.zeros(len(satellites))
    np.maximum.at(ends, paths.bodies, paths.ends)
    searched = paths.approaches(options.distance + shallow).minima
    searched = searched[~searched["is_cut_off"]]
    truth = [
        one
        for one in minima_by_sampling(satellites, start, seconds, options.distance)
        if one[2] < min(ends[one[0]], ends[one[1]])
    ]

    missed, spare, differences = compared(truth, searched, options.distance)
    for what, found in (("missed", missed), ("not a minimum", spare)):
        for a, b, time, least in found:
            print(f"{what}: {a} and {b} at {time:.3f} s, {least:.6f} km")
    by_brute_force = sum(least <= options.distance for *_, least in truth)
    by_search = int((searched["distance"] <= options.distance).sum())
    print(
        f"{options.hours:g} h, within {options.distance:g} km: {by_brute_force} minima by brute force, {by_search} by the "
        f"search; {len(missed)} missed, {len(spare)} that are none; {differences}"
    )
    return 1 if missed or spare else 0


if __name__ == "__main__":
    sys.exit(main())
