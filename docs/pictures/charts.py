"""What finding contacts costs, and what fixed steps miss: from the tables of `kinesphere-bench speed`."""

import csv
import math
from pathlib import Path

from drawing import Drawing

RESULTS = Path(__file__).resolve().parents[2] / "research" / "results"
HEIGHT = 492
SCENES = ["paper1-500", "paper1-1000", "paper1-3500", "dense-10000", "drones", "crowd", "bullets", "sizes"]


def rows():
    """Returns the rows of the newest machine's table, by scene."""
    (table,) = RESULTS.glob("*/speed.csv")
    by_scene = {}
    with table.open() as file:
        for row in csv.DictReader(file):
            by_scene.setdefault(row["scene"], []).append(row)
    return by_scene


def logarithmic(picture, low, high, left, right, top, bottom, unit):
    """Draws a scale of powers of ten; returns where a value is."""
    x = lambda value: left + (right - left) * math.log10(value / low) / math.log10(high / low)
    value = low
    while value <= high * 1.001:
        picture.line(x(value), top, x(value), bottom, "frame-line")
        label = f"{value:g}{unit}" if value < 1000 else f"{value:,.0f}{unit}"
        picture.text(x(value), bottom + 24, label, "quiet", "middle")
        value *= 10
    return x


def mark(picture, number, x, y, class_):
    """Draws the mark of a curve: a disc, a square, a triangle or a diamond."""
    if number == 0:
        picture.circle(x, y, 5, class_)
    else:
        shapes = [
            [(-5, -5), (5, -5), (5, 5), (-5, 5)],
            [(0, -7), (6, 5), (-6, 5)],
            [(0, -7), (7, 0), (0, 7), (-7, 0)],
        ]
        picture.area([(x + dx, y + dy) for dx, dy in shapes[number - 1]], class_)


def draw_costs():
    """For each scene the world, and the slowest continuous steps that miss nothing."""
    left, right, step = 180.0, 590.0, 44.0
    bottom = 70.0 + step * len(SCENES)
    picture = Drawing(
        640,
        HEIGHT,
        "Cost of finding every contact",
        "For eight scenes the microseconds for a sphere and a second, with a microsecond for each move: of the "
        "world, and of the slowest continuous steps that miss nothing. The world takes 1.5 to 100 times less.",
    )
    x = logarithmic(picture, 0.1, 1000, left, right, 50.0, bottom, "")
    picture.text(left, 30, "world", "body")
    picture.text(left + 80, 30, "longest steps that miss nothing", "probe")
    picture.text(right + 30, bottom + 54, "microseconds for a sphere and a second", "quiet", "end")
    table = rows()
    for k, scene in enumerate(SCENES):
        y = 50.0 + step * (k + 0.5)
        world = next(row for row in table[scene] if row["detector"] == "world")
        safe = min(
            (row for row in table[scene] if row["detector"] == "swept" and row["missed_percent"] == "0"),
            key=lambda row: float(row["rate"]),
        )
        picture.text(left - 12, y + 6, scene, "ink", "end")
        for row, ink, offset in ((world, "body", -9.0), (safe, "probe", 5.0)):
            picture.rect(left, y + offset, x(float(row["total_1us"])) - left, 12.0, f"{ink}-area")
    return picture


