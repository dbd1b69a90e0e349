"""A bound that grows and is reset; and bodies on paths that are functions of time, in a world that does not know them."""

import math

import numpy as np
from drawing import Drawing

from kinesphere import World


class Course:
    """A world in the plane, with bodies on given paths; each path gives place and velocity at a time."""

    def __init__(self, paths, radii, limits, **world):
        self.paths, self.radii = paths, radii
        self.world = World(dimensions=2, **world)
        self.ids = [
            self.world.add(*path(0.0), radii=radius, acceleration_limits=limit)
            for path, radius, limit in zip(paths, radii, limits)
        ]
        self.probes = []  # pairs of a body's index and a time

    def probe(self, ids, time):
        bodies = [self.ids.index(body) for body in ids]
        self.probes += [(body, time) for body in bodies]
        states = [self.paths[body](time) for body in bodies]
        return np.array([place for place, _ in states]), np.array([velocity for _, velocity in states])

    def advance(self, until):
        return [event for event in self.world.events(until, self.probe)]


def still(x, y):
    return lambda time: ([x, y, 0.0], [0.0, 0.0, 0.0])


def weaving(x, speed, height, rate, phase=0.0, y=0.0):
    """Straight on along x, and a sine in y of acceleration height * rate^2 at most."""
    return lambda t: (
        [x + speed * t, y + height * math.sin(rate * t + phase), 0.0],
        [speed, height * rate * math.cos(rate * t + phase), 0.0],
    )


END = 8.0
START, SPEED, RADIUS, LIMIT = -9.0, 2.2, 0.5, 0.92


def run():
    """Returns the course, samples of the first body's bound (time, centre, radius, time of its report), and its probes:
    time, and the body that it came near, or None where it left its safe region."""
    course = Course(
        [
            weaving(START, SPEED, 1.0, 0.95),
            still(-4.2, -2.9),
            still(-0.6, 2.9),
            still(3.0, -2.7),
            still(6.6, 2.8),
        ],
        [RADIUS, 0.7, 0.7, 0.7, 0.7],
        [LIMIT, 0.0, 0.0, 0.0, 0.0],
    )
    course.world.set_profiling(True)
    samples = []
    for time in np.linspace(0.0, END, 321):
        course.advance(time)
        (centre,), (radius,) = course.world.bounds([course.ids[0]])
        samples.append((time, *centre[:2], radius, course.world.body(course.ids[0]).report_time))
    # Of the bodies that stand still one is near; spot checks ask about several.
    others = {}
    for body, time in course.probes:
        if body != 0:
            others.setdefault(time, []).append(body)
    others = {time: bodies[0] for time, bodies in others.items() if len(bodies) == 1}
    probes = [(time, others.get(time)) for body, time in course.probes if body == 0]
    (busy,) = [busy for busy in course.world.busiest() if busy.body == course.ids[0]]
    assert busy.near == sum(other is not None for _, other in probes)
    assert busy.windows == sum(other is None for _, other in probes)
    return course, samples, probes


def bound_at(course, time, report):
    """Returns the centre and radius of the first body's bound at a time, from its report."""
    place, velocity = map(np.array, course.paths[0](report))
    return place + velocity * (time - report), RADIUS + 0.5 * LIMIT * (time - report) ** 2


def cause_mark(picture, x, y, near):
    """A disc where the ring came near another body, a square where it left its safe region."""
    if near:
        picture.circle(x, y, 7.5, "probe-area")
    else:
        picture.rect(x - 7, y - 7, 14, 14, "open-area")


def draw():
    """The bound in the plane, and below it its radius over time: x is place in the one and time in the other."""
    course, samples, probes = run()
    reports = sorted({sample[4] for sample in samples})
    since = {report: [sample for sample in samples if sample[4] == report] for report in reports}
    scale, middle, floor, rise = 30.5, 202.0, 500.0, 44.0
    x = lambda place: 36.0 + scale * (place - START)
    at = lambda place: (x(place[0]), middle - scale * place[1])
    picture = Drawing(
        640,
        722,
        "A bound that grows and is reset",
        "A body weaves through four others. Rings around where it would be if it went straight on grow, until a probe "
        "shrinks them to the body: where a ring touches another body, or where it may leave its safe region. Below, the radius of the "
        "rings over time.",
        size=22,
    )
    picture.text(20, 34, "In the plane", "ink bold")
    for body in range(1, 5):
        picture.circle(
            *at(course.paths[body](0.0)[0]), scale * course.radii[body], "quiet-area", opacity="0.55"
        )
    for report in reports:
        for sample in since[report][6::12]:
            picture.circle(*at(sample[1:3]), scale * sample[3], "body-area", opacity="0.09")
            picture.circle(
                *at(sample[1:3]), scale * sample[3], "body-line", opacity="0.6", stroke_width="1.2"
            )
    picture.curve([at(course.paths[0](time)[0]) for time, *_ in samples], "body-line", stroke_width="3")
    for report, (time, other) in zip(reports, probes):
        centre, radius = bound_at(course, time, report)
        class_ = "open" if other is None else "probe"
        picture.circle(*at(centre), scale * radius, f"{class_}-line", style="stroke-width:2.5")
        if other is not None:
            place = np.array(course.paths[other](0.0)[0])
            toward = (place - centre) / np.linalg.norm(place - centre)
            cause_mark(picture, *at(centre + radius * toward), True)
    causes = {0.0: "body", **{time: "open" if other is None else "probe" for time, other in probes}}
    for report in reports:
        place = at(course.paths[0](report)[0])
        picture.circle(*place, scale * RADIUS, "body-area")
        picture.line(
            *place, place[0], floor - rise * RADIUS, f"{causes[report]}-line", stroke_dasharray="3 6"
        )
    picture.text(x(-0.6) + 32, at((0, 2.9))[1] + 8, "another body", "quiet")
    picture.text(50, floor - 142, "Radius of", "ink bold")
    picture.text(50, floor - 115, "the ring", "ink bold")
    picture.line(20, floor, 620, floor, "frame-line")
    for report in reports:
        edge = [(x(START + SPEED * time), floor - rise * radius) for time, _, _, radius, _ in since[report]]
        picture.area([(edge[0][0], floor), *edge, (edge[-1][0], floor)], "body-area", opacity="0.16")
        picture.curve(edge, "body-line", stroke_width="3")
    for time, other in probes:
        cause_mark(picture, x(START + SPEED * time), floor - rise * RADIUS, other is not None)
    for time in range(0, 9, 2):
        picture.text(x(START + SPEED * time), floor + 28, f"{time} s", "quiet", "middle")
    legend(picture)
    return picture


def legend(picture):
    picture.text(20, 568, "The ring holds all places where the body can be.")
    picture.text(20, 598, "It grows by half the acceleration limit × time².")
    picture.text(20, 634, "A probe shrinks it to the body again:")
    for row, near, words in (
        (667, True, "the ring touched another body"),
        (699, False, "it left its safe region"),
    ):
        cause_mark(picture, 34.0, row - 7.5, near)
        picture.text(54, row, words)
