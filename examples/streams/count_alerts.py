#!/usr/bin/env python3
"""Counts the alerts of `kinesphere watch` on the streams of this folder, by default, against the true paths.

Usage: count_alerts.py PROGRAM

Prints the table of docs/watch.md. Fails if a pair that truly came within the separation has no alert, or an encounter
has more than three.
"""
import itertools
import json
import math
import random
import subprocess
import sys
from collections import Counter
from pathlib import Path

import make_streams

FOLDER = Path(__file__).parent
MILE, FOOT = make_streams.MILE, make_streams.FOOT
# Stream, its function, options, horizontal and vertical separation in metres (None: a sphere), seconds.
STREAMS = [
    ("harbour.nmea", make_streams.harbour, "--separation sphere:0.5NM", 0.5 * MILE, None, 1800),
    ("sky.json", make_streams.sky, "--separation cylinder:5NM:1000ft", 5 * MILE, 1000 * FOOT, 300),
    ("drones.csv", make_streams.drones,
     "--separation sphere:15 --acceleration 5 --position-error 2 --velocity-error 0.3", 15.0, None, 60),
]  # fmt: skip


def within(one, other, horizontal, vertical):
    if vertical is None:
        return math.dist(one, other) <= horizontal
    return math.dist(one[:2], other[:2]) <= horizontal and abs(one[2] - other[2]) <= vertical


def alerts_of(program, name, options):
    command = [program, "watch", str(FOLDER / name), "--quiet", *options.split()]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [json.loads(line) for line in lines]


def main():
    program = sys.argv[1]
    print("| stream | options | alerts | pairs with alerts | pairs truly within | of these without an alert |")
    print("|---|---|---|---|---|---|")
    for name, make, options, horizontal, vertical, seconds in STREAMS:
        _, paths = make(random.Random(1))
        places = {id: [path(0.5 * k) for k in range(2 * seconds)] for id, path in paths.items()}
        true = {
            tuple(sorted(pair))
            for pair in itertools.combinations(places, 2)
            if any(within(one, other, horizontal, vertical) for one, other in zip(places[pair[0]], places[pair[1]]))
        }
        alerts = [alert for alert in alerts_of(program, name, options) if "second" in alert]
        told = Counter((alert["first"], alert["second"]) for alert in alerts)
        missed = true - told.keys()
        print(f"| {name} | `{options}` | {len(alerts)} | {len(told)} | {len(true)} | {len(missed)} |")
        assert not missed, f"{name}: {missed}"
        assert max(told.values()) <= 3, f"{name}: {told.most_common(3)}"


main()
