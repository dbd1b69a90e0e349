"""Many events: tables that NumPy and pandas can work with."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Generic, Optional, Self, TypeVar, Union, overload

import numpy as np
import numpy.typing as npt

from ._kinesphere import Event, MonitorEvent, event_dtype, monitor_event_dtype
from .errors import InvalidValue
from .kinds import EventKind, MonitorEventKind, Senses, Verdict, Wall
from .notebooks import html_of
from .plots import Part, plot_events

if TYPE_CHECKING:
    import pandas as pd

Row = TypeVar("Row")
Kind = TypeVar("Kind", bound=IntEnum)


def columns_of(array: npt.NDArray[np.void]) -> dict[str, Any]:
    """The columns of a structured array by their names, one for each coordinate."""
    columns: dict[str, Any] = {}
    for name in array.dtype.names or ():
        column = array[name]
        if column.ndim == 2:
            columns.update({f"{name}_{letter}": column[:, axis] for axis, letter in enumerate("xyz")})
        else:
            columns[name] = column
    return columns


class _Table(Sequence[Row], Generic[Row, Kind]):
    """Rows of a structured array with a column "kind"."""

    _kinds: type[Kind]
    _dtype: np.dtype[np.void]

    def __init__(self, rows: Union[npt.NDArray[np.void], Iterable[Row]] = ()) -> None:
        """rows: a structured array with these columns, such as one that np.load() has read; or single rows."""
        if not isinstance(rows, np.ndarray):
            records = [self._record(row) for row in rows]
            self.array: npt.NDArray[np.void] = np.zeros(len(records), dtype=self._dtype)
            if records:
                self.array[:] = np.frombuffer(b"".join(records), dtype=self._dtype)
        elif rows.dtype == self._dtype:
            self.array = rows
        elif rows.dtype.names is not None and set(rows.dtype.names) == set(self._dtype.names or ()):
            self.array = np.zeros(rows.shape, dtype=self._dtype)
            for name in rows.dtype.names:
                self.array[name] = rows[name]
        else:
            name = type(self).__name__
            raise InvalidValue(
                f"{name}: rows must be an array with the columns of {name}, but is one of {rows.dtype}",
                "out_of_range",
                "rows",
            )

    def __setstate__(self, state: dict[str, Any]) -> None:
        # A pickle of another version may have other columns, or another layout.
        self.array = type(self)(state["array"]).array

    @staticmethod
    def _row(record: bytes) -> Row:
        raise NotImplementedError

    @staticmethod
    def _record(row: Row) -> bytes:
        raise NotImplementedError

    def __add__(self, other: Self) -> Self:
        """All rows of both, in this order; sum(parts, Events()) puts many together."""
        if type(other) is not type(self):
            return NotImplemented
        # np.concatenate() would pack the rows.
        array: npt.NDArray[np.void] = np.zeros(len(self) + len(other), dtype=self._dtype)
        array[: len(self)], array[len(self) :] = self.array, other.array
        return type(self)(array)

    def __len__(self) -> int:
        return len(self.array)

    @overload
    def __getitem__(self, key: int) -> Row:
        ...

    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]:
        ...

    @overload
    def __getitem__(self, key: Union[slice, npt.NDArray[Any], list[int]]) -> Self:
        ...

    def __getitem__(self, key: Any) -> Union[Row, Self, npt.NDArray[Any]]:
        if isinstance(key, str):
            column: npt.NDArray[Any] = self.array[key]
            return column
        if isinstance(key, (int, np.integer)):
            return self._row(self.array[int(key)].tobytes())
        return type(self)(self.array[key])

    def __iter__(self) -> Iterator[Row]:
        for k in range(len(self)):
            yield self[k]

    def __repr__(self) -> str:
        kinds = ", ".join(
            f"{count} {self._kinds(k)}" for k, count in enumerate(np.bincount(self["kind"])) if count > 0
        )
        name = type(self).__name__
        return f"<{name}: {kinds}>" if kinds else f"<{name}: none>"

    def to_pandas(self) -> pd.DataFrame:
        raise NotImplementedError

    def _repr_html_(self) -> Optional[str]:
        """In a notebook: the first rows as a table, where pandas is there."""
        return html_of(self, repr(self))

    def of_kind(self, *kinds: Kind) -> Self:
        """Those of one of these kinds."""
        for kind in kinds:
            if not isinstance(kind, (int, np.integer)):
                known = f"{type(self)._kinds.__name__}.{next(iter(type(self)._kinds)).name}"
                raise TypeError(f"of_kind: kinds must be members such as {known}, but one is {kind!r}")
        return self[np.isin(self["kind"], [int(kind) for kind in kinds])]

    def _categories(self, column: str, kinds: type[IntEnum]) -> Any:
        import pandas as pd

        return pd.Categorical.from_codes(self[column], categories=[str(kind) for kind in kinds])


class Events(_Table[Event, EventKind]):
    """Events in order of delivery: a table with the columns of Event.

    array is a structured array of shape (n,) and type event_dtype: vectors have shape (3,); kind, wall
    and senses are numbers of EventKind, Wall and Senses; second is no_body if there is none.

    Events of one kind: events.of_kind(EventKind.contact_begin); a column: events["time"], shape (n,), or
    (n, 3) for vectors; one Event: events[0]; some Events: events[events["gap"] < 0], events[:10].
    Events(array) and Events([event, ...]) make a table; first + second has the rows of both.
    """

    _kinds = EventKind
    _dtype = event_dtype
    _row = staticmethod(Event._from_record)
    _record = staticmethod(Event._to_record)

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each event: names for numbers, and a column for each coordinate.

        kind, wall and senses are categories; second and wall are missing where there is none;
        "first_position" becomes first_position_x, first_position_y and first_position_z.
        """
        import pandas as pd

        from ._kinesphere import no_body

        columns = columns_of(self.array)
        columns["kind"] = self._categories("kind", EventKind)
        columns["senses"] = self._categories("senses", Senses)
        walls = self._categories("wall", Wall)
        columns["wall"] = walls.remove_categories(["none"])
        columns["second"] = pd.array(self["second"], dtype="Int64")
        columns["second"][self["second"] == no_body] = pd.NA
        return pd.DataFrame(columns)

    def plot(self, part: Optional[Part] = None, *, axes: Any = None) -> Any:
        """Draws where events were, how many there were up to each time, and how fast contacts were; needs matplotlib.

        part: "map", "time" or "histogram" alone; None draws all three beside each other. A map has the two axes along
        which the points reach farthest.
        axes: where to draw the part; by default a figure of its own.

        Returns the matplotlib Figure. Raises ImportError without matplotlib.
        """
        return plot_events(self, part, axes)


