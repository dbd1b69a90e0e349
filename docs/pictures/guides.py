"""Shapes, worlds and satellites of the guides, from runs in the plane, and what programs draw."""

import math
import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from drawing import Drawing
from lessons import HEIGHT, WIDTH, key, picture

import kinesphere as ks

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
TURN = math.radians(25)


def shapes_of_cells():
    """For each cell its name, how a world gets the shape (around the origin), and its corners or circles to draw."""
    turned = (math.cos(TURN / 2), 0, 0, math.sin(TURN / 2))

    def rigid(parts):
        return lambda world: world.add_rigid_body(parts, (0, 0, 0), orientation=turned)

    static = lambda shape: lambda world: world.add_static(shape)
    triangle = [(-1.4, -0.9), (1.5, -0.9), (0.2, 1.2)]
    hull = [(-1.3, -0.6), (0.2, -1.0), (1.4, -0.1), (0.7, 0.9), (-0.8, 0.8)]
    chain = [(-2.0, 0.2), (-1.0, -0.5), (0.0, 0.4), (1.0, -0.3), (2.0, 0.3)]
    flat = lambda points: [(*point, 0.0) for point in points]
    return [
        ("ball", lambda world: world.add((0, 0), radii=1.0), ("discs", [(0, 0, 1.0)])),
        (
            "capsule",
            rigid([ks.Capsule((-1, 0, 0), (1, 0, 0), 0.5)]),
            ("capsule", [(-1, 0), (1, 0)], 0.5),
        ),
        (
            "cluster",
            rigid([ks.Ball((-0.8, 0, 0), 0.7), ks.Ball((0.7, 0, 0), 0.45)]),
            ("discs", [(-0.8, 0, 0.7), (0.7, 0, 0.45)]),
        ),
        ("hull", rigid([ks.Hull(flat(hull))]), ("area", hull)),
        ("box", static(ks.Box((-1.2, -0.8), (1.2, 0.8))), ("still", [(-1.2, -0.8), (1.2, -0.8), (1.2, 0.8), (-1.2, 0.8)])),
        ("triangle", static(ks.Triangle(*flat(triangle))), ("still", triangle)),
        ("half-space", static(ks.HalfSpace((0, 1), 0.0)), ("still", [(-2, -1), (2, -1), (2, 0), (-2, 0)])),
        ("mesh", static(ks.Mesh.chain(chain)), ("chain", chain)),
    ]  # fmt: skip


