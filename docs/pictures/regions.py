"""Safe regions, who is whose neighbour, and which contact each body waits for."""

import math

import numpy as np
from bound import Course
from drawing import Drawing

from kinesphere import place_spheres

COUNT = 20
NOW = 1.0


def drifting(place, velocity, phase):
    """Along a velocity, with a sway to the side of acceleration 0.3 at most."""
    place, velocity = np.append(place, 0.0), np.append(velocity, 0.0)
    side = 0.3 * np.array([-velocity[1], velocity[0], 0.0]) / np.linalg.norm(velocity)
    return lambda t: (
        place + velocity * t + side * (math.sin(t + phase) - math.sin(phase) - t * math.cos(phase)),
        velocity + side * (math.cos(t + phase) - math.cos(phase)),
    )


def run():
    """Returns the bodies' places and radii, their safe regions (centre and reach), the pairs of neighbours that none of
    the two is due about, and those that one is."""
    random = np.random.default_rng(5)
    radii = random.uniform(0.35, 0.6, COUNT)
    places = place_spheres(radii, ((0, 0, -1), (18, 11, 1)), gap=1.2, seed=2, dimensions=2)
    turns, speeds = random.uniform(0, 2 * math.pi, COUNT), random.uniform(0.4, 1.9, COUNT)
    velocities = speeds[:, None] * np.column_stack((np.cos(turns), np.sin(turns)))
    course = Course(
        list(map(drifting, places, velocities, random.uniform(0, 6, COUNT))), radii, [0.3] * COUNT
    )
    course.advance(NOW)
    world = course.world
    now = [path(NOW)[0] for path in course.paths]
    regions = []
    for body, place, radius in zip(map(world.body, course.ids), now, radii):
        lower, upper = np.array(body.box.lower), np.array(body.box.upper)
        centre, reach = (lower + upper) / 2, (upper[0] - lower[0]) / 2
        assert body.box_end > NOW and math.dist(centre, place) <= reach - radius
        regions.append((centre, reach))
    neighbours = {
        frozenset((a, b))
        for a in range(COUNT)
        for b in range(a)
        if math.dist(regions[a][0], regions[b][0]) <= regions[a][1] + regions[b][1]
    }
    due = {frozenset((course.ids.index(a), course.ids.index(b))) for a, b, time in world.certificates()}
    assert due and due <= neighbours
    assert all(math.dist(now[a], now[b]) > radii[a] + radii[b] for a in range(COUNT) for b in range(a))
    return now, radii, regions, sorted(map(sorted, neighbours - due)), sorted(map(sorted, due))


def draw():
    places, radii, regions, near, due = run()
    scale = 31.0
    at = lambda place: (40.0 + scale * place[0], 424.0 - scale * place[1])
    picture = Drawing(
        640,
        778,
        "Safe regions, neighbours, and what each body waits for",
        "Discs in the plane, each in its safe region, a larger disc that does not move. Lines join the bodies whose "
        "safe regions meet; where the line is solid, one of the two is due when they may touch.",
        size=22,
    )
    for centre, reach in regions:
        picture.circle(*at(centre), scale * reach, "body-area", opacity="0.13")
        picture.circle(*at(centre), scale * reach, "body-line", style="stroke-width:1.5")
    places = list(map(at, places))
    for place, radius in zip(places, radii):
        picture.circle(*place, scale * radius, "body-area")
    for first, second in near:
        picture.line(
            *places[first], *places[second], "ink-line", stroke_dasharray="1 7", style="stroke-width:3.5"
        )
    for first, second in due:
        picture.line(*places[first], *places[second], "probe-line", style="stroke-width:4")
        for body in (first, second):
            picture.circle(*places[body], 5, "probe-area")
    legend(picture, len(near), len(due))
    return picture


def legend(picture, near, due):
    """Rows of a sign, what it is, and in a quieter line what follows from it."""
    apart = COUNT * (COUNT - 1) // 2 - near - due
    rows = (
        ("a body", None),
        ("its safe region, which does not move: holds", "the body until its own time"),
        (f"no line: {apart} pairs that have nothing to do with", "each other as long as both stay in theirs"),
        (f"dotted: {near} pairs of neighbours, in each", "other's lists, surely apart for a while"),
        (f"line: {due} pairs of which one body is due when", "they may touch, the first time for it"),
    )
    y, middles = 494, []
    for words, more in rows:
        picture.text(76, y, words)
        if more:
            picture.text(76, y + 27, more, "quiet")
        middles.append(y - 7)
        y += 66 if more else 38
    picture.circle(41, middles[0], 11, "body-area")
    picture.circle(41, middles[1], 16, "body-area", opacity="0.13")
    picture.circle(41, middles[1], 16, "body-line", style="stroke-width:1.5")
    picture.circle(30, middles[2], 6, "body-area")
    picture.circle(53, middles[2], 6, "body-area")
    picture.line(24, middles[3], 58, middles[3], "ink-line", stroke_dasharray="1 7", style="stroke-width:3.5")
    picture.line(24, middles[4], 58, middles[4], "probe-line", style="stroke-width:4")
