"""Games and simulations of examples/, each as its program ran: the programs write the bodies of their worlds to a file
(drawn_world.cpp), and where these came from."""

import math
import os
import subprocess
import tempfile
from pathlib import Path

from drawing import Drawing, Sheet, number

ACROSS, CELL, MARGIN, HEAD = 2, 300.0, 14.0, 30.0
# For each program its title, the time at which it is drawn (None: the end), how many of its last places a trail has, and
# what is shown of the space: x from, to, y from, to (None: all).
GAMES = {
    "breakout": ("Breakout", "16", 60, (0, 20, -3, 30)),
    "pinball": ("Pinball", "40", 150, (0, 20, -2, 40)),
    "asteroids": ("Asteroids", "10", 40, None),
    "billiards": ("Billiards: the break", "2.5", 400, (-0.06, 2.6, -0.06, 1.33)),
    "marble_run": ("Marble run", "9", 45, (0, 12, 0, 22)),
    "plinko": ("Plinko", "20", 30, (-7, 7, 0, 14)),
    "horde": ("Horde", "6", 20, None),
    "lander": ("Lander, with its way", None, 10_000, (0, 100, 0, 50)),
    "dodge": ("Dodge", "30", 20, (0, 30, 0, 26)),
    "curling": ("Curling: the last end", None, 10_000, (-2.4, 2.4, 30, 40)),
}
# For each program its title, the slice that is drawn, z from, to, as parts of the space (None: all), whether it is seen from
# the side, x and z, what is shown (None: the space), and how many balls a bond joins.
SIMULATIONS = {
    "hard_spheres": ("Hard spheres, a slice", (0.4, 0.5), False, None, 1),
    "hard_discs": ("Hard discs, half filled", None, False, None, 1),
    "atmosphere": ("An atmosphere", None, True, (0, 6, 0, 6), 1),
    "haff_cooling": ("A granular gas that has cooled", (0.4, 0.55), False, None, 1),
    "rough_grains": ("Rough grains, a slice", (0.4, 0.5), False, None, 1),
    "square_well": ("A fluid that attracts itself", (0.4, 0.5), False, None, 1),
    "polymer": ("A chain of 16", None, False, (), 16),
    "packing": ("A jammed packing, a slice", (0.45, 0.53), False, None, 1),
    "dumbbells": ("Dumbbells", None, False, None, 2),
    "piston": ("A gas under a piston", None, True, None, 1),
}


def path_of(name):
    """The program of an example, beside that of KINESPHERE_PROGRAM."""
    return Path(os.environ.get("KINESPHERE_PROGRAM", "/none")).parent.parent / "examples" / f"example_{name}"


def draw():
    """Ten games and ten simulations; None where not all of them are built."""
    if not all(path_of(name).exists() for name in [*GAMES, *SIMULATIONS]):
        return None
    return Sheet({"games": games(), "simulations": simulations()})


