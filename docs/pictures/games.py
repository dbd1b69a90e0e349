"""The games of docs/games.md, from recordings of their examples (recorded_game.cpp): what is there at a moment, and the
ways that led to it."""

import math
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from drawing import Drawing, Sheet
from lessons import BEGINS, HEIGHT, WIDTH

import kinesphere as ks

TOP, LEFT = 50.0, 20.0


@dataclass
class View:
    """What of a game is drawn: from `begin` to `end`, in a window of its plane."""

    about: str
    begin: float
    end: float
    window: tuple[float, float, float, float]
    """left, bottom, right, top"""
    lies: bool = False
    """True if the game lies on its side in the picture."""


VIEWS = {
    "asteroids": View(
        "A ship shoots at rocks, which burst into two, in space that repeats.", 4.0, 7.0, (0, 0, 100, 100)
    ),
    "billiards": View(
        "A break, and the ways of all balls for nine seconds.", 0.0, 9.0, (-0.1, -0.1, 2.64, 1.37)
    ),
    "breakout": View(
        "The ball has passed the bricks and comes back to the paddle.", 8.0, 16.0, (0, -5, 20, 30), True
    ),
    "curling": View("Stones slide to the house, and push others on.", 0.0, 166.0, (-2.4, 31, 2.4, 40), True),
    "dodge": View("A runner between boulders that fall.", 10.0, 13.0, (0, 0, 25, 14)),
    "horde": View("Hundreds of walkers press towards the hero, who shoots.", 5.6, 6.0, (0, 0, 60, 60)),
    "lander": View("The way of a ship down to its pad.", 0.0, 20.0, (0, 0, 100, 44)),
    "marble_run": View("The ways of eight marbles down five ramps.", 0.0, 14.0, (0, 0, 12, 22), True),
    "pinball": View("The way of a ball between bumpers, targets and walls.", 0.0, 6.0, (0, -4, 20, 40), True),
    "plinko": View("Balls fall through a board of pegs.", 7.2, 8.0, (-7, -1, 7, 14)),
}


def recordings():
    """The recording of each game, or nothing where the examples have not been built."""
    program = os.environ.get("KINESPHERE_PROGRAM")
    folder = Path(program).resolve().parents[1] / "examples" if program else None
    if folder is None or not all((folder / f"recorded_{game}").exists() for game in VIEWS):
        return None
    with tempfile.TemporaryDirectory() as made:
        file = Path(made) / "recording"
        runs = {}
        for game in VIEWS:
            environment = {**os.environ, "KINESPHERE_RECORDING": str(file)}
            subprocess.run(
                [folder / f"recorded_{game}"], env=environment, check=True, stdout=subprocess.DEVNULL
            )
            runs[game] = file.read_bytes()
        return runs


def play(recording, view):
    """The world at the end of the view; the ways of bodies since its begin, lists of places by id, and the events."""
    replay = ks.Replay(recording)
    ways, events, seen = {}, [], -1.0
    while not replay.finished:
        event = replay.advance()
        world = replay.world()
        if event is not None and event.time >= view.begin:
            events.append(event)
        if world.time >= view.begin and world.time > seen:
            seen = world.time
            moving = [
                body for body in world.bodies() if not (one := world.body(body)).is_static and one.enabled
            ]
            for body, place in zip(moving, world.bounds(moving)[0], strict=True):
                ways.setdefault(int(body), []).append((place[0], place[1]))
        if world.time >= view.end:
            break
    return world, ways, events


class Plane:
    """Places of a game in the picture."""

    def __init__(self, view):
        left, bottom, right, top = view.window
        across, along = (top - bottom, right - left) if view.lies else (right - left, top - bottom)
        self.scale = min((WIDTH - 2 * LEFT) / across, (HEIGHT - TOP - 15) / along)
        self.left = (WIDTH - across * self.scale) / 2
        self.view, self.width, self.height = view, across * self.scale, along * self.scale

    def at(self, place):
        left, bottom, right, top = self.view.window
        if self.view.lies:
            return self.left + (place[1] - bottom) * self.scale, TOP + (place[0] - left) * self.scale
        return self.left + (place[0] - left) * self.scale, TOP + (top - place[1]) * self.scale

    def shows(self, place):
        left, bottom, right, top = self.view.window
        return left <= place[0] <= right and bottom <= place[1] <= top

    def corners(self, lower, upper):
        """The corner at the left and top, and the size, of a box that is cut at the window."""
        cut = lambda place: [min(max(place[k], self.view.window[k]), self.view.window[k + 2]) for k in (0, 1)]
        (x1, y1), (x2, y2) = self.at(cut(lower)), self.at(cut(upper))
        return min(x1, x2), min(y1, y2), abs(x2 - x1), abs(y2 - y1)


