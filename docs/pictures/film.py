"""Bounds that grow and shrink and contacts that flash: a picture that moves, and a still of it."""

import math

import numpy as np
from drawing import Drawing, number

from kinesphere import SteeredMotion, World, bounce, place_spheres


class Film:
    """Discs that are steered at random and bounce in a box, noted as they and their bounds move."""

    count, end, width, height, limit, step = 10, 12.0, 20.0, 10.6, 1.2, 0.02

    def __init__(self):
        random = np.random.default_rng(3)
        self.radii = random.uniform(0.4, 1.0, self.count)
        box = ((0, 0, -1), (self.width, self.height, 1))
        places = place_spheres(self.radii, box, gap=0.5, seed=8, dimensions=2)
        turns = random.uniform(0, 2 * math.pi, self.count)
        self.motion = SteeredMotion(
            np.pad(places, ((0, 0), (0, 1))),
            2.0 * np.column_stack((np.cos(turns), np.sin(turns), np.zeros(self.count))),
            acceleration_limits=self.limit,
        )
        self.world = World(box=box, dimensions=2, contacts="impacts")
        self.ids = self.world.add_motion(self.motion, radii=self.radii)
        self.tracks = [[] for _ in self.ids]  # of each body: time and place
        self.reports = [[] for _ in self.ids]  # of each body: time, place and velocity
        self.contacts = []  # time, point, and whether it is of two bodies
        for step, time in enumerate(np.arange(0.0, self.end + 1e-9, self.step)):
            if step % 25 == 0:
                turns = random.uniform(0, 2 * math.pi, self.count)
                for body, turn in enumerate(turns):
                    push = 0.99 * self.limit * np.array([math.cos(turn), math.sin(turn), 0.0])
                    self.motion.steer(body, self.world.time, push)
            for event in self.world.events(time, self.motion):
                self.bounce(event)
            self.note(time, step % 4 == 0)

    def bounce(self, event):
        bodies = [event.first] if event.second is None else [event.first, event.second]
        for body, velocity in zip(bodies, bounce(event)):
            self.motion.set_velocity([int(body)], event.time, [velocity])
            self.world.set_velocity(body, velocity)
        self.contacts.append((event.time, event.point[:2], event.second is not None))
        self.note(event.time, True)

    def note(self, time, with_place):
        places, _ = self.motion.states(time)
        for k, view in enumerate(map(self.world.body, self.ids)):
            if with_place:
                self.tracks[k].append((time, places[k]))
            if not self.reports[k] or self.reports[k][-1][0] != view.report_time:
                self.reports[k].append((view.report_time, view.position, view.velocity))

    def bound(self, body):
        """Times, centres and radii of a body's bound, twice where a report makes it jump."""
        ends = [report[0] for report in self.reports[body][1:]] + [self.end]
        for (begin, place, velocity), finish in zip(self.reports[body], ends):
            for age in np.linspace(0.0, finish - begin, 2 + int((finish - begin) / 0.12)):
                yield begin + age, place + velocity * age, self.radii[body] + 0.5 * self.limit * age * age


def animate(name, keys, end, kind=None):
    """An animation that repeats: keys are times, from 0 to the end, and values."""
    times = ";".join(f"{time / end:.4f}".rstrip("0").rstrip(".") for time, _ in keys)
    tag = "animate" if kind is None else f'animateTransform type="{kind}"'
    values = ";".join(value for _, value in keys)
    return f'<{tag} attributeName="{name}" dur="{end:g}s" repeatCount="indefinite" keyTimes="{times}" values="{values}"/>'


def flash(name, times, duration, high, end):
    """An animation of a value that jumps up at times and falls to 0 in a duration."""
    keys = [(0.0, "0")]
    for time in times:
        if time < keys[-1][0]:
            keys.pop()
        keys += [(time, "0"), (time, high), (min(time + duration, end), "0")]
    return animate(name, [*keys, (end, "0")], end)


def draw(moving=True):
    """Bounds that grow and shrink at each probe, and contacts that flash; a still of it if it is not moving."""
    run = Film()
    scale = 31.0
    at = lambda place: (10.0 + scale * place[0], 10.0 + scale * (run.height - place[1]))
    pair = lambda place: ",".join(map(number, at(place)))
    contacts = sum(of_two for *_, of_two in run.contacts)
    picture = Drawing(
        640,
        440,
        "Bodies whose paths nobody knows in advance",
        "Discs move and bounce in a box. A ring around each grows and shrinks to the disc whenever it is probed. "
        "Contacts flash.",
    )
    picture.rect(10, 10, scale * run.width, scale * run.height, "faint-area", rx=4)
    now = 0.0 if moving else 7.0
    for body, radius in enumerate(run.radii):
        keys = list(run.bound(body))
        _, centre, grown = next(key for key in keys if key[0] >= now)
        moves = shrinks = ""
        if moving:
            way = [(time, pair(place)) for time, place, _ in keys]
            moves = animate("transform", way, run.end, "translate")
            shrinks = animate("r", [(time, number(scale * ring)) for time, _, ring in keys], run.end)
        for class_, opacity in (("area", 0.14), ("line", 0.8)):
            ring = f'<circle class="body-{class_}" opacity="{opacity}" r="{number(scale * grown)}">{shrinks}</circle>'
            picture.add("g", ring + moves, transform=f"translate({pair(centre)})")
    for body, radius in enumerate(run.radii):
        track = run.tracks[body]
        place = next(place for time, place in track if time >= now)
        disc = f'<circle class="body-area" r="{number(scale * radius)}"/>'
        if moving:
            times = [time for time, *_ in run.reports[body]]
            disc += f'<circle class="probe-area" opacity="0" r="6">{flash("opacity", times, 0.3, "1", run.end)}</circle>'
            disc += animate("transform", [(time, pair(place)) for time, place in track], run.end, "translate")
        picture.add("g", disc, transform=f"translate({pair(place)})")
    if moving:
        for contact in run.contacts:
            draw_contact(picture, run.end, at, *contact)
        fade = animate("opacity", [(0.0, "1"), (0.4, "0"), (run.end - 0.4, "0"), (run.end, "1")], run.end)
        picture.add("rect", fade, x=10, y=10, width=620, height=328, class_="paper-area", opacity=0)
    legend(picture)
    asked = f"{run.world.counters.probes} probes find all {contacts} contacts"
    picture.text(12, 420, f"{asked}; 60 Hz asks {60 * run.count * run.end:,.0f} times", "quiet small")
    return picture


def draw_contact(picture, end, at, time, point, of_two):
    """Adds a ring that grows and fades from a time on, smaller at a wall."""
    x, y = map(number, at(point))
    later = min(time + 0.6, end)
    largest = "30" if of_two else "12"
    grows = [(0.0, "0"), (time, "0"), (time, "5"), (later, largest), (later, "0"), (end, "0")]
    inner = animate("r", grows, end) + flash("opacity", [time], 0.6, "1", end)
    picture.add("circle", inner, cx=x, cy=y, r=0, class_="contact-line", style="stroke-width:5")


def legend(picture):
    picture.circle(26, 368, 9, "body-area")
    picture.circle(26, 368, 14, "body-line")
    picture.text(48, 375, "bound, grows")
    picture.circle(206, 368, 7, "probe-area")
    picture.text(222, 375, "probe, shrinks it")
    picture.circle(416, 368, 10, "contact-line", style="stroke-width:5")
    picture.text(436, 375, "contact")