def draw_build():
    """For each thing that is built the seconds of processor, when each target was one source and now."""
    left, right, step, largest = 190.0, 560.0, 120.0, 300.0
    with (RESULTS / "build_times.csv").open() as file:
        table = {(row["when"], row["what"]): row for row in csv.DictReader(file)}
    things = {"first": "first command", "library": "library alone", "python": "Python package"}
    bottom = 60.0 + step * len(things)
    before, now = (
        [float(table[when, what]["processor_seconds"]) for what in things] for when in ("before", "now")
    )
    picture = Drawing(
        640,
        HEIGHT,
        "Time to build",
        "Seconds of processor, when each target was one source and now: "
        + ", ".join(f"{label} {b:.0f} and {n:.0f}" for label, b, n in zip(things.values(), before, now))
        + ".",
    )
    picture.text(left, 30, "one source for each target", "probe")
    picture.text(left + 300, 30, "now", "body")
    for k, label in enumerate(things.values()):
        y = 60.0 + step * (k + 0.5)
        picture.text(left - 12, y + 6, label, "ink", "end")
        for seconds, ink, offset in ((before[k], "probe", -18.0), (now[k], "body", 2.0)):
            width = (right - left) * seconds / largest
            picture.rect(left, y + offset, width, 16.0, f"{ink}-area")
            picture.text(left + width + 8, y + offset + 15, f"{seconds:.0f}", "quiet")
    picture.text(right + 30, bottom + 34, "seconds of processor", "quiet", "end")
    return picture


def draw_misses():
    """For some scenes the contacts that overlaps at fixed steps miss, over the rate of the steps."""
    scenes = {"drones": "body", "crowd": "sure", "paper1-3500": "contact", "bullets": "probe"}
    left, right, top, bottom = 100.0, 590.0, 60.0, 400.0
    picture = Drawing(
        640,
        HEIGHT,
        "What fixed steps miss",
        "For four scenes the share of contacts that are missed by tests for overlap at fixed steps, over the "
        "steps in a second. Drones at one step a second miss 35 %, bullets at 60 Hz 30 %, drones and a crowd at "
        "15 Hz still 0.3 %; the world misses none.",
    )
    x = logarithmic(picture, 1, 1000, left, right, top, bottom, " Hz")
    # None is drawn where a thousandth of a percent would be.
    y = lambda percent: bottom - (bottom - top) * (math.log10(max(percent, 0.001)) + 3.0) / 5.0
    for percent, label in (
        (0, "none"),
        (0.01, "0.01 %"),
        (0.1, "0.1 %"),
        (1, "1 %"),
        (10, "10 %"),
        (100, "100 %"),
    ):
        picture.line(left, y(percent), right, y(percent), "frame-line")
        picture.text(left - 10, y(percent) + 6, label, "quiet", "end")
    table = rows()
    at = left
    for number, (scene, ink) in enumerate(scenes.items()):
        seen = sorted(
            (float(row["rate"]), float(row["missed_percent"]))
            for row in table[scene]
            if row["detector"] == "tuned" and row["missed_percent"] and float(row["rate"]) <= 1000
        )
        pairs = [(x(rate), y(percent)) for rate, percent in seen]
        picture.curve(pairs, f"{ink}-line")
        # Told apart by more than the colour.
        for place in [(at + 5.0, 24.0), *pairs]:
            mark(picture, number, *place, f"{ink}-area")
        picture.text(at + 18.0, 30, scene, ink)
        at += 40.0 + 12.0 * len(scene)
    picture.text(right + 30, bottom + 54, "steps in a second", "quiet", "end")
    return picture