def shapes():
    """Each shape with a ball that meets it: where, and in which direction."""
    drawing = Drawing(
        WIDTH,
        HEIGHT,
        "Shapes, and a ball that meets each",
        "A ball, a capsule, a cluster of balls and a hull, which turn; a box, a triangle, a half-space and a mesh, which do "
        "not. A ball meets each, with the point and the normal of the event.",
    )
    scale, radius = 34.0, 0.3
    for k, (name, add, form) in enumerate(shapes_of_cells()):
        # A plane has no triangles, only chains of their sides.
        dimensions = 3 if name == "triangle" else 2
        world = ks.World(dimensions=dimensions)
        shape = add(world)
        start, speed = np.array([-1.7, 2.6, 0.0]), np.array([0.7, -1.0, 0.0])
        ball = world.add(start[:dimensions], speed[:dimensions], radii=radius)

        def probe(ids, time):
            own = np.array([body == ball for body in ids])[:, None]
            return np.where(own, start + speed * time, 0.0), np.where(own, speed, 0.0)

        contact = next(
            event for event in world.events(6.0, probe) if event.kind == ks.EventKind.contact_begin
        )
        place = start + speed * contact.time
        assert shape in (contact.first, contact.second)
        x0, y0 = 80.0 + 160.0 * (k % 4), 102.0 + 180.0 * (k // 4)
        at = lambda point: (x0 + scale * point[0], y0 - scale * point[1])
        turn = lambda point: (
            point[0] * math.cos(TURN) - point[1] * math.sin(TURN),
            point[0] * math.sin(TURN) + point[1] * math.cos(TURN),
        )
        kind, data = form[:2]
        if kind == "discs":
            for px, py, size in data:
                drawing.circle(*at(turn((px, py))), scale * size, "body-area", opacity="0.6")
        elif kind == "capsule":
            ends = [at(turn(point)) for point in data]
            drawing.capsule(*ends, scale * form[2], "body-area", opacity="0.6")
        elif kind == "area":
            drawing.area([at(turn(point)) for point in data], "body-area", opacity="0.6")
        elif kind == "still":
            drawing.area([at(point) for point in data], "quiet-area", opacity="0.6")
        else:
            drawing.curve([at(point) for point in data], "quiet-line", style="stroke-width:3")
        drawing.line(*at(start), *at(place), "probe-line", style="stroke-width:1.2")
        drawing.circle(*at(place), scale * radius, "probe-line")
        point, normal = contact.point[:2], contact.normal[:2]
        if np.dot(normal, place[:2] - point) < 0:
            normal = -normal
        drawing.arrow(*at(point), *at(point + 1.1 * normal), "contact")
        drawing.circle(*at(point), 5, "contact-area")
        drawing.text(x0, y0 + 74, name, "ink", "middle")
    return drawing


def worlds():
    """Balls among walls, with a zone that sees them and a lift that moves: ways and events."""
    box = ((0, 0), (20, 11))
    random = np.random.default_rng(8)
    starts = ks.place_spheres(np.full(14, 0.9), box, dimensions=2, seed=8)
    motion = ks.Ballistic(starts, random.normal(size=starts.shape) * 3)
    world = ks.World(dimensions=2, box=box)
    world.add_motion(motion, radii=0.45)
    zone = ((12.5, 0.0), (15.5, 11.0))
    world.add_zone(ks.Box(*zone))
    ways, events = [[place[:2]] for place in np.asarray(motion.states(0.0)[0])], ks.Events()
    for step in range(1, 41):
        events = events + world.run(0.05 * step, motion, ks.Bouncing())
        for way, place in zip(ways, np.asarray(motion.states(world.time)[0])):
            way.append(place[:2])
    drawing = picture(
        "Two seconds of a world",
        "Ways of balls in a box, with contacts of two, contacts with walls, and where balls entered and left a zone.",
    )
    x, y = lambda place: 30.0 + 22.0 * place, lambda place: 330.0 - 25.0 * place
    drawing.rect(
        x(zone[0][0]), y(11), x(zone[1][0]) - x(zone[0][0]), y(0) - y(11), "open-area", opacity="0.15"
    )
    drawing.rect(x(0), y(11), x(20) - x(0), y(0) - y(11), "frame-line")
    for way in ways:
        drawing.curve([(x(px), y(py)) for px, py in way], "body-line", style="stroke-width:1.3")
        drawing.circle(x(way[-1][0]), y(way[-1][1]), 10, "body-area", opacity="0.6")
    rows = []
    for kinds, ink, words in (
        ((ks.EventKind.contact_begin,), "contact", "contacts"),
        ((ks.EventKind.wall_begin,), "other", "at walls"),
        ((ks.EventKind.sensor_enter, ks.EventKind.sensor_leave), "open", "zone"),
    ):
        some = events.of_kind(*kinds)
        for event in some:
            place = event.first_position if ink == "open" else event.point
            drawing.circle(x(place[0]), y(place[1]), 5, f"{ink}-area")
        rows.append((ink, f"{len(some)} {words}"))
    key(drawing, rows, 494, 90)
    return drawing


def orbit(radius, inclination, phase):
    """Place at a time (seconds) on a circular orbit around the earth; lengths are km."""
    rate = math.sqrt(398600.4418 / radius**3)

    def place(time):
        angle = rate * time + phase
        return radius * np.stack(
            [
                np.cos(angle),
                np.sin(angle) * math.cos(inclination),
                np.sin(angle) * math.sin(inclination),
            ],
            axis=-1,
        )

    return place


def satellites():
    """The distance of two satellites over a day, and its minima as the search finds them."""
    orbits = [orbit(7000.0, 0.9, 0.0), orbit(7008.0, 1.7, 0.03)]
    day, arc, terms = 86400.0, 600.0, 12
    begins = np.arange(0.0, day, arc)
    nodes = np.cos(np.pi * (np.arange(terms) + 0.5) / terms)
    fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes, terms - 1))
    coefficients = np.concatenate(
        [[(fit @ one(begin + arc * (nodes + 1) / 2)).T for begin in begins] for one in orbits]
    )
    paths = ks.PolynomialPaths(
        np.repeat([0, 1], len(begins)),
        np.tile(begins, 2),
        np.tile(begins + arc, 2),
        coefficients,
        errors=0.001,
    )
    found = paths.approaches(60.0)
    drawing = picture(
        "Two satellites, one day",
        "The distance of two satellites on crossing orbits over a day, and the minima below 60 km, each of which lasts for "
        "seconds.",
    )
    x, y = lambda time: 120.0 + 490.0 * time / day, lambda km: 300.0 - 48.0 * math.log10(max(km, 1.0) / 1.0)
    for km in (1, 10, 100, 1000, 10000):
        drawing.line(x(0), y(km), x(day), y(km), "faint-line")
        drawing.text(112, y(km) + 6, f"{km:,} km", "quiet", "end")
    times = np.linspace(0, day, 1441)
    distances = np.linalg.norm(orbits[0](times) - orbits[1](times), axis=1)
    drawing.curve(
        [(x(time), y(km)) for time, km in zip(times, distances)], "body-line", style="stroke-width:1.2"
    )
    for minimum in found.minima:
        drawing.circle(x(minimum["time"]), y(minimum["distance"]), 5, "contact-area")
    for hour in range(0, 25, 6):
        drawing.text(x(3600 * hour), 326, f"{hour} h", "quiet", "middle")
    closest = found.minima[np.argmin(found.minima["distance"])]
    key(
        drawing,
        [("contact", f"{len(found.minima)} minima within 60 km, the least {closest['distance']:.1f} km")],
        90,
        350,
    )
    return drawing


