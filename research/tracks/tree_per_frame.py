#!/usr/bin/env python3
"""Who came close to whom in a table of positions, as a script does it: a tree of all positions in each frame.

Between reports everyone goes straight on; nothing is known of what happens between two frames. An id whose next
report is more than GAP seconds away is not there in between.

Usage: tree_per_frame.py FILE.csv --distance D [--step SECONDS] [--gap SECONDS]
"""
import argparse
import csv
import time

import numpy
from scipy.spatial import cKDTree


def read(name):
    reports = {}
    with open(name, newline="") as file:
        for row in csv.DictReader(file):
            place = (float(row["x"]), float(row["y"]), float(row.get("z") or 0.0))
            reports.setdefault(row["id"], []).append((float(row["time"]), place))
    ids = list(reports)
    for id in ids:
        reports[id].sort()
    times = [numpy.array([report[0] for report in reports[id]]) for id in ids]
    places = [numpy.array([report[1] for report in reports[id]]) for id in ids]
    return ids, times, places


def frames_of(times, places, frames, gap):
    """Where everyone is in each frame (NaN: nowhere), by frame and id."""
    where = numpy.full((len(frames), len(times), 3), numpy.nan)
    for k, (own, at) in enumerate(zip(times, places)):
        if len(own) < 2:
            continue
        after = numpy.searchsorted(own, frames, side="right")
        there = (after > 0) & (after < len(own))
        after = numpy.clip(after, 1, len(own) - 1)
        there &= own[after] - own[after - 1] <= gap
        for axis in range(3):
            where[there, k, axis] = numpy.interp(frames[there], own, at[:, axis])
    return where


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--distance", type=float, required=True)
    parser.add_argument("--step", type=float, default=1.0, help="seconds between two frames")
    parser.add_argument("--gap", type=float, default=600.0)
    options = parser.parse_args()

    started = time.perf_counter()
    ids, times, places = read(options.file)
    frames = numpy.arange(min(t[0] for t in times), max(t[-1] for t in times), options.step)
    close, approaches = set(), 0
    block = 256
    for first in range(0, len(frames), block):
        for now in frames_of(times, places, frames[first : first + block], options.gap):
            there = numpy.flatnonzero(~numpy.isnan(now[:, 0]))
            if len(there) < 2:
                close = set()
                continue
            pairs = cKDTree(now[there]).query_pairs(options.distance, output_type="ndarray")
            pairs = set(map(tuple, there[pairs].tolist()))
            approaches += len(pairs - close)
            close = pairs
    print(f"{approaches} approaches in {len(frames)} frames of {len(ids)} ids, {time.perf_counter() - started:.2f} s")


if __name__ == "__main__":
    main()
