#!/usr/bin/env python3
"""Makes the streams of docs/watch.md: harbour.nmea, sky.json and drones.csv, always the same.

Usage: make_streams.py FOLDER

Each function returns the text of a stream, and the true paths: functions of the time since START by id, in metres
east, north and up.
"""
import json
import math
import random
import sys
from pathlib import Path

START = 1_700_000_000
KNOT, FOOT, MILE = 1852 / 3600, 0.3048, 1852.0
METRES_IN_DEGREE = 111_319.5


class Place:
    """A plane around a latitude and longitude: metres to the east and north, to degrees."""

    def __init__(self, latitude, longitude):
        self.latitude, self.longitude = latitude, longitude

    def degrees(self, east, north):
        latitude = self.latitude + north / METRES_IN_DEGREE
        return latitude, self.longitude + east / (METRES_IN_DEGREE * math.cos(math.radians(latitude)))


def straight(east, north, up, knots, heading, climb=0.0):
    """The path of a track that goes straight on: knots, degrees, metres in a second."""
    angle = math.radians(heading)
    vx, vy = knots * KNOT * math.sin(angle), knots * KNOT * math.cos(angle)
    return lambda t: (east + vx * t, north + vy * t, up + climb * t)


def swinging(east, north, phase):
    """The path of a vessel at anchor."""
    return lambda t: (east + 40 * math.cos(0.002 * t + phase), north + 40 * math.sin(0.002 * t + phase), 0.0)


def circling(east, north, up, turn):
    """The path of a drone on a circle of 40 m, radians in a second."""
    return lambda t: (east + 40 * math.cos(turn * t), north + 40 * math.sin(turn * t), up)


def bits(*fields):
    return "".join(format(value & ((1 << width) - 1), f"0{width}b") for value, width in fields)


def six_bit_text(text, letters):
    codes = (ord(c) - 64 if c >= "@" else ord(c) for c in text.ljust(letters, "@"))
    return "".join(format(code, "06b") for code in codes)


def sentence(payload, time):
    """A sentence of AIS with a tag block that has its time (ITU-R M.1371-5, IEC 61162-1)."""
    fill = -len(payload) % 6
    payload += "0" * fill
    values = (int(payload[k : k + 6], 2) for k in range(0, len(payload), 6))
    armour = "".join(chr(value + 48 if value < 40 else value + 56) for value in values)

    def checked(body):
        check = 0
        for c in body:
            check ^= ord(c)
        return f"{body}*{check:02X}"

    return f"\\{checked(f'c:{START + int(time)}')}\\!{checked(f'AIVDM,1,1,,A,{armour},{fill}')}"