def run(name, at=None):
    """Returns the lines that a program writes: kind, user data, numbers."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "drawn"
        environment = (
            os.environ | {"KINESPHERE_DRAWN": str(file)} | ({"KINESPHERE_DRAWN_AT": at} if at else {})
        )
        subprocess.run([path_of(name)], env=environment, check=True, capture_output=True)
        lines = [line.split() for line in file.read_text().splitlines()]
    return [(kind, int(user_data), [float(each) for each in numbers]) for kind, user_data, *numbers in lines]


class Cell:
    """A part of a picture with a scale of its own."""

    def __init__(self, drawing, place, title, bounds):
        left, top = (
            place % ACROSS * (CELL + MARGIN) + MARGIN,
            place // ACROSS * (CELL + HEAD + MARGIN) + MARGIN,
        )
        self.drawing, (self.x0, self.x1, self.y0, self.y1) = drawing, bounds
        self.scale = CELL / max(self.x1 - self.x0, self.y1 - self.y0)
        self.width, self.height = self.scale * (self.x1 - self.x0), self.scale * (self.y1 - self.y0)
        self.left, self.top = left + (CELL - self.width) / 2, top + HEAD + (CELL - self.height) / 2
        drawing.text(left, top + 20, title, "ink small")
        drawing.rect(self.left, self.top, self.width, self.height, "frame-line")

    def at(self, x, y):
        return self.left + self.scale * (x - self.x0), self.top + self.scale * (self.y1 - y)

    def shows(self, x, y):
        return self.x0 <= x <= self.x1 and self.y0 <= y <= self.y1

    def box(self, x0, y0, x1, y1, class_):
        x0, x1 = max(x0, self.x0), min(x1, self.x1)
        y0, y1 = max(y0, self.y0), min(y1, self.y1)
        if x0 < x1 and y0 < y1:
            self.drawing.rect(*self.at(x0, y1), self.scale * (x1 - x0), self.scale * (y1 - y0), class_)

    def discs(self, discs, ink):
        """Discs with an edge, the later ones above the earlier; what is outside of the cell is cut off."""
        circles = []
        for x, y, radius in discs:
            if self.shows(x, y):
                u, v = self.at(x, y)
                circles.append(
                    f'<circle cx="{number(u)}" cy="{number(v)}" r="{number(self.scale * radius)}"/>'
                )
        frame = [number(each) for each in (self.left, self.top, self.width, self.height)]
        sides = dict(zip(("x", "y", "width", "height"), frame), viewBox=" ".join(frame))
        self.drawing.add("svg", "".join(circles), class_=f"paper-line {ink}-area", **sides)

    def trail(self, places):
        """A line through places, but where it leaps to the other side of a space that repeats, or leaves the picture."""
        way, leap = [], 0.4 * max(self.x1 - self.x0, self.y1 - self.y0)
        for place in [*places, None]:
            if place is None or not self.shows(*place) or (way and math.dist(way[-1], place) > leap):
                if len(way) > 1:
                    self.drawing.curve(thinned([self.at(*each) for each in way]), "probe-line")
                way = []
            if place is not None and self.shows(*place):
                way.append(place)


def thinned(points):
    """The points that a line needs to pass all others within 0.3 (Douglas and Peucker, 1973)."""
    (x0, y0), (x1, y1) = points[0], points[-1]
    length = math.dist(points[0], points[-1])

    def off(x, y):
        if length < 1e-9:
            return math.dist((x, y), points[0])
        return abs((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / length

    k = max(range(len(points)), key=lambda k: off(*points[k]))
    return (
        [points[0], points[-1]]
        if off(*points[k]) <= 0.3
        else thinned(points[: k + 1])[:-1] + thinned(points[k:])
    )


def bounds_of(lines):
    spaces = [numbers for kind, _, numbers in lines if kind == "space"]
    if spaces:
        (x0, y0, _, x1, y1, _), *_ = spaces
        return x0, x1, y0, y1
    balls = [numbers for kind, _, numbers in lines if kind == "ball"]
    x, y = [ball[0] for ball in balls], [ball[1] for ball in balls]
    return min(x) - 1, max(x) + 1, min(y) - 1, max(y) + 1


def sheet(programs, title, about):
    rows = -(-len(programs) // ACROSS)
    width, height = ACROSS * (CELL + MARGIN) + MARGIN, rows * (CELL + HEAD + MARGIN) + MARGIN
    return Drawing(
        int(width), int(height), title, f"{about}: {', '.join(each[0] for each in programs.values())}."
    )


def games():
    drawing = sheet(GAMES, "Ten games", "Bodies of ten games, and where they came from")
    for place, (name, (title, at, last, bounds)) in enumerate(GAMES.items()):
        lines = run(name, at)
        cell = Cell(drawing, place, title, bounds or bounds_of(lines))
        for kind, _, numbers in lines:
            if kind == "trail":
                cell.trail(list(zip(numbers[::3], numbers[1::3]))[-last:])
            elif kind.endswith("box"):
                class_ = {"zone_box": "faint-area", "static_box": "other-area", "box": "sure-area"}[kind]
                cell.box(numbers[0], numbers[1], numbers[3], numbers[4], class_)
            elif kind == "static_line":
                drawing.line(*cell.at(*numbers[:2]), *cell.at(*numbers[3:5]), "ink-line")
        for kind, class_ in {"zone_ball": "frame", "static_ball": "other"}.items():
            cell.discs([(x, y, r) for each, _, (x, y, _, r) in balls_of(lines) if each == kind], class_)
        for user_data in sorted({each for kind, each, _ in lines if kind == "ball"}):
            discs = [
                (x, y, r)
                for kind, each, (x, y, _, r) in balls_of(lines)
                if (kind, each) == ("ball", user_data)
            ]
            cell.discs(discs, ("body", "contact", "sure", "open")[user_data % 4])
    return drawing


def turned(numbers):
    """Places with y and z exchanged."""
    return (
        [numbers[0], numbers[2], numbers[1], numbers[3]]
        if len(numbers) == 4
        else [numbers[k] for k in (0, 2, 1, 3, 5, 4)]
    )


def balls_of(lines):
    return [(kind, user_data, numbers) for kind, user_data, numbers in lines if kind.endswith("ball")]


def simulations():
    drawing = sheet(
        SIMULATIONS, "Ten simulations", "Bodies of ten simulations as they ended, whole or a slice"
    )
    for place, (name, (title, part, from_side, bounds, bonded)) in enumerate(SIMULATIONS.items()):
        lines = run(name)
        if from_side:
            lines = [(kind, of, turned(numbers)) for kind, of, numbers in lines if kind in ("space", "ball")]
        balls = [numbers for kind, _, numbers in lines if kind == "ball"]
        if bounds == ():
            lines = [line for line in lines if line[0] != "space"]
        cell = Cell(drawing, place, title, bounds or bounds_of(lines))
        for k in range(0, len(balls) * (bonded > 1), bonded):
            drawing.curve([cell.at(*ball[:2]) for ball in balls[k : k + bonded]], "ink-line")
        if part is not None:
            (*_, low, _, _, high), *_ = [numbers for kind, _, numbers in lines if kind == "space"]
            low, high = low + part[0] * (high - low), low + part[1] * (high - low)
            balls = [ball for ball in balls if low <= ball[2] <= high]
        cell.discs([(x, y, r) for x, y, _, r in sorted(balls, key=lambda ball: ball[2])], "body")
    return drawing
