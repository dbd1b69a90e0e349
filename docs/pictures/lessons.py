"""What the programs of the lessons do, each in one picture, from runs of the same kind in the plane."""

import math

import numpy as np
from bound import Course, still
from drawing import Drawing

import kinesphere as ks

WIDTH, HEIGHT = 640, 360
BEGINS = (ks.EventKind.contact_begin, ks.EventKind.wall_begin)


def picture(title, about):
    drawing = Drawing(WIDTH, HEIGHT, title, about)
    drawing.text(20, 34, title, "ink bold")
    return drawing


def key(drawing, rows, x, y=70.0):
    """Marks with their words, one below the other."""
    for k, (ink, words) in enumerate(rows):
        drawing.circle(x, y - 6 + 30 * k, 6, f"{ink}-area")
        drawing.text(x + 18, y + 30 * k, words)


def first_contact():
    """The circle of the drone, its probes, and where it touches the other one."""
    circle = lambda t: (
        [20 * math.cos(t / 2), 20 * math.sin(t / 2), 0.0],
        [-10 * math.sin(t / 2), 10 * math.cos(t / 2), 0.0],
    )
    course = Course([circle, still(-20.0, 1.5)], [1.0, 1.0], [5.001, 0.5], contact_tolerance=1e-6)
    events = course.advance(30.0)
    drawing = picture(
        "Two drones, 38 probes in 30 s",
        "One drone flies along a circle, the other hovers in its way. Probes are far apart, and close together only before "
        "the contact.",
    )
    at = lambda place: (200.0 + 6.6 * place[0], 196.0 - 6.6 * place[1])
    drawing.curve([at(circle(t)[0]) for t in np.linspace(0, 4 * math.pi, 121)], "frame-line")
    drawing.circle(*at((-20.0, 1.5)), 6.6, "quiet-area")
    for body, time in course.probes:
        if body == 0:
            drawing.circle(*at(circle(time)[0]), 5, "probe-area", opacity="0.7")
    for event in events:
        if event.kind == ks.EventKind.contact_begin:
            drawing.circle(*at(event.first_position), 9, "contact-line", style="stroke-width:3")
    begins = [event.time for event in events if event.kind == ks.EventKind.contact_begin]
    key(drawing, [("probe", "asked where it is"), ("contact", "contacts, at")], 390)
    for k, time in enumerate(begins):
        drawing.text(408, 130 + 28 * k, f"{time:.6f} s", "contact")
    drawing.text(390, 220, "A loop at 60 Hz asks", "quiet")
    drawing.text(390, 246, "3,600 times.", "quiet")
    return drawing


def game_loop():
    """The height of a fast ball over some frames: contacts are between frames."""
    dt, radius, ceiling = 1 / 60, 0.2, 10.0
    position, velocity = np.array([[5.0, 2.0]]), np.array([[0.0, 57.0]])
    frames, bodies = ks.FrameMotion(position, interval=dt), ks.BodyMap()
    world = ks.World(
        dimensions=2, box=((0, 0), (ceiling, ceiling)), contact_tolerance=1e-3, contacts="impacts"
    )
    bodies.add_all(world, frames, radius)
    path, contacts = [(0.0, position[0, 1])], []
    for frame in range(1, 43):
        velocity[0, 1] -= 9.81 * dt
        position = position + velocity * dt
        bodies.push(world, frames, position, frame * dt)
        for event in world.events(frame * dt, bodies):
            if event.kind != ks.EventKind.wall_begin:
                continue
            velocity = np.array([ks.bounce(event, restitution=0.8)[0][:2]])
            bodies.set_velocity(world, event.first, velocity[0])
            contacts.append((event.time, event.first_position[1]))
            path.append(contacts[-1])
        position = np.asarray(frames.latest())[:, :2]
        path.append((frame * dt, position[0, 1]))
    drawing = picture(
        "One ball, frame by frame",
        "The height of a ball over time, with a line for each frame. It reaches floor and ceiling between two frames, and "
        "turns there.",
    )
    x, y = lambda time: 30.0 + 820.0 * time, lambda height: 290.0 - 22.0 * height
    drawing.rect(x(0), y(ceiling), 580, y(0) - y(ceiling), "frame-line")
    for frame in range(43):
        drawing.line(x(frame * dt), y(0), x(frame * dt), y(ceiling), "faint-line", stroke_width="1")
    drawing.curve([(x(time), y(height)) for time, height in path], "body-line", style="stroke-width:1.5")
    at_contacts = {time for time, _ in contacts}
    for time, height in path:
        if time not in at_contacts:
            drawing.circle(x(time), y(height), 3.5, "body-area")
    for time, height in contacts:
        drawing.circle(x(time), y(height), 6, "contact-area")
    key(drawing, [("body", "where frames have it")], 40, 330)
    key(drawing, [("contact", "contacts, between frames")], 320, 330)
    return drawing


