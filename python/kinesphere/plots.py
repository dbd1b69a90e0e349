"""Pictures of tables of events and approaches, by matplotlib, on which the package does not depend."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Optional, get_args

import numpy as np
import numpy.typing as npt

from .errors import InvalidValue
from .kinds import EventKind

if TYPE_CHECKING:
    from .approaches import Approaches
    from .events import Events

Part = Literal["map", "time", "histogram"]
# Distinct for all kinds of colour vision (Okabe and Ito 2008), as in `kinesphere tracks --plot`.
_colours = ("#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
_marks = ("o", "s", "^", "D", "v", "P")
_most_named = 3
least_unix_time = 1e8  # in 1973: smaller times are no seconds since 1970, as `kinesphere watch --text` has it
_shape_of_parts = (12.0, 4.0)  # inches, for all three


class _Sheet:
    """Axes for the parts of a picture: those that were given, or a new figure's."""

    def __init__(self, call: str, part: Optional[str], axes: Any) -> None:
        parts = get_args(Part)
        if part is not None and part not in parts:
            known = ", ".join(f'"{one}"' for one in parts)
            raise InvalidValue(
                f"{call}: part must be {known} or None, but is {part!r}", "out_of_range", "part"
            )
        if axes is not None and part is None:
            raise TypeError(f"{call}: axes take one part: part must be given with them")
        if axes is not None:
            self.figure, self._axes = axes.figure, {part: axes}
            return
        try:
            from matplotlib import pyplot
        except ImportError as error:
            raise ImportError(
                f"{call}: needs matplotlib, which is not installed (pip install matplotlib)"
            ) from error
        wanted = parts if part is None else (part,)
        width, height = _shape_of_parts
        size = (width, height) if part is None else (width / 2, height)
        self.figure, drawn = pyplot.subplots(
            1, len(wanted), figsize=size, squeeze=False, layout="constrained"
        )
        self._axes = dict(zip(wanted, drawn[0]))

    def of(self, part: Part) -> Any:
        """The axes of this part; None where it is not wanted."""
        return self._axes.get(part)


def plot_approaches(
    approaches: Approaches, part: Optional[Part], axes: Any, tracks: Optional[tuple[Any, Any]]
) -> Any:
    sheet = _Sheet("Approaches.plot", part, axes)
    array = approaches.array
    closest = np.argsort(array["closest_distance"], kind="stable")[:_most_named]
    names = [f"{array['first'][k]} and {array['second'][k]}" for k in closest]
    distances = array["closest_distance"]
    unit = " (m)" if approaches.is_geographic else ""
    if (here := sheet.of("map")) is not None:
        _map_of_approaches(here, approaches, closest, names, tracks)
    if (here := sheet.of("time")) is not None:
        begin, end, nearest = (_as_shown(array[name]) for name in ("begin", "end", "closest_time"))
        is_date = nearest.dtype.kind == "M"
        here.hlines(distances, begin, end, colors="0.6", linewidth=1)
        here.plot(nearest, distances, ".", color="0.3")
        for rank, k in enumerate(closest):
            here.plot(
                nearest[k], distances[k], _marks[rank], color=_colours[rank], label=names[rank], clip_on=False
            )
        _label(here, "Closest distance over time", "" if is_date else "time", "distance" + unit)
        _legend(here, names)
        here.set_ylim(bottom=min(0.0, _least(distances)))
        if is_date:
            _as_dates(here)
    if (here := sheet.of("histogram")) is not None:
        _histogram(here, distances, "Closest distances", "distance" + unit, "approaches")
    return sheet.figure


