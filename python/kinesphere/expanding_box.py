"""A periodic box that grows or shrinks with time, for balls in exact flight."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import numpy.typing as npt

from ._kinesphere import no_body
from .errors import InvalidValue
from .events import Events

Doubles = npt.NDArray[np.float64]


class ExpandingBox:
    """A box whose edges are scale(t) times as long as at the start, and the balls in it.

    Seen from the box, whose edges then stay as they are, balls in exact flight fly straight as well, on another clock,
    and their radii change at constant rates. A World knows such balls, so it needs nothing else:

        box = ks.ExpandingBox(rate=-0.01)  # shrinks
        motion = ks.Ballistic(*box.seen(positions, velocities, 0.0))
        ids = world.add_motion(motion, radii=radii)
        world.set_radius_rate(ids, box.radius_rates(radii))
        events = box.real_events(world.run(box.clock(duration), motion, ks.Bouncing()))

    "Real" are time, places and velocities in this box, from the origin, which stays where it is. "Seen" is what the
    box sees, or a world whose box has the edges of the start: places are divided by the scale, and the clock stands at
    0 at the start. Two touch in the box if and only if they touch in the world, in the same order, and a bounce in the
    world is one in the box of the same restitution.

    rate (1 / time): of the scale at the start; negative for a box that shrinks.
    flow: "free" for balls that keep their velocities and know nothing of the box: scale(t) = 1 + rate t, as by pistons
    on all sides; a gas cools as it expands. "carried" for balls that the box carries along: one at x moves at
    rate x + v, where its velocity v against the flow stays as it is; scale(t) = exp(rate t), and velocities are v.
    start_time: the real time when the scale is 1.

    Raises InvalidValue for numbers that are not finite and for another flow.
    """

    def __init__(
        self, rate: float, flow: Literal["free", "carried"] = "free", start_time: float = 0.0
    ) -> None:
        for name, number in [("rate", rate), ("start_time", start_time)]:
            if not math.isfinite(number):
                raise InvalidValue(
                    f"ExpandingBox: {name} must be finite, but is {number}", "not_finite", name
                )
        if flow not in ("free", "carried"):
            raise InvalidValue(
                f"ExpandingBox: flow must be 'free' or 'carried', but is {flow!r}", "out_of_range", "flow"
            )
        self.rate, self.flow, self.start_time = float(rate), flow, float(start_time)

    def __repr__(self) -> str:
        return f"ExpandingBox(rate={self.rate}, flow={self.flow!r}, start_time={self.start_time})"

    def scale(self, time: npt.ArrayLike) -> Doubles:
        """How many times as long as at the start an edge is at these real times; at most 0 once a free box is gone."""
        strain = self.rate * (np.asarray(time, dtype=float) - self.start_time)
        return np.asarray(1.0 + strain if self.flow == "free" else np.exp(strain))

    def scale_at(self, clock: npt.ArrayLike) -> Doubles:
        """The same at times of the clock."""
        return np.asarray(1.0 / (1.0 - self.rate * np.asarray(clock, dtype=float)))

    def clock(self, time: float) -> float:
        """The clock at a real time; inf once a box that shrinks has no size any more, -inf before one that grows has."""
        since = time - self.start_time
        if self.flow == "carried":
            return -math.expm1(-self.rate * since) / self.rate if self.rate != 0.0 else since
        size = 1.0 + self.rate * since
        return since / size if size > 0.0 else math.copysign(math.inf, since)

    def time(self, clock: npt.ArrayLike) -> Doubles:
        """Real times at times of the clock; inf if it never comes so far, as that of a box that grows ends at 1 / rate."""
        at = np.asarray(clock, dtype=float)
        left = 1.0 - self.rate * at
        with np.errstate(divide="ignore", invalid="ignore"):
            if self.flow == "free":
                since = at / left
            else:
                since = -np.log1p(-self.rate * at) / self.rate if self.rate != 0.0 else at
        return np.asarray(self.start_time + np.where(left > 0.0, since, np.copysign(np.inf, at)))

    def radius_rates(self, radii: npt.ArrayLike) -> Doubles:
        """The rates of World.set_radius_rate() for balls of these real radii, which they have in the world at the start.

        Those added later have the radii radii / scale(time), and the same rates.
        """
        return np.asarray(-self.rate * np.asarray(radii, dtype=float))

    def seen(
        self, positions: npt.ArrayLike, velocities: npt.ArrayLike, time: float
    ) -> tuple[Doubles, Doubles]:
        """Real states at a real time, shape (n, 3) or (n, 2) each, as the box sees them."""
        size, x, v = self.scale(time), np.asarray(positions, dtype=float), np.asarray(velocities, dtype=float)
        return x / size, (size * v - self.rate * x if self.flow == "free" else v.copy())

    def real(
        self, positions: npt.ArrayLike, velocities: npt.ArrayLike, clock: npt.ArrayLike
    ) -> tuple[Doubles, Doubles]:
        """Real states of those that the box sees so when the clock stands there; one clock for all, or one for each."""
        x, v = np.asarray(positions, dtype=float), np.asarray(velocities, dtype=float)
        size = self.scale_at(clock)
        if size.ndim == 1:
            size = size[:, np.newaxis]
        return x * size, (v / size + self.rate * x if self.flow == "free" else v.copy())

    def real_events(self, events: Events) -> Events:
        """Events of the world as those of the box: their times, states, lengths and speeds."""
        clock, size = events["time"], self.scale_at(events["time"])
        slowed = size if self.flow == "free" else np.ones_like(size)
        rows = events.array.copy()
        rows["time"] = self.time(clock)
        for side in ("first", "second"):
            position, velocity = self.real(events[f"{side}_position"], events[f"{side}_velocity"], clock)
            there = events[side] != no_body
            rows[f"{side}_position"][there], rows[f"{side}_velocity"][there] = (
                position[there],
                velocity[there],
            )
        rows["point"] *= size[:, np.newaxis]
        rows["approach_speed"] = events["approach_speed"] / slowed - self.rate * events["gap"] * (
            size / slowed
        )
        for name in ("gap", "distance", "position_excess"):
            rows[name] *= size
        rows["velocity_excess"] /= slowed
        return Events(rows)