class Drawn:
    """A picture that something else has drawn."""

    def __init__(self, text):
        self.text = text

    def svg(self):
        return self.text


def tracks():
    """What `kinesphere tracks --plot` draws of the harbour; None where KINESPHERE_PROGRAM does not name the program."""
    program = os.environ.get("KINESPHERE_PROGRAM")
    if not program:
        return None
    with tempfile.TemporaryDirectory() as folder:
        plot = Path(folder) / "tracks.svg"
        harbour = EXAMPLES / "streams" / "harbour.nmea"
        command = [program, "tracks", harbour, "--distance", "0.5NM", "--quiet", "--plot", plot]
        subprocess.run(command, check=True, capture_output=True)
        return Drawn(plot.read_text())


def python():
    """What `events.plot()` draws of a small gas; None without the matplotlib of Debian 12, which the picture is of."""
    try:
        import matplotlib
    except ImportError:
        return None
    if matplotlib.__version__ != "3.6.3":
        return None
    matplotlib.use("svg")
    matplotlib.rcParams |= {"svg.hashsalt": "kinesphere", "svg.fonttype": "none"}
    box = ((0, 0, 0), (30, 30, 30))
    motion = ks.RandomForces(ks.place_spheres(np.full(60, 1.5), box), acceleration_limits=20.0)
    world = ks.World(box=box)
    world.add_motion(motion, radii=1.5)
    events = world.run(5.0, motion, ks.Bouncing())
    figure = events.of_kind(ks.EventKind.contact_begin, ks.EventKind.wall_begin).plot()
    with tempfile.TemporaryDirectory() as folder:
        plot = Path(folder) / "python.svg"
        figure.savefig(plot, metadata={"Date": None})
        return Drawn("".join(line.rstrip() + "\n" for line in plot.read_text().splitlines()))


DRAWINGS = {"shapes": shapes, "worlds": worlds, "satellites": satellites}
