"""The life of a pair, from search to contact."""

import math

import numpy as np
from bound import Course, weaving
from drawing import Drawing

from kinesphere import EventKind


def run():
    """Returns the course, samples of time, true gap, certain gap and times of reports, the first body's safe regions and the contact."""
    course = Course([weaving(-6.0, 1.5, 0.8, 0.8), weaving(6.0, -1.5, 0.6, 0.7, 2.0)], [0.6, 0.6], [0.6, 0.6])
    samples, events, regions = [], [], {}
    known = lambda: tuple(course.world.body(body).report_time for body in course.ids)
    for time in np.unique(np.append(np.arange(0.0, 3.5, 0.02), np.arange(3.5, 3.7, 0.001))):
        events += course.advance(time)
        centres, radii = course.world.bounds(course.ids)
        true = math.dist(course.paths[0](time)[0], course.paths[1](time)[0]) - 1.2
        regions.setdefault(tuple(course.world.body(course.ids[0]).box.lower), time)
        samples.append((time, true, np.linalg.norm(centres[0] - centres[1]) - sum(radii), known()))
    (contact,) = [event for event in events if event.kind == EventKind.contact_begin]
    return course, samples, list(regions.values()), contact


def panel(picture, course, samples, contact, x, y, begin=0.0):
    """Draws what happens from `begin` on: what is certain, the true gap, the probes and the contact."""
    shown = [sample for sample in samples if begin <= sample[0] <= contact.time]
    for reports in dict.fromkeys(sample[3] for sample in shown):
        since = [sample for sample in shown if sample[3] == reports]
        edge = [(x(time), y(max(lower, 0.0))) for time, _, lower, _ in since]
        picture.area([(edge[0][0], y(0)), *edge, (edge[-1][0], y(0))], "sure-area", opacity="0.2")
        picture.curve(edge, "sure-line")
    picture.curve([(x(time), y(true)) for time, true, *_ in shown], "body-line", style="stroke-width:3.5")
    for _, time in course.probes:
        if begin <= time < contact.time:
            picture.circle(
                x(time), y(min(shown, key=lambda sample: abs(sample[0] - time))[1]), 6, "probe-area"
            )
    picture.circle(x(contact.time), y(0), 8, "contact-area")


def draw():
    course, samples, regions, contact = run()
    picture = Drawing(
        640,
        758,
        "The life of a pair, from search to contact",
        "The gap of two bodies falls to zero. What is certain of it falls faster, and each probe of one of the two lifts "
        "it. The failure times follow each other ever closer, until both report at the contact.",
        size=22,
    )

    x = lambda time: 56.0 + 140.0 * time
    y = lambda gap: 440.0 - 34.0 * gap
    picture.text(20, 38, "Gap of the two bodies", "ink bold")
    for gap in (0, 5, 10):
        picture.line(x(0) - 6, y(gap), x(0), y(gap), "quiet-line")
        picture.text(x(0) - 12, y(gap) + 8, str(gap), "quiet", "end")
    picture.line(x(0), y(0), 620, y(0), "quiet-line")
    panel(picture, course, samples, contact, x, y)
    for second in range(5):
        picture.text(x(second), y(0) + 28, f"{second} s", "quiet", "middle")
    for begin, finish in zip(regions, [*regions[1:], contact.time]):
        picture.rect(x(begin) + 1.5, y(0) + 42, max(x(finish) - x(begin) - 3, 1.0), 12, "quiet-area", rx=6)
    picture.text(x(1.9), y(0) + 82, "safe regions of one of the two", "quiet", "middle")

    zoomed = 3.54
    wide = lambda time: 414.0 + 194.0 * (time - zoomed) / (contact.time - zoomed)
    high = lambda gap: 248.0 - 450.0 * gap
    picture.rect(354, 16, 270, 254, "paper-area", rx=10)
    picture.rect(354, 16, 270, 254, "frame-line", rx=10)
    picture.text(608, 44, "the last 0.15 s", "ink bold", "end")
    panel(picture, course, samples, contact, wide, high, zoomed)
    picture.line(wide(zoomed), high(0), wide(contact.time), high(0), "quiet-line")
    for gap in (0.0, 0.2, 0.4):
        picture.line(wide(zoomed) - 6, high(gap), wide(zoomed), high(gap), "quiet-line")
        picture.text(wide(zoomed) - 12, high(gap) + 8, f"{gap:g}", "quiet", "end")
    picture.line(x(3.6), y(0.8), 550, 274, "frame-line", stroke_dasharray="2 6")
    legend(picture, [time for _, time in course.probes], contact)
    return picture


def legend(picture, probes, contact):
    rechecks = [time for time in probes if time < contact.time]
    hidden = sum(time > contact.time - 0.002 for time in rechecks)
    picture.line(26, 564, 54, 564, "body-line", style="stroke-width:3.5")
    picture.text(72, 571, "true gap, known to nobody")
    for row, class_, words in (
        (602, "sure", "certain: the gap is at least this"),
        (640, "probe", "certificate fails: a recheck probes one,"),
        (704, "contact", "contact_begin: both probed, at one time"),
    ):
        if class_ == "sure":
            picture.rect(26, row - 9, 28, 18, "sure-area", opacity="0.2")
            picture.line(26, row - 9, 54, row - 9, "sure-line")
        else:
            picture.circle(40, row, 8, f"{class_}-area")
        picture.text(72, row + 7, words)
    picture.text(72, 674, f"{len(rechecks)} times; {hidden} hide behind the contact", "quiet")
    picture.text(
        72, 738, f"at {contact.time:.6f} s, gap {contact.gap:.0e}; {len(probes)} probes in all", "quiet"
    )
