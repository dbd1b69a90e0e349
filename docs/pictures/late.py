"""A report that comes late: two tracks that close in, of which one reports with a delay of 4 s."""

import numpy as np
from drawing import Drawing

from kinesphere import Monitor, Separation, SeparationRule, TrackClass, Verdict

END, SEPARATION, ERROR = 16.0, 6.0, 0.3
PATHS = [lambda t: (1.6 * t - 0.05 * t * t, 1.6 - 0.1 * t), lambda t: (26.0 - 0.05 * t, -0.05)]
# Track, timestamp and arrival.
REPORTS = [(0, 0.0, 0.0), (0, 3.0, 3.4), (0, 9.0, 13.0), (0, 14.4, 14.6)]
REPORTS += [(1, float(time), time + 0.2 * (time > 0)) for time in range(0, 16, 2)]


def run():
    """Returns the bands of both tracks, a list of samples (time, centre, radius) for each report, and the verdicts."""
    monitor = Monitor(
        classes=[TrackClass(acceleration_limit=0.25)],
        separations=[SeparationRule(0, 0, [Separation.sphere(SEPARATION)])],
        dimensions=2,
    )
    bands, verdicts = ([], []), [(0.0, Verdict.apart)]
    waiting = sorted(REPORTS, key=lambda report: report[2])
    for time in np.arange(0.0, END + 0.01, 0.05):
        while waiting and waiting[0][2] <= time + 1e-9:
            track, timestamp, arrival = waiting.pop(0)
            verdicts += [
                (event.time, event.verdict) for event in monitor.events(arrival) if event.verdict is not None
            ]
            place, speed = PATHS[track](timestamp)
            bands[track].append([])
            monitor.report(
                track, timestamp, [place, 0, 0], [speed, 0, 0], position_errors=ERROR, velocity_errors=0.05
            )
        verdicts += [
            (event.time, event.verdict) for event in monitor.events(time) if event.verdict is not None
        ]
        for track, band in enumerate(bands):
            (place,) = monitor.track(track).places
            assert abs(place.centre[0] - PATHS[track](time)[0]) <= place.radius.total
            band[-1].append((time, place.centre[0], place.radius.total))
    return bands, verdicts


def draw():
    bands, verdicts = run()
    x = lambda time: 40.0 + 35.0 * time
    y = lambda place: 444.0 - 12.4 * place
    picture = Drawing(
        640,
        698,
        "A report that comes late",
        "Two tracks over time. The places that each can be at grow until a report of it arrives. One report comes four "
        "seconds after its timestamp; it makes the places fewer, and the verdict is apart again.",
        size=22,
    )
    picture.text(20, 36, "Where two tracks can be, over time", "ink bold")
    for time in range(0, 17, 4):
        picture.line(x(time), 56, x(time), y(-2), "faint-line")
        picture.text(x(time), y(-2) + 24, f"{time} s", "quiet", "middle")
    for class_, band in zip(("body", "other"), bands):
        for since in band:
            upper = [(x(time), y(centre + radius)) for time, centre, radius in since]
            lower = [(x(time), y(centre - radius)) for time, centre, radius in since]
            picture.area(upper + lower[::-1], f"{class_}-area", opacity="0.25")
            for edge in (upper, lower):
                picture.curve(edge, f"{class_}-line", style="stroke-width:1.5")
    keep_out = [
        (x(time), y(centre - radius - SEPARATION)) for since in bands[1] for time, centre, radius in since
    ]
    picture.curve(keep_out, "open-line", stroke_dasharray="6 5")
    for class_, path in zip(("body", "other"), PATHS):
        picture.curve(
            [(x(time), y(path(time)[0])) for time in range(17)], f"{class_}-line", style="stroke-width:3.5"
        )
    for track, timestamp, arrival in REPORTS:
        picture.circle(x(timestamp), y(PATHS[track](timestamp)[0]), 5.5, "probe-area")
    place = y(PATHS[0](9.0)[0])
    picture.arrow(x(9.0), place + 12, x(13.0), place + 12, "probe")
    picture.text(x(9.0) - 6, place + 110, "timestamp 9 s,", "probe")
    picture.text(x(9.0) - 6, place + 137, "arrival 13 s", "probe")
    picture.text(x(2.6), y(0.5), "track 1", "body")
    picture.text(x(0.2), y(26.0) - 22, "track 2", "other")
    picture.text(x(0.2), y(20.6), "separation around track 2", "open")
    for (begin, verdict), (finish, _) in zip(verdicts, [*verdicts[1:], (END, None)]):
        class_ = "sure" if verdict == Verdict.apart else "open"
        picture.rect(x(begin) + 1, 522, x(finish) - x(begin) - 2, 34, f"{class_}-area", rx=6)
        picture.text((x(begin) + x(finish)) / 2, 546, verdict.name, "paper", "middle")
    legend(picture)
    return picture


def legend(picture):
    picture.circle(40, 590, 7, "probe-area")
    picture.text(72, 597, "report, at its timestamp")
    picture.rect(26, 618, 28, 20, "body-area", opacity="0.25")
    picture.text(72, 635, "reachable set: all places that it leaves open")
    picture.rect(26, 656, 28, 24, "sure-area", rx=6)
    picture.text(72, 675, "verdict of the monitor: do they keep apart?")
