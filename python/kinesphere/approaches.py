"""Every time that two recorded bodies came closer to each other than a distance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Optional

import numpy as np
import numpy.typing as npt

from ._kinesphere import _approaches
from .errors import InvalidValue

if TYPE_CHECKING:
    import pandas as pd

# Factor on the median time between the samples of an id, as in `kinesphere tracks`.
_gap_factor = 2.5
# Coordinates reach to 2**41 tolerances; half of that is reserved for curves that swing out.
_tolerances_in_extent = 2.0**40


class Approaches:
    """Approaches by their begin; each is a row of `array`, with the fields

    first, second: the ids as they were given.
    begin, end: times between which the two were closer than the distance.
    closest_time, closest_distance, first_position, second_position, relative_speed: where they were
    nearest, on their curves; the distance is that of the two points.
    begins_with_track, ends_with_track: they were so close when the track of one of them began, or ended.
    """

    def __init__(self, array: npt.NDArray[np.void], probes: int) -> None:
        self.array = array
        self.probes = probes
        """How many states certainty took."""

    def __len__(self) -> int:
        return len(self.array)

    def __getitem__(self, column: str) -> npt.NDArray[Any]:
        values: npt.NDArray[Any] = self.array[column]
        return values

    def __repr__(self) -> str:
        return f"<{len(self)} approaches>"

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each approach, and a column for each coordinate."""
        import pandas as pd

        columns: dict[str, Any] = {}
        for name in self.array.dtype.names or ():
            column = self[name]
            if column.ndim == 2:
                columns.update({f"{name}_{letter}": column[:, axis] for axis, letter in enumerate("xyz")})
            else:
                columns[name] = column
        return pd.DataFrame(columns)


def tracks(
    t: npt.ArrayLike,
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    z: Optional[npt.ArrayLike],
    id: npt.ArrayLike,
    distance: float,
    *,
    interpolate: Literal["spline", "linear"] = "spline",
    max_gap: Optional[float] = None,
    tolerance: Optional[float] = None,
) -> Approaches:
    """Finds every time that two bodies of a recording were closer to each other than `distance` (length).

    t, x, y, z: shape (n,), a sample in each row, in any order; z is None for motion in a plane. id: shape
    (n,), whole numbers or texts, identifies the body of each sample. Times and coordinates may be large (Unix times,
    UTM): they are calculated from origins near them.

    interpolate: between two samples a body goes along a natural cubic spline, or straight on ("linear").
    max_gap: a longer time between two samples of an id ends its track, and another begins behind; by
    default 2.5 times its median interval, or that of all where it has fewer than 4 samples. A sample
    between two gaps is left out.
    tolerance (length): how exactly the distance is meant; by default a millionth of it, or 2**-40 of the
    extent if that is more.

    Raises InvalidValue for NaN, two samples of an id at one time, and arrays of different lengths.
    """
    times = _column("t", t)
    plane = z is None
    columns = [_column("x", x, len(times)), _column("y", y, len(times))]
    columns.append(np.zeros(len(times)) if z is None else _column("z", z, len(times)))
    names = np.asarray(id)
    if names.shape != times.shape:
        raise _refused("id", f"must have shape {times.shape} as t, but has shape {names.shape}")
    _check_distance(distance)
    if interpolate not in ("spline", "linear"):
        raise _refused("interpolate", f'must be "spline" or "linear", but is {interpolate!r}')

    unique, who = np.unique(names, return_inverse=True)
    time_origin, origin = _origin(times), np.array([_origin(column) for column in columns])
    order = np.lexsort((times, who))
    who, times = who[order], times[order] - time_origin
    positions = np.stack([column[order] for column in columns], axis=1) - origin
    same = np.flatnonzero((np.diff(who) == 0) & (np.diff(times) == 0))
    if len(same) > 0:
        when = times[same[0]] + time_origin
        raise _refused(
            "t", f"must have one sample of each id at a time, but id {unique[who[same[0]]]} has two at {when}"
        )

    starts = _starts(who, times, max_gap)
    kept = np.concatenate([np.zeros(0, dtype=np.int64), *(np.arange(a, b) for a, b in starts)])
    lengths = starts[:, 1] - starts[:, 0]
    extent = float(np.max(np.abs(positions), initial=0.0))
    finest = extent / _tolerances_in_extent
    exactness = max(1e-6 * distance, finest) if tolerance is None else float(tolerance)
    if not finest <= exactness < distance:
        raise _refused(
            "tolerance", f"must be from {finest:.3g} to less than the distance {distance}, but is {exactness}"
        )

    found, probes = _approaches(
        times[kept], positions[kept], np.concatenate([[0], np.cumsum(lengths)]), distance, exactness,
        interpolate == "linear", plane)  # fmt: skip
    return Approaches(_as_given(found, unique[who[starts[:, 0]]], time_origin, origin), probes)


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
    found: npt.NDArray[np.void], ids: npt.NDArray[Any], time_origin: float, origin: npt.NDArray[np.float64]
) -> npt.NDArray[np.void]:
    """With the ids, times and places of the arrays that came."""
    fields = [(name, found.dtype[name]) for name in found.dtype.names or ()]
    fields = [(name, ids.dtype if name in ("first", "second") else kind) for name, kind in fields]
    result: npt.NDArray[np.void] = np.zeros(len(found), dtype=fields)
    for name, _ in fields:
        result[name] = ids[found[name]] if name in ("first", "second") else found[name]
    for name in ("begin", "end", "closest_time"):
        result[name] += time_origin
    for name in ("first_position", "second_position"):
        result[name] += origin
    return result
