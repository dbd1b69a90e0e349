"""Many events: tables that NumPy and pandas can work with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar, Union, overload

import numpy as np
import numpy.typing as npt

from ._kinesphere import Event, MonitorEvent, event_dtype, monitor_event_dtype
from .kinds import EventKind, MonitorEventKind, Senses, Verdict, Wall

if TYPE_CHECKING:
    import pandas as pd

Row = TypeVar("Row")
Kind = TypeVar("Kind", bound=IntEnum)


class _Table(Sequence[Row], Generic[Row, Kind]):
    """Rows of a structured array with a column "kind"."""

    _kinds: type[Kind]

    def __init__(self, array: npt.NDArray[np.void]) -> None:
        self.array = array

    @staticmethod
    def _row(record: bytes) -> Row:
        raise NotImplementedError

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

    def of_kind(self, *kinds: Kind) -> Self:
        """Those of one of these kinds."""
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
    """

    _kinds = EventKind
    _row = staticmethod(Event._from_record)

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each event: names for numbers, and a column for each coordinate.

        kind, wall and senses are categories; second and wall are missing where there is none;
        "first_position" becomes first_position_x, first_position_y and first_position_z.
        """
        import pandas as pd

        from ._kinesphere import no_body

        columns: dict[str, Any] = {}
        for name in self.array.dtype.names or ():
            column = self[name]
            if column.ndim == 2:
                for axis, letter in enumerate("xyz"):
                    columns[f"{name}_{letter}"] = column[:, axis]
            else:
                columns[name] = column
        columns["kind"] = self._categories("kind", EventKind)
        columns["senses"] = self._categories("senses", Senses)
        walls = self._categories("wall", Wall)
        columns["wall"] = walls.remove_categories(["none"])
        columns["second"] = pd.array(self["second"], dtype="Int64")
        columns["second"][self["second"] == no_body] = pd.NA
        return pd.DataFrame(columns)


class MonitorEvents(_Table[MonitorEvent, MonitorEventKind]):
    """Events of a monitor, in order: a table with the columns of MonitorEvent, used as Events are.

    array is a structured array of shape (n,) and type monitor_event_dtype: kind, verdict and before are
    numbers of MonitorEventKind and Verdict. Where kind is none of verdict, predicted and prediction_ended,
    second is 0 and of no meaning; verdict and before are of verdicts alone.
    """

    _kinds = MonitorEventKind
    _row = staticmethod(MonitorEvent._from_record)

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