def bullets():
    """Bullets of 300 units a second through a light barrier and against targets."""
    motion = ks.Ballistic([(-15.0, z, 0.0) for z in (-4.5, -1.5, 1.5, 4.5)], [(300.0, 0.0, 0.0)] * 4)
    targets = [(1.3, -4.5), (5.1, 1.5), (-4.2, 4.5)]
    world, bodies = ks.World(contact_tolerance=1e-4), ks.BodyMap()
    numbers = bodies.add_all(world, motion, 0.02)
    world.add_zone(ks.Box((-12, -8, -8), (-11.99, 8, 8)))
    for place in targets:
        world.add_static(ks.Box((place[0] - 0.3, place[1] - 0.3, -1), (place[0] + 0.3, place[1] + 0.3, 1)))
    seen, hits = [], {}
    for event in world.events(0.08, bodies):
        if event.kind == ks.EventKind.sensor_enter:
            seen.append(event)
        if event.kind == ks.EventKind.contact_begin:
            bullet = event.first if event.first in numbers else event.second
            hits[int(bullet)] = event
            bodies.remove(world, bullet)
    drawing = picture(
        "A thin barrier sees each bullet",
        "Four bullets fly five units a frame through a light barrier a hundredth of a unit thin; three hit targets smaller "
        "than their step.",
    )
    x, y = lambda place: 40.0 + 22.0 * (place + 15.0), lambda place: 170.0 - 20.0 * place
    drawing.line(x(-11.995), y(6), x(-11.995), y(-6), "open-line")
    for place in targets:
        drawing.rect(x(place[0] - 0.3), y(place[1] + 0.3), 13.2, 12.0, "quiet-area")
    for number, height in enumerate((-4.5, -1.5, 1.5, 4.5)):
        end = hits[number].point[0] if number in hits else 9.0
        drawing.line(x(-15), y(height), x(end), y(height), "body-line", style="stroke-width:1")
        for step in range(5):
            if -15 + 5 * step <= end:
                drawing.circle(x(-15 + 5 * step), y(height), 4.5, "body-area")
    for event in seen:
        drawing.circle(x(event.point[0]), y(event.first_position[1]), 6, "open-area")
    for event in hits.values():
        drawing.circle(x(event.point[0]), y(event.point[1]), 6, "contact-area")
    key(drawing, [("body", "at frames")], 40, 334)
    key(drawing, [("open", f"{len(seen)} seen by the zone")], 190, 334)
    key(drawing, [("contact", f"{len(hits)} hits")], 430, 334)
    return drawing


def own_motion():
    """Drones that fly to their stations, as by a spring and a damper."""
    random = np.random.default_rng(5)
    starts, stations = random.uniform((0, 0), (40, 20), (8, 2)), random.uniform((0, 0), (40, 20), (8, 2))
    rate = 0.6

    def path(start, station):
        def state(time):
            way, fade = start - station, math.exp(-rate * time)
            place = station + way * (1 + rate * time) * fade
            speed = -way * rate * rate * time * fade
            return [*place, 0.0], [*speed, 0.0]

        return state

    paths = [path(start, station) for start, station in zip(starts, stations)]
    limits = [
        1.001 * rate * rate * float(np.linalg.norm(start - station))
        for start, station in zip(starts, stations)
    ]
    course = Course(paths, [1.5] * 8, limits, contact_tolerance=1e-3)
    events = [event for event in course.advance(12.0) if event.kind == ks.EventKind.contact_begin]
    drawing = picture(
        "Eight drones, each to its station",
        "Ways of eight drones to their stations, where each was asked, and where two came within three metres.",
    )
    x, y = lambda place: 40.0 + 14.0 * place, lambda place: 316.0 - 12.6 * place
    for one, station in zip(paths, stations):
        drawing.curve(
            [(x(one(t)[0][0]), y(one(t)[0][1])) for t in np.linspace(0, 12, 49)],
            "body-line",
            style="stroke-width:1.5",
        )
        drawing.rect(x(station[0]) - 5, y(station[1]) - 5, 10, 10, "sure-area")
    for body, time in course.probes:
        place = paths[body](time)[0]
        drawing.circle(x(place[0]), y(place[1]), 3, "probe-area", opacity="0.7")
    for event in events:
        middle = (event.first_position + event.second_position) / 2
        drawing.circle(x(middle[0]), y(middle[1]), 14, "contact-line")
    key(drawing, [("sure", "stations")], 40, 346)
    key(drawing, [("probe", f"{len(course.probes)} probes")], 190, 346)
    key(drawing, [("contact", f"{len(events)} times within 3 m")], 370, 346)
    return drawing


