"""A bound that grows and is reset."""

import numpy as np
from course import Course, still, weaving
from drawing import Drawing


END = 8.0
START, SPEED, RADIUS = -9.0, 2.2, 0.5


def run():
    """Returns the course, and samples of the first body's bound: time, centre, radius and time of its report."""
    course = Course(
        [
            weaving(START, SPEED, 1.0, 0.95),
            still(-4.2, -2.9),
            still(-0.6, 2.9),
            still(3.0, -2.7),
            still(6.6, 2.8),
        ],
        [RADIUS, 0.7, 0.7, 0.7, 0.7],
        [0.92, 0.0, 0.0, 0.0, 0.0],
    )
    samples = []
    for time in np.linspace(0.0, END, 321):
        course.advance(time)
        (centre,), (radius,) = course.world.bounds([course.ids[0]])
        samples.append((time, *centre[:2], radius, course.world.body(course.ids[0]).report_time))
    return course, samples


def draw():
    """The bound in the plane, and below it its radius over time: x is place in the one and time in the other."""
    course, samples = run()
    reports = sorted({sample[4] for sample in samples})
    since = {report: [sample for sample in samples if sample[4] == report] for report in reports}
    scale, middle, floor, rise = 31.5, 195.0, 520.0, 46.0
    x = lambda place: 36.0 + scale * (place - START)
    at = lambda place: (x(place[0]), middle - scale * place[1])
    picture = Drawing(
        640,
        590,
        "A bound that grows and is reset",
        "A body weaves through four others. Rings around where it would be if it went straight on grow, until a probe "
        "shrinks them to the body. Below, the radius of the rings over time.",
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
    for report in reports:
        place = at(course.paths[0](report)[0])
        picture.circle(*place, scale * RADIUS, "body-area")
        picture.line(
            place[0], place[1], place[0], floor - rise * RADIUS, "probe-line", stroke_dasharray="3 6"
        )
    picture.text(50, floor - 152, "Radius of", "ink bold")
    picture.text(50, floor - 127, "the bound", "ink bold")
    picture.line(20, floor, 620, floor, "frame-line")
    for report in reports:
        edge = [(x(START + SPEED * time), floor - rise * radius) for time, _, _, radius, _ in since[report]]
        picture.area([(edge[0][0], floor), *edge, (edge[-1][0], floor)], "body-area", opacity="0.16")
        picture.curve(edge, "body-line", stroke_width="3")
    for report in reports:
        picture.circle(x(START + SPEED * report), floor - rise * RADIUS, 6.5, "probe-area")
    for time in range(0, 9, 2):
        picture.text(x(START + SPEED * time), floor + 26, f"{time} s", "quiet", "middle")
    picture.circle(34, 570, 7, "probe-area")
    picture.text(50, 577, "probe: the bound is the body again, until it grows", "ink")
    return picture