class MonitorEvents(_Table[MonitorEvent, MonitorEventKind]):
    """Events of a monitor, in order: a table with the columns of MonitorEvent, used as Events are.

    array is a structured array of shape (n,) and type monitor_event_dtype: kind, verdict and before are
    numbers of MonitorEventKind and Verdict. Where kind is none of verdict, predicted and prediction_ended,
    second is 0 and of no meaning; verdict and before are of verdicts alone.
    """

    _kinds = MonitorEventKind
    _dtype = monitor_event_dtype
    _row = staticmethod(MonitorEvent._from_record)
    _record = staticmethod(MonitorEvent._to_record)

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each event: names for numbers, and nothing where a column has no meaning."""
        import pandas as pd

        columns: dict[str, Any] = {name: self[name] for name in self.array.dtype.names or ()}
        columns["kind"] = self._categories("kind", MonitorEventKind)
        of_pair = self["kind"] <= MonitorEventKind.prediction_ended
        columns["second"] = pd.array(self["second"], dtype="UInt64")
        columns["second"][~of_pair] = pd.NA
        frame = pd.DataFrame(columns)
        is_verdict = self["kind"] == MonitorEventKind.verdict
        for column in ("verdict", "before"):
            frame[column] = self._categories(column, Verdict)
            frame.loc[~is_verdict, column] = None
        return frame