def gas():
    """Discs in a box with the events of a run, and the motion after it."""
    box = ((0, 0), (20, 16))
    radii = np.random.default_rng(3).uniform(0.3, 0.8, 60)
    starts = ks.place_spheres(radii, box, dimensions=2, seed=3)
    motion = ks.Ballistic(starts, np.random.default_rng(4).normal(size=starts.shape) * 3)
    world = ks.World(dimensions=2, box=box)
    world.add_motion(motion, radii=radii, masses=radii**2)
    events = world.run(3.0, motion, ks.Bouncing())
    return box, radii, np.asarray(motion.states(3.0)[0]), events


def running():
    """Where contacts of a run were, and how many."""
    box, radii, places, events = gas()
    contacts = events.of_kind(*BEGINS)
    drawing = picture(
        "A run, without a loop",
        "Discs in a box after three seconds, with a dot for each of the contacts that the world answered; beside it their "
        "number over time.",
    )
    x, y = lambda place: 20.0 + 17.0 * place, lambda place: 330.0 - 17.0 * place
    drawing.rect(x(0), y(16), 340, 272, "frame-line")
    for place, radius in zip(places, radii):
        drawing.circle(x(place[0]), y(place[1]), 17.0 * radius, "body-area", opacity="0.35")
    for point in contacts["point"]:
        drawing.circle(x(point[0]), y(point[1]), 2, "contact-area")
    over, most = lambda time: 410.0 + 55.0 * time, max(len(contacts), 1)
    up = lambda count: 300.0 - 230.0 * count / most
    drawing.line(over(0), up(0), over(3), up(0), "quiet-line")
    for kind, ink, words in (
        (ks.EventKind.contact_begin, "contact", "between discs"),
        (ks.EventKind.wall_begin, "other", "at walls"),
    ):
        times = events.of_kind(kind)["time"]
        steps = [(over(time), up(k + 1)) for k, time in enumerate(times)]
        drawing.curve([(over(0), up(0)), *steps, (over(3), up(len(times)))], f"{ink}-line")
        drawing.text(over(3) + 8, up(len(times)) + 6, f"{len(times)}", ink)
        drawing.text(over(0.1), 74 if ink == "contact" else 100, words, ink)
    for time in range(4):
        drawing.text(over(time), 326, f"{time} s", "quiet", "middle")
    return drawing