def harbour(rng):
    """Eighteen vessels off the Elbe for half an hour: ten under way, eight at anchor."""
    here = Place(54.0, 8.1)
    names = ["ALBATROS", "BRISE", "CORMORAN", "DELPHIN", "ELBE PILOT", "FALKE", "GERDA", "HALUNDER", "IRIS", "JUIST"]
    # Metres east and north at the start, knots, course.
    under_way = [
        (0, 0, 6, 90),  # ALBATROS, a yacht
        (8_840, 1_320, 14, 254),  # BRISE: passes her ahead
        (2_600, -9_000, 17, 0),  # CORMORAN: crosses behind
        (-5_000, 2_000, 12, 90),
        (-9_000, -4_000, 11, 70),
        (4_000, 6_000, 9, 180),
        (12_000, -5_000, 15, 290),
        (9_000, 7_000, 20, 250),
        (-3_000, -7_000, 8, 20),
        (14_000, 3_000, 13, 270),
    ]
    lines, paths = [], {}
    for k in range(18):
        mmsi = 211_000_001 + k
        at_anchor = k >= 10
        period = 180 if at_anchor else 10
        time = rng.uniform(0, period)
        if not at_anchor:
            static = bits((24, 6), (0, 2), (mmsi, 30), (0, 2)) + six_bit_text(names[k], 20)
            lines.append((time, sentence(static, time)))
        if at_anchor:
            path = swinging(4_000 + 900 * (k % 4), -6_000 - 900 * (k // 4), k)
        else:
            east, north, knots, heading = under_way[k]
            path = straight(east, north, 0, knots, heading)
        paths[str(mmsi)] = path
        while time < 1800:
            x, y, _ = path(time)
            if at_anchor:
                speed, over_ground, status = rng.choice([0, 0, 1]), rng.uniform(0, 360), 1
            else:
                speed, over_ground, status = 10 * knots, heading, 0
            latitude, longitude = here.degrees(x + rng.gauss(0, 3), y + rng.gauss(0, 3))
            report = bits(
                (1, 6), (0, 2), (mmsi, 30), (status, 4), (-128, 8), (round(speed), 10), (1, 1),
                (round(600_000 * longitude), 28), (round(600_000 * latitude), 27), (round(10 * over_ground), 12),
                (511, 9), ((START + int(time)) % 60, 6), (0, 2), (0, 3), (0, 1), (0, 19),
            )  # fmt: skip
            lines.append((time, sentence(report, time)))
            time += period
    return "\n".join(line for _, line in sorted(lines)) + "\n", paths


def sky(rng):
    """Twelve aircraft for five minutes, every four seconds, as readsb writes them."""
    here = Place(50.0, 8.5)
    aircraft = [
        # Miles east and north at the start, knots, course, feet, feet in a minute.
        (-14, 0, 420, 90, 36_000, 0),  # meets the next one after 150 s, head-on
        (21, 1.5, 420, 270, 36_000, 0),
        (-5, -24, 440, 0, 34_000, 0),  # crosses both 2,000 ft below
        (10, -30, 300, 350, 12_000, 1_500),
        (-25, 20, 380, 120, 28_000, -1_000),
    ]
    for _ in range(7):
        aircraft.append(
            (rng.uniform(-40, 40), rng.uniform(30, 90), rng.uniform(250, 460), rng.choice([80, 260, 100]),
             rng.randrange(8, 39) * 1_000, rng.choice([0, 0, 800]))
        )  # fmt: skip
    paths = {
        f"3c{k:04x}": straight(MILE * east, MILE * north, FOOT * feet, knots, heading, FOOT * climb / 60)
        for k, (east, north, knots, heading, feet, climb) in enumerate(aircraft)
    }
    documents = []
    for step in range(75):
        now = 4.0 * step
        states = []
        for k, (address, path) in enumerate(paths.items()):
            seen = round(rng.uniform(0, 1), 1)
            x, y, z = path(now - seen)
            latitude, longitude = here.degrees(x + rng.gauss(0, 5), y + rng.gauss(0, 5))
            _, _, knots, heading, _, climb = aircraft[k]
            states.append(
                {"hex": address, "flight": f"KIN{k + 1:03d}  ", "lat": round(latitude, 6), "lon": round(longitude, 6),
                 "alt_baro": round(z / FOOT / 25) * 25, "gs": round(knots, 1), "track": heading,
                 "baro_rate": climb, "rc": 186, "nac_p": 9, "nac_v": 2, "sil": 3, "category": "A3", "seen_pos": seen}
            )  # fmt: skip
        documents.append(json.dumps({"now": START + now, "aircraft": states}, separators=(",", ":")))
    return "\n".join(documents) + "\n", paths


def drones(rng):
    """Eight drones for a minute, five reports a second; the first two are on courses that cross at one height."""
    paths = {"d1": lambda t: (8 * (t - 30), 0, 40), "d2": lambda t: (3, 8 * (t - 30), 40.5)}
    for k in range(2, 8):
        paths[f"d{k + 1}"] = circling(150 * k, 100, 30 + 5 * k, 0.1 + 0.01 * k)
    lines = ["id,time,x,y,z,vx,vy,vz"]
    for step in range(300):
        for k, (drone, path) in enumerate(paths.items()):
            time = 0.2 * step + 0.02 * k
            position = path(time)
            velocity = [(b - a) / 0.02 for a, b in zip(path(time - 0.01), path(time + 0.01))]
            numbers = [value + rng.gauss(0, 0.5) for value in position]
            numbers += [value + rng.gauss(0, 0.05) for value in velocity]
            lines.append(f"{drone},{time:.2f}," + ",".join(f"{number:.2f}" for number in numbers))
    return "\n".join(lines) + "\n", paths


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for name, make in (("harbour.nmea", harbour), ("sky.json", sky), ("drones.csv", drones)):
        (folder / name).write_text(make(random.Random(1))[0])