def thinned(way, gap):
    """The places of a way that are so far from each other, and its last one."""
    kept = way[:1]
    for place in way[1:-1]:
        if math.dist(place, kept[-1]) > gap:
            kept.append(place)
    return [*kept, way[-1]]


def pieces_of(way, plane):
    """The pieces of a way that lie in the window. Where space repeats, a body goes on at the other side."""
    pieces, last = [], None
    for place in way:
        if not plane.shows(place):
            last = None
            continue
        if last is None or math.dist(place, last) > 0.3 * plane.width / plane.scale:
            pieces.append([])
        pieces[-1].append(place)
        last = place
    return [thinned(piece, 2.5 / plane.scale) for piece in pieces if len(piece) > 1]


def draw_shape(drawing, plane, shape, ink, place=(0.0, 0.0)):
    moved = lambda point: (point[0] + place[0], point[1] + place[1])
    if isinstance(shape, ks.Ball):
        drawing.circle(*plane.at(shape.centre), max(shape.radius * plane.scale, 1.5), f"{ink}-area")
    elif isinstance(shape, ks.Box):
        drawing.rect(*plane.corners(moved(shape.lower), moved(shape.upper)), f"{ink}-area")
    elif isinstance(shape, ks.HalfSpace):
        left, _, right, _ = plane.view.window
        drawing.line(*plane.at((left, shape.offset)), *plane.at((right, shape.offset)), f"{ink}-line")
    else:
        for first, second, _ in shape.corners:
            drawing.line(*plane.at(shape.vertices[first]), *plane.at(shape.vertices[second]), f"{ink}-line")


def draw(name, recording):
    view = VIEWS[name]
    world, ways, events = play(recording, view)
    plane = Plane(view)
    title = name.replace("_", " ").capitalize()
    drawing = Drawing(WIDTH, HEIGHT, title, view.about)
    drawing.text(LEFT, 34, title, "ink bold")
    drawing.text(
        WIDTH - LEFT, 34, f"{'up is right, ' if view.lies else ''}{world.time:.1f} s", "quiet", "end"
    )
    drawing.rect(plane.left, TOP, plane.width, plane.height, "frame-line")
    bodies = [(body, world.body(body)) for body in world.bodies()]
    for solid, ink in ((False, "faint"), (True, "quiet")):
        for body, one in bodies:
            if one.is_static and one.solid == solid:
                draw_shape(drawing, plane, world.shape_of(body), ink)
    for way in ways.values():
        for piece in pieces_of(way, plane):
            drawing.curve([plane.at(place) for place in piece], "body-line", opacity="0.4")
    contacts = [
        plane.at(event.point) for event in events if event.kind in BEGINS and plane.shows(event.point)
    ]
    # Of contacts at one place, one is drawn.
    drawing.dots({(round(x / 3), round(y / 3)): (x, y) for x, y in contacts}.values(), 2.5, "contact")
    balls = {}
    for body, one in bodies:
        place = world.bounds([body])[0][0]
        if one.is_static or not one.enabled or not plane.shows(place):
            continue
        if isinstance(shape := world.shape_of(body), ks.Ball):
            balls.setdefault(max(one.radius * plane.scale, 2.0), []).append(plane.at(place))
        else:
            draw_shape(drawing, plane, shape, "body", place)
    for radius, places in balls.items():
        drawing.dots(places, radius, "body")
    return drawing


def sheet():
    """All games in one file; nothing where their examples have not been built."""
    runs = recordings()
    return runs and Sheet({name: draw(name, recording) for name, recording in runs.items()})