def _map_of_approaches(
    axes: Any,
    approaches: Approaches,
    closest: npt.NDArray[np.int64],
    names: list[str],
    tracks: Optional[tuple[Any, Any]],
) -> None:
    array, is_geographic = approaches.array, approaches.is_geographic
    first, second = array["first_position"], array["second_position"]
    across, up = (0, 1) if is_geographic else widest_axes(np.concatenate([first, second]))
    if tracks is not None:
        across, up = 0, 1
        if len(tracks) != 2 or np.shape(tracks[0]) != np.shape(tracks[1]):
            raise InvalidValue(
                "Approaches.plot: tracks must be two arrays of one length, x and y of all samples",
                "out_of_range",
                "tracks",
            )
        axes.plot(np.ravel(tracks[0]), np.ravel(tracks[1]), ",", color="0.8", zorder=0)
    middles = (first + second) / 2
    axes.plot(middles[:, across], middles[:, up], ".", color="0.3")
    for rank, k in enumerate(closest):
        axes.plot(
            [first[k, across], second[k, across]],
            [first[k, up], second[k, up]],
            marker=_marks[rank],
            color=_colours[rank],
            label=names[rank],
        )
    number = f"{len(array):,} approach{'es' if len(array) != 1 else ''}"
    degrees = ("longitude (degrees)", "latitude (degrees)")
    labels = degrees if is_geographic else ("xyz"[across], "xyz"[up])
    _label(axes, number, *labels)
    _legend(axes, names)
    # A degree of longitude is shorter than one of latitude.
    middle = float(np.nanmean(middles[:, 1])) if is_geographic and len(middles) > 0 else 0.0
    axes.set_aspect(1 / max(0.02, np.cos(np.radians(middle))), adjustable="datalim")


def plot_events(events: Events, part: Optional[Part], axes: Any) -> Any:
    sheet = _Sheet("Events.plot", part, axes)
    kinds = [EventKind(int(kind)) for kind in np.unique(events["kind"])]
    if (here := sheet.of("map")) is not None:
        points = events["point"]
        across, up = widest_axes(points)
        for k, kind in enumerate(kinds):
            of_kind = points[events["kind"] == kind]
            style = {"color": _colours[k % len(_colours)], "label": str(kind)}
            here.plot(of_kind[:, across], of_kind[:, up], _marks[k % len(_marks)], markersize=3, **style)
        _label(here, "Where", "xyz"[across], "xyz"[up])
        here.set_aspect("equal", adjustable="datalim")
        _legend(here, kinds)
    if (here := sheet.of("time")) is not None:
        for k, kind in enumerate(kinds):
            times = events["time"][events["kind"] == kind]
            here.step(
                times,
                np.arange(1, len(times) + 1),
                where="post",
                color=_colours[k % len(_colours)],
                label=str(kind),
            )
        _label(here, "Events so far", "time", "events")
        _legend(here, kinds)
    if (here := sheet.of("histogram")) is not None:
        contacts = np.isin(events["kind"], [int(EventKind.contact_begin), int(EventKind.wall_begin)])
        _histogram(
            here, events["approach_speed"][contacts], "Contacts by speed", "approach speed", "contacts"
        )
    return sheet.figure


def widest_axes(positions: npt.NDArray[np.float64]) -> tuple[int, int]:
    """The two axes along which positions of shape (n, 3) reach farthest, x before y before z."""
    known = positions[:, ~np.isnan(positions).any(axis=0)] if len(positions) > 0 else positions
    if known.shape[1] < 3 or len(known) == 0:
        return 0, 1
    narrowest = 2 - int(np.argmin(np.ptp(known, axis=0)[::-1]))
    return (1 if narrowest == 0 else 0), (1 if narrowest == 2 else 2)


def _as_shown(times: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Dates for seconds since 1970; all else as it is."""
    if times.dtype.kind == "M" or len(times) == 0 or not least_unix_time <= np.nanmin(times) < 1e10:
        return times
    return np.array(np.rint(times * 1e3), dtype="datetime64[ms]")


def _least(values: npt.NDArray[np.float64]) -> float:
    return float(np.min(values, initial=0.0))


def _label(axes: Any, title: str, x: str, y: str) -> None:
    axes.set_title(title)
    axes.set_xlabel(x)
    axes.set_ylabel(y)


def _legend(axes: Any, names: list[Any]) -> None:
    if names:
        axes.legend(fontsize="small")
    else:
        _say_none(axes)


def _histogram(axes: Any, values: npt.NDArray[np.float64], title: str, x: str, y: str) -> None:
    finite = values[np.isfinite(values)]
    if len(finite) > 0:
        axes.hist(finite, bins=min(50, max(5, int(np.sqrt(len(finite))))), color=_colours[1])
    else:
        _say_none(axes)
    _label(axes, title, x, y)


def _say_none(axes: Any) -> None:
    axes.text(0.5, 0.5, "none", transform=axes.transAxes, horizontalalignment="center", color="0.4")


def _as_dates(axes: Any) -> None:
    """Clock times that are as short as can be, with the day once."""
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter

    locator = AutoDateLocator(maxticks=5)
    axes.xaxis.set_major_locator(locator)
    axes.xaxis.set_major_formatter(ConciseDateFormatter(locator))
    axes.set_xlabel("UTC")