def reports():
    """What is certain of the distance of two aircraft, of which one stops reporting."""
    monitor = ks.Monitor(
        classes=[ks.TrackClass(acceleration_limit=5.0, largest_speed=80.0)],
        separations=[ks.SeparationRule(0, 0, [ks.Separation.sphere(1000.0)])],
        stale_after=10.0,
    )
    tell = lambda track, time, place, speed: monitor.report(
        track, time, place, speed, position_errors=30.0, velocity_errors=1.0
    )
    samples, verdicts = [], [(0.0, ks.Verdict.apart)]
    for step in range(161):
        now = 0.25 * step
        verdicts += [
            (event.time, event.verdict) for event in monitor.events(now) if event.verdict is not None
        ]
        if step % 4 == 0:
            tell(1, now, (60 * now, 0, 500), (60, 0, 0))
            if now <= 19:
                tell(2, now, (4000 - 60 * now, 50, 510), (-60, 0, 0))
        answer = monitor.answer(1, 2)
        samples.append((now, answer.lower, answer.upper, abs(4000 - 120 * now)))
    drawing = picture(
        "Two aircraft, of which one falls silent at 19 s",
        "Limits of the distance of two aircraft over time. Reports keep them narrow; from the last one on they spread, and "
        "the verdict turns undecided.",
    )
    x, y = lambda time: 72.0 + 13.6 * time, lambda distance: 280.0 - 0.054 * min(distance, 4200.0)
    upper = [(x(time), y(high)) for time, _, high, _ in samples]
    lower = [(x(time), y(low)) for time, low, _, _ in samples]
    drawing.area(upper + lower[::-1], "body-area", opacity="0.3")
    for edge in (upper, lower):
        drawing.curve(edge, "body-line", style="stroke-width:1.5")
    drawing.curve([(x(time), y(true)) for time, *_, true in samples], "ink-line")
    drawing.line(x(0), y(1000), x(40), y(1000), "open-line", stroke_dasharray="6 5")
    drawing.text(x(0.5), y(1000) + 24, "separation, 1,000 m", "open")
    drawing.line(x(19), y(0), x(19), y(4200), "probe-line", stroke_dasharray="3 6")
    drawing.text(x(19) + 8, 70, "the last report of one", "probe")
    drawing.text(x(26), y(2900), "where it can be", "body")
    for km in (0, 2, 4):
        drawing.text(62, y(1000 * km) + 6, f"{km} km", "quiet", "end")
    for (begin, verdict), (finish, _) in zip(verdicts, [*verdicts[1:], (40.0, None)]):
        ink = {ks.Verdict.apart: "sure", ks.Verdict.undecided: "open", ks.Verdict.within: "contact"}[verdict]
        drawing.rect(x(begin) + 1, 312, x(finish) - x(begin) - 2, 30, f"{ink}-area", rx=6)
        if x(finish) - x(begin) > 100:
            drawing.text((x(begin) + x(finish)) / 2, 334, verdict.name, "paper", "middle")
        elif verdict == ks.Verdict.undecided:
            drawing.text((x(begin) + x(finish)) / 2, 334, "?", "paper", "middle")
    return drawing


def many_machines():
    """A gas that four processes share: each has as many bodies, and copies of those that are near."""
    box, radii, places, _ = gas()
    cut = float(np.median(places[:, 0]))
    sides = [places[:, 0] < cut, places[:, 0] >= cut]
    heights = [float(np.median(places[side, 1])) for side in sides]
    rank = [2 * int(place[0] >= cut) + int(place[1] >= heights[int(place[0] >= cut)]) for place in places]
    inks = ["body", "probe", "sure", "other"]
    drawing = picture(
        "One world, four processes",
        "Discs in a box that is cut into four parts with as many discs each. Those near a cut are also known to the "
        "process beyond it.",
    )
    x, y = lambda place: 20.0 + 19.0 * place, lambda place: 334.0 - 17.6 * place
    drawing.rect(x(0), y(16), x(20) - x(0), y(0) - y(16), "frame-line")
    drawing.line(x(cut), y(0), x(cut), y(16), "quiet-line", stroke_dasharray="6 5")
    drawing.line(x(0), y(heights[0]), x(cut), y(heights[0]), "quiet-line", stroke_dasharray="6 5")
    drawing.line(x(cut), y(heights[1]), x(20), y(heights[1]), "quiet-line", stroke_dasharray="6 5")
    near = 0
    for place, radius, owner in zip(places, radii, rank):
        drawing.circle(x(place[0]), y(place[1]), 17.6 * radius, f"{inks[owner]}-area", opacity="0.75")
        height = heights[int(place[0] >= cut)]
        if abs(place[0] - cut) < radius + 1.0 or abs(place[1] - height) < radius + 1.0:
            near += 1
            drawing.circle(x(place[0]), y(place[1]), 17.6 * radius + 3, "ink-line")
    key(drawing, [(inks[k], f"rank {k}: {rank.count(k)} bodies") for k in range(4)], 424)
    drawing.circle(424, 214, 8, "ink-line")
    drawing.text(442, 220, f"{near} of them are")
    drawing.text(442, 246, "ghosts on others")
    return drawing


DRAWINGS = {
    "first-contact": first_contact,
    "game-loop": game_loop,
    "bullets": bullets,
    "own-motion": own_motion,
    "running": running,
    "reports": reports,
    "many-machines": many_machines,
}
