"""A window with its swept spheres, and who is near whom."""

import math

import numpy as np
from course import Course
from drawing import Drawing

from kinesphere import place_spheres

COUNT = 20
START, END = 1.0, 2.0


def drifting(place, velocity, phase):
    """Along a velocity, with a sway to the side of acceleration 0.3 at most."""
    place, velocity = np.append(place, 0.0), np.append(velocity, 0.0)
    side = 0.3 * np.array([-velocity[1], velocity[0], 0.0]) / np.linalg.norm(velocity)
    return lambda t: (
        place + velocity * t + side * (math.sin(t + phase) - math.sin(phase) - t * math.cos(phase)),
        velocity + side * (math.cos(t + phase) - math.cos(phase)),
    )


def meet(first, second, duration):
    """True if two balls (centre, velocity, radius) that move straight on meet within a duration."""
    offset, speed = second[0] - first[0], second[1] - first[1]
    time = min(max(-(offset @ speed) / (speed @ speed), 0.0), duration)
    return np.linalg.norm(offset + speed * time) <= first[2] + second[2]


def run():
    """Returns the bodies' places and radii as the window starts, their swept spheres, the pairs with a certificate, and
    those whose swept spheres meet without one."""
    random = np.random.default_rng(5)
    radii = random.uniform(0.35, 0.6, COUNT)
    places = place_spheres(radii, ((0, 0, -1), (18, 11, 1)), gap=1.2, seed=2, dimensions=2)
    turns, speeds = random.uniform(0, 2 * math.pi, COUNT), random.uniform(0.4, 1.9, COUNT)
    velocities = speeds[:, None] * np.column_stack((np.cos(turns), np.sin(turns)))
    course = Course(
        list(map(drifting, places, velocities, random.uniform(0, 6, COUNT))), radii, [0.3] * COUNT
    )
    course.advance(START)
    world = course.world
    centres, grown = world.bounds(course.ids)
    swept = []
    for body, centre, radius in zip(map(world.body, course.ids), centres, grown):
        age = START - body.report_time
        ahead = body.velocity
        final = body.radius + 0.5 * body.acceleration_limit * (age + END - START) ** 2
        assert body.box_end == END and radius <= final
        # The engine's own box around the swept sphere is that of this ball on its way.
        lower = np.minimum(centre, centre + ahead * (END - START)) - final
        assert np.allclose(lower[:2], body.box.lower[:2], atol=2e-2), (lower, body.box.lower)
        swept.append((centre, ahead, final))
    watched = [(course.ids.index(a), course.ids.index(b), time) for a, b, time in world.certificates()]
    named = {frozenset(pair[:2]) for pair in watched}
    assert all(meet(swept[a], swept[b], END - START) for a, b in named)
    near = [
        (a, b)
        for a in range(COUNT)
        for b in range(a)
        if meet(swept[a], swept[b], END - START) and frozenset((a, b)) not in named
    ]
    now = [path(START)[0] for path in course.paths]
    assert all(math.dist(now[a], now[b]) > radii[a] + radii[b] for a in range(COUNT) for b in range(a))
    return now, radii, swept, [pair[:2] for pair in watched], near


def draw():
    places, radii, swept, watched, near = run()
    scale = 31.0
    at = lambda place: (40.0 + scale * place[0], 424.0 - scale * place[1])
    picture = Drawing(
        640,
        778,
        "A window with its swept spheres, and who is near whom",
        "Discs in the plane, each with the way of its swept sphere until the window ends. Lines join the pairs whose "
        "swept spheres meet; some are rejected quickly, and the others have a certificate.",
        size=22,
    )
    for class_, opacity in (("area", 0.13), ("line", 0.75)):
        for centre, velocity, radius in swept:
            picture.capsule(
                at(centre),
                at(centre + velocity * (END - START)),
                scale * radius,
                f"body-{class_}",
                opacity=opacity,
                style="stroke-width:1.5",
            )
    places = list(map(at, places))
    for place, radius in zip(places, radii):
        picture.circle(*place, scale * radius, "body-area")
    for first, second in near:
        picture.line(
            *places[first], *places[second], "ink-line", stroke_dasharray="1 7", style="stroke-width:3.5"
        )
    for first, second in watched:
        picture.line(*places[first], *places[second], "probe-line", style="stroke-width:4")
    for first, second in watched:
        for body in (first, second):
            picture.circle(*places[body], 5, "probe-area")

    legend(picture, len(near), len(watched))
    return picture


def legend(picture, near, watched):
    """Rows of a sign, what it is, and in a quieter line what follows from it."""
    apart = COUNT * (COUNT - 1) // 2 - near - watched
    rows = (
        ("a body, as a window of 1 s starts", None),
        ("its swept sphere on its way: holds all that", "the body may do until the window ends"),
        (
            f"no line: {apart} pairs that never meet at one time,",
            "not looked at again before the window ends",
        ),
        (f"quick rejection: {near} pairs, whose swept spheres", "meet, but surely not the bodies"),
        (f"line: {watched} pairs near, each with a certificate", "and checked again when that fails"),
    )
    y, middles = 494, []
    for words, more in rows:
        picture.text(76, y, words)
        if more:
            picture.text(76, y + 27, more, "quiet")
        middles.append(y - 7)
        y += 66 if more else 38
    picture.circle(41, middles[0], 11, "body-area")
    picture.capsule((30, middles[1]), (52, middles[1]), 12, "body-area", opacity="0.13")
    picture.capsule((30, middles[1]), (52, middles[1]), 12, "body-line", style="stroke-width:1.5")
    picture.circle(30, middles[2], 6, "body-area")
    picture.circle(53, middles[2], 6, "body-area")
    picture.line(24, middles[3], 58, middles[3], "ink-line", stroke_dasharray="1 7", style="stroke-width:3.5")
    picture.line(24, middles[4], 58, middles[4], "probe-line", style="stroke-width:4")
