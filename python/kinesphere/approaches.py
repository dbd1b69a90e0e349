"""Every time that two recorded bodies came closer to each other than a distance."""

from __future__ import annotations

from datetime import timedelta
from typing import TYPE_CHECKING, Any, Literal, Optional, Union, overload

import numpy as np
import numpy.typing as npt

from ._kinesphere import _approaches
from .errors import InvalidValue
from .events import columns_of
from .notebooks import html_of
from .plots import Part, plot_approaches

if TYPE_CHECKING:
    import pandas as pd

# Seconds, or the unit of the times; or a duration.
Duration = Union[float, timedelta, np.timedelta64]
# Factor on the median time between the samples of an id, as in `kinesphere tracks`.
_gap_factor = 2.5
# Coordinates reach to 2**41 tolerances; half of that is reserved for curves that swing out.
_tolerances_in_extent = 2.0**40


class Approaches:
    """Approaches by their begin; each is a row of `array`, with the fields

    first, second: the ids as they were given.
    begin, end: times between which the two were closer than the distance.
    closest_time, closest_distance, first_position, second_position, relative_speed: where they were
    nearest, on their curves; the distance is that of the two points, or of the surfaces where there are radii.
    begins_with_track, ends_with_track: they were so close when the track of one of them began, or ended.
    least_time_to_collision, least_time_at, where there are radii: the least time in which the two would have
    collided if both had gone straight on, infinite where they were on no such course; and when that was, else NaN or NaT.
    post_encroachment_time, time_of_entry, where there are radii: the least time from when one of the two left a place
    until the other entered it, infinite where no place was taken by both; and when that was, else NaN or NaT.

    Times are of the kind that came: numbers, or datetime64[ns] in UTC, and then durations are in seconds. A column:
    approaches["begin"]; some approaches: approaches[approaches["closest_distance"] < 1], approaches[:10].
    """

    def __init__(
        self,
        array: npt.NDArray[np.void],
        probes: int,
        summary: Optional[dict[str, Any]] = None,
        is_geographic: bool = False,
    ) -> None:
        self.array = array
        self.probes = probes
        """How many states certainty took."""
        self.summary = summary
        """Of tracks_in: what was read, and what was not looked at (docs/tracks.md). None of tracks."""
        self.is_geographic = is_geographic
        """Whether positions are degrees of longitude and latitude, and lengths metres: of tracks_in alone."""

    def __len__(self) -> int:
        return len(self.array)

    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]:
        ...

    @overload
    def __getitem__(self, key: Union[slice, npt.NDArray[Any], list[int]]) -> Approaches:
        ...

    def __getitem__(self, key: Any) -> Union[Approaches, npt.NDArray[Any]]:
        if isinstance(key, str):
            values: npt.NDArray[Any] = self.array[key]
            return values
        return Approaches(self.array[key], self.probes, self.summary, self.is_geographic)

    def __repr__(self) -> str:
        return f"<{len(self)} approaches>"

    def _repr_html_(self) -> Optional[str]:
        """In a notebook: the first rows as a table, where pandas is there."""
        return html_of(self, repr(self))

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each approach, and a column for each coordinate."""
        import pandas as pd

        return pd.DataFrame(columns_of(self.array))

    def plot(
        self,
        part: Optional[Part] = None,
        *,
        axes: Any = None,
        tracks: Optional[tuple[npt.ArrayLike, npt.ArrayLike]] = None,
    ) -> Any:
        """Draws where the approaches were, when and how close, and how many were how close; needs matplotlib.

        The three closest have colours, marks and their ids. Lengths have the unit of the tracks; times that are
        dates, or seconds since 1970, are shown as dates and clock times in UTC.

        part: "map", "time" or "histogram" alone; None draws all three beside each other. A map has the two axes along
        which the positions reach farthest.
        axes: where to draw the part; by default a figure of its own.
        tracks: x and y of all samples, two arrays of one shape, drawn beneath the map, whose axes are then x and y.

        Returns the matplotlib Figure. Raises ImportError without matplotlib.
        """
        return plot_approaches(self, part, axes, tracks)


@overload
def tracks(
    t: pd.DataFrame,
    *,
    distance: float,
    columns: Optional[dict[str, str]] = None,
    interpolate: Literal["spline", "linear"] = "spline",
    max_gap: Optional[Duration] = None,
    tolerance: Optional[float] = None,
    radii: Optional[npt.ArrayLike] = None,
) -> Approaches:
    ...


@overload
def tracks(
    t: npt.ArrayLike,
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    z: Optional[npt.ArrayLike],
    id: npt.ArrayLike,
    distance: float,
    *,
    interpolate: Literal["spline", "linear"] = "spline",
    max_gap: Optional[Duration] = None,
    tolerance: Optional[float] = None,
    radii: Optional[npt.ArrayLike] = None,
) -> Approaches:
    ...


@overload
def tracks(
    t: npt.ArrayLike,
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    z: Optional[npt.ArrayLike] = None,
    *,
    id: npt.ArrayLike,
    distance: float,
    interpolate: Literal["spline", "linear"] = "spline",
    max_gap: Optional[Duration] = None,
    tolerance: Optional[float] = None,
    radii: Optional[npt.ArrayLike] = None,
) -> Approaches:
    ...


def tracks(
    t: Any,
    x: Any = None,
    y: Any = None,
    z: Any = None,
    id: Any = None,
    distance: Any = None,
    *,
    columns: Optional[dict[str, str]] = None,
    interpolate: Literal["spline", "linear"] = "spline",
    max_gap: Optional[Duration] = None,
    tolerance: Optional[float] = None,
    radii: Optional[npt.ArrayLike] = None,
) -> Approaches:
    """Finds every time that two bodies of a recording were closer to each other than `distance` (length).

    t, x, y, z: shape (n,), a sample in each row, in any order; z is None for motion in a plane. x, y and z are
    lengths, not degrees. t may be datetime64, of pandas with a time zone, or timedelta64, which counts in
    seconds. id: shape (n,), whole numbers or texts, identifies the body of each
    sample. Times and coordinates may be large (Unix times, UTM): they are calculated from origins near them.

    tracks(frame, distance=...) takes a DataFrame with the columns t, x, y, id and, if there is one, z; columns
    names others: {"t": "timestamp", "id": "ship"}, and also "radii".

    interpolate: between two samples a body goes along a natural cubic spline, or straight on ("linear").
    max_gap: a longer time between two samples of an id ends its track, and another begins behind; seconds or a
    timedelta where t is datetime64; by default 2.5 times its median interval, or that of all where it has fewer
    than 4 samples. A sample between two gaps is left out.
    tolerance (length): how exactly the distance is meant; by default a millionth of it, or 2**-40 of the
    extent if that is more.
    radii (length): one number for all, or of shape (n,), of which each body has the largest: distances are then
    those of surfaces, and the approaches have their times to collision.

    Raises InvalidValue for NaN and NaT, two samples of an id at one time, and arrays of different lengths.
    """
    if hasattr(t, "columns"):
        if x is not None or id is not None:
            raise TypeError("tracks: x, y, z and id must be in the data frame; columns names them")
        t, x, y, z, id, radii = _of_frame(t, columns or {}, radii)
    elif columns is not None:
        raise TypeError("tracks: columns must come with a data frame")
    if distance is None:
        raise TypeError("tracks: distance must be given")
    for name, given in {"t": t, "x": x, "y": y, "z": z, "id": id, "radii": radii}.items():
        if _ma.is_masked(given):
            raise TypeError(f"tracks: {name} must be numbers, but has masked entries: leave their rows out")
    clock, times = _clock_of(t)
    plane = z is None
    coordinates = [_column("x", x, len(times)), _column("y", y, len(times))]
    coordinates.append(np.zeros(len(times)) if z is None else _column("z", z, len(times)))
    names = np.asarray(id)
    if names.shape != times.shape:
        raise _refused("id", f"must have shape {times.shape} as t, but has shape {names.shape}")
    _check_distance(distance)
    if interpolate not in ("spline", "linear"):
        raise _refused("interpolate", f'must be "spline" or "linear", but is {interpolate!r}')

    unique, who = np.unique(names, return_inverse=True)
    sizes = _sizes(radii, who, len(unique))
    origin = np.array([_origin(column) for column in coordinates])
    order = np.lexsort((times, who))
    who, times = who[order], times[order]
    positions = np.stack([column[order] for column in coordinates], axis=1) - origin
    same = np.flatnonzero((np.diff(who) == 0) & (np.diff(times) == 0))
    if len(same) > 0:
        when = clock.given(times[same[:1]])[0]
        raise _refused(
            "t", f"must have one sample of each id at a time, but id {unique[who[same[0]]]} has two at {when}"
        )

    starts = _starts(who, times, None if max_gap is None else _seconds(max_gap))
    kept = np.concatenate([np.zeros(0, dtype=np.int64), *(np.arange(a, b) for a, b in starts)])
    lengths = starts[:, 1] - starts[:, 0]
    extent = float(np.max(np.abs(positions), initial=0.0))
    finest = extent / _tolerances_in_extent
    exactness = max(1e-6 * distance, finest) if tolerance is None else float(tolerance)
    if not finest <= exactness < distance:
        raise _refused(
            "tolerance", f"must be from {finest:.3g} to less than the distance {distance}, but is {exactness}"
        )

    tracked = who[starts[:, 0]]
    found, probes = _approaches(
        times[kept], positions[kept], np.concatenate([[0], np.cumsum(lengths)]),
        None if sizes is None else sizes[tracked], distance, exactness, interpolate == "linear", plane)  # fmt: skip
    return Approaches(_as_given(found, unique[tracked], clock, origin, sizes is not None), probes)


class _Clock:
    """The origin of times, and their kind."""

    def __init__(self, origin: Any, is_date: bool) -> None:
        self._origin, self._is_date = origin, is_date

    def given(self, times: npt.NDArray[np.float64]) -> npt.NDArray[Any]:
        """Times as they came, from seconds since the origin."""
        if not self._is_date:
            numbers: npt.NDArray[Any] = times + self._origin
            return numbers
        with np.errstate(invalid="ignore"):  # NaN is NaT
            dates: npt.NDArray[Any] = self._origin + np.rint(times * 1e9).astype("timedelta64[ns]")
        return dates


def _clock_of(t: Any) -> tuple[_Clock, npt.NDArray[np.float64]]:
    """Times as seconds since an origin near their middle, from which differences are exact."""
    if getattr(getattr(t, "dt", None), "tz", None) is not None:
        t = t.dt.tz_convert(None)
    elif getattr(t, "tz", None) is not None:
        t = t.tz_convert(None)
    array = np.asarray(t)
    if array.dtype.kind in "OUS" and array.size > 0:
        raise TypeError(
            f"tracks: t must be numbers, datetime64 or timedelta64, but is an array of {array.dtype}: "
            "pandas.to_datetime makes dates of texts"
        )
    if array.dtype.kind == "m":
        t = array / np.timedelta64(1, "s")
    if array.dtype.kind != "M":
        times = _column("t", t)
        origin = _origin(times)
        return _Clock(origin, False), times - origin
    if array.ndim != 1:
        raise _refused("t", f"must have shape (n,), but has shape {array.shape}")
    if np.isnat(array).any():
        raise _refused("t", f"must be times, but is NaT at {np.flatnonzero(np.isnat(array))[0]}")
    dates = array.astype("datetime64[ns]")
    middle = dates.min() + (dates.max() - dates.min()) // 2 if len(dates) > 0 else np.datetime64(0, "ns")
    return _Clock(middle, True), (dates - middle).astype(np.int64) / 1e9


def _seconds(duration: Duration) -> float:
    if isinstance(duration, (timedelta, np.timedelta64)):
        return float(np.timedelta64(duration) / np.timedelta64(1, "s"))
    return float(duration)


_names_of_degrees = ("lon", "lng", "long", "longitude", "lat", "latitude")


def _of_frame(frame: Any, columns: dict[str, str], radii: Any) -> tuple[Any, ...]:
    """The columns of a data frame: t, x, y, z, id and radii."""
    unknown = set(columns) - {"t", "x", "y", "z", "id", "radii"}
    if unknown:
        raise _refused(
            "columns", f"must name t, x, y, z, id and radii, but names {', '.join(sorted(unknown))}"
        )
    found = []
    degrees = [one for one in frame.columns if str(one).lower() in _names_of_degrees]
    for name in ("t", "x", "y", "z", "id"):
        column = columns.get(name, name)
        if name in ("x", "y") and (column in degrees or (column not in frame.columns and degrees)):
            raise _refused(
                "columns",
                f"must name lengths as x and y, but {degrees[0]!r} has degrees: project them first, as pyproj "
                "does, or give tracks_in a file with them",
            )
        if column in frame.columns:
            found.append(frame[column])
        elif name == "z" and name not in columns:
            found.append(None)
        else:
            there = ", ".join(str(one) for one in frame.columns)
            raise _refused("columns", f"must say which is {name}, as there is no {column!r} among {there}")
    if "radii" in columns:
        if columns["radii"] not in frame.columns:
            raise _refused("columns", f"must say which is radii, but there is no {columns['radii']!r}")
        radii = frame[columns["radii"]]
    return *found, radii


def _sizes(radii: Any, who: npt.NDArray[Any], bodies: int) -> Optional[npt.NDArray[np.float64]]:
    """The radius of each body."""
    if radii is None:
        return None
    of_samples = np.full(len(who), float(radii)) if np.ndim(radii) == 0 else _column("radii", radii, len(who))
    if not (np.isfinite(of_samples) & (of_samples >= 0)).all():
        raise _refused("radii", "must be finite and >= 0")
    sizes = np.zeros(bodies)
    np.maximum.at(sizes, who, of_samples)
    return sizes


_ma: Any = np.ma  # its functions have no types


def _refused(argument: str, why: str) -> InvalidValue:
    return InvalidValue(f"tracks: {argument} {why}", "out_of_range", argument)


def _check_distance(distance: float) -> None:
    if not (distance > 0 and np.isfinite(distance)):
        raise _refused("distance", f"must be finite and > 0, but is {distance}")


def _column(name: str, values: npt.ArrayLike, count: Optional[int] = None) -> npt.NDArray[np.float64]:
    array = np.asarray(values)
    if array.dtype.kind not in "fiu" and array.size > 0:
        raise TypeError(f"tracks: {name} must be real numbers, but is an array of {array.dtype}")
    if array.ndim != 1 or (count is not None and len(array) != count):
        expected = "(n,)" if count is None else f"({count},) as t"
        raise _refused(name, f"must have shape {expected}, but has shape {array.shape}")
    numbers = array.astype(np.float64)
    if not np.isfinite(numbers).all():
        raise _refused(name, f"must be finite, but is not at {np.flatnonzero(~np.isfinite(numbers))[0]}")
    return numbers


def _origin(column: npt.NDArray[np.float64]) -> float:
    """A whole number near the middle, from which differences are exact."""
    return float(np.rint((column.min() + column.max()) / 2)) if len(column) > 0 else 0.0


def _lower_median(intervals: npt.NDArray[np.float64]) -> float:
    if len(intervals) == 0:
        return 0.0
    middle = (len(intervals) - 1) // 2
    return float(np.partition(intervals, middle)[middle])


def _starts(
    who: npt.NDArray[Any], times: npt.NDArray[np.float64], max_gap: Optional[float]
) -> npt.NDArray[np.int64]:
    """Begin and end of the samples of each track, which has two at least."""
    intervals, goes_on = np.diff(times), np.diff(who) == 0
    if max_gap is not None:
        limits = np.full(len(intervals), float(max_gap))
    else:
        of_all = _lower_median(intervals[goes_on])
        edges = np.flatnonzero(np.concatenate([[True], ~goes_on, [True]]))
        limits = np.zeros(len(intervals))
        for a, b in zip(edges[:-1], edges[1:]):
            limits[a : b - 1] = _gap_factor * (_lower_median(intervals[a : b - 1]) if b - a >= 4 else of_all)
    cuts = np.flatnonzero(~goes_on | (intervals > limits)) + 1
    edges = np.concatenate([[0], cuts, [len(times)]]).astype(np.int64)
    pieces = np.stack([edges[:-1], edges[1:]], axis=1)
    longer: npt.NDArray[np.int64] = pieces[pieces[:, 1] - pieces[:, 0] >= 2]
    return longer


def _as_given(
    found: npt.NDArray[np.void],
    ids: npt.NDArray[Any],
    clock: _Clock,
    origin: npt.NDArray[np.float64],
    with_sizes: bool,
) -> npt.NDArray[np.void]:
    """With the ids, times and places of the arrays that came."""
    columns: dict[str, npt.NDArray[Any]] = {}
    for name in found.dtype.names or ():
        if name in ("first", "second"):
            columns[name] = ids[found[name]]
        elif name in ("begin", "end", "closest_time", "least_time_at", "time_of_entry"):
            columns[name] = clock.given(found[name])
        elif name in ("first_position", "second_position"):
            columns[name] = found[name] + origin
        else:
            columns[name] = found[name]
    if not with_sizes:
        for name in ("least_time_to_collision", "least_time_at", "post_encroachment_time", "time_of_entry"):
            del columns[name]
    fields: list[Any] = [(name, column.dtype, column.shape[1:]) for name, column in columns.items()]
    result: npt.NDArray[np.void] = np.zeros(len(found), dtype=fields)
    for name, column in columns.items():
        result[name] = column
    return result