def draw_ratios():
    """For each scene what rivals take where the world takes 1."""
    scenes = [
        "paper1-500",
        "paper1-1000",
        "paper1-2000",
        "paper1-3500",
        "dense-1000",
        "dense-10000",
        "paper2",
    ]
    scenes += ["drones", "crowd", "bullets", "sizes"]
    left, right, step = 150.0, 600.0, 31.0
    bottom = 84.0 + step * len(scenes)
    picture = Drawing(
        640,
        HEIGHT,
        "What others take, where the world takes 1",
        "For eleven scenes the times of our fixed steps at 60 Hz, of Bullet's broad phase at 60 Hz, and of the slowest swept "
        "steps that miss nothing, as multiples of the time of the world. The first two are mostly below 1, and miss contacts.",
    )
    x = logarithmic(picture, 0.01, 100, left, right, 70.0, bottom, "")
    picture.line(x(1), 70, x(1), bottom, "ink-line")
    rows_of = rows()
    kinds = [
        ("quiet", 1, "tuned, 60 Hz", lambda row: row["detector"] == "tuned" and row["rate"] == "60"),
        (
            "other",
            2,
            "bullet-best, 60 Hz",
            lambda row: row["detector"] == "bullet-best" and row["rate"] == "60",
        ),
        (
            "probe",
            0,
            "swept, none missed",
            lambda row: row["detector"] == "swept" and row["missed_percent"] == "0",
        ),
    ]
    for k, (ink, shape, words, _) in enumerate(kinds):
        place = 30.0 + 200.0 * k
        mark(picture, shape, place, 34.0, f"{ink}-area")
        picture.text(place + 14, 40, words, "ink small")
    for k, scene in enumerate(scenes):
        y = 84.0 + step * (k + 0.5) - 8.0
        picture.text(left - 12, y + 6, scene, "ink small", "end")
        for ink, shape, _, fits in kinds:
            some = [row for row in rows_of[scene] if fits(row)]
            if some:
                row = min(some, key=lambda one: float(one["rate"]))
                mark(picture, shape, x(float(row["to_world"])), y, f"{ink}-area")
    picture.text(right + 20, bottom + 50, "time, world = 1", "quiet", "end")
    return picture


# Milliseconds of a frame of `kinesphere-bench frames` on an Intel Xeon: median, 99 %, worst.
FRAMES = {
    ("thin", 1000): (0.0118, 0.0727, 0.222),
    ("thin", 10000): (0.144, 0.371, 1.73),
    ("thin", 50000): (1.12, 2.78, 14.9),
    ("steady", 1000): (0.0364, 0.0921, 0.155),
    ("steady", 10000): (0.471, 0.726, 1.15),
    ("steady", 50000): (4.62, 6.27, 14.3),
    ("dense", 1000): (0.0962, 0.232, 0.27),
    ("dense", 10000): (1.31, 1.97, 2.98),
    ("dense", 50000): (11.1, 13.8, 32.8),
    ("eventful", 1000): (0.517, 0.723, 0.821),
    ("eventful", 10000): (2.79, 3.7, 4.61),
    ("eventful", 50000): (10.5, 17.9, 30.2),
}


def draw_frames():
    """For each game how long frames take: from the median to the worst."""
    left, right, step = 190.0, 600.0, 28.0
    bottom = 84.0 + step * len(FRAMES)
    picture = Drawing(
        640,
        HEIGHT,
        "How long frames take",
        "For four games of 1,000, 10,000 and 50,000 bodies the median of the times of frames, the 99th percentile and the "
        "worst, in milliseconds. A frame at 60 Hz has 16.7.",
    )
    x = logarithmic(picture, 0.01, 100, left, right, 70.0, bottom, "")
    picture.line(x(1000 / 60), 62, x(1000 / 60), bottom, "open-line", stroke_dasharray="6 5")
    picture.text(x(1000 / 60), 54, "60 Hz", "open small", "middle")
    marks = [("body", 0, "median"), ("other", 1, "99 %"), ("contact", 3, "worst")]
    for k, (ink, shape, words) in enumerate(marks):
        mark(picture, shape, 30.0 + 130.0 * k, 34.0, f"{ink}-area")
        picture.text(44.0 + 130.0 * k, 40, words, "ink small")
    for k, ((game, bodies), times) in enumerate(FRAMES.items()):
        y = 84.0 + step * (k + 0.5) - 6.0
        picture.text(left - 12, y + 6, f"{game}, {bodies:,}", "ink small", "end")
        picture.line(x(times[0]), y, x(times[2]), y, "frame-line")
        for (ink, shape, _), time in zip(marks, times):
            mark(picture, shape, x(time), y, f"{ink}-area")
    picture.text(right + 20, bottom + 50, "milliseconds", "quiet", "end")
    return picture
