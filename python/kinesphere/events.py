"""Many events: a table that NumPy and pandas can work with."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Union, overload

import numpy as np
import numpy.typing as npt

from ._kinesphere import Event, event_dtype
from .kinds import EventKind, Senses, Wall

if TYPE_CHECKING:
    import pandas as pd


class Events(Sequence[Event]):
    """Events in order of delivery: a table with the columns of Event.

    array is a structured array of shape (n,) and type event_dtype: vectors have shape (3,); kind, wall
    and senses are numbers of EventKind, Wall and Senses; second is no_body if there is none.

    Events of one kind: events.of_kind(EventKind.contact_begin); a column: events["time"], shape (n,), or
    (n, 3) for vectors; one Event: events[0]; some Events: events[events["gap"] < 0], events[:10].
    """

    def __init__(self, array: npt.NDArray[np.void]) -> None:
        self.array = array

    def __len__(self) -> int:
        return len(self.array)

    @overload
    def __getitem__(self, key: int) -> Event:
        ...

    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]:
        ...

    @overload
    def __getitem__(self, key: Union[slice, npt.NDArray[Any], list[int]]) -> Events:
        ...

    def __getitem__(self, key: Any) -> Union[Event, Events, npt.NDArray[Any]]:
        if isinstance(key, str):
            column: npt.NDArray[Any] = self.array[key]
            return column
        if isinstance(key, (int, np.integer)):
            return Event._from_record(self.array[int(key)].tobytes())
        return Events(self.array[key])

    def __iter__(self) -> Iterator[Event]:
        for k in range(len(self)):
            yield self[k]

    def __repr__(self) -> str:
        kinds = ", ".join(
            f"{count} {EventKind(k)}" for k, count in enumerate(np.bincount(self["kind"])) if count > 0
        )
        return f"<Events: {kinds}>" if kinds else "<Events: none>"

    def of_kind(self, *kinds: EventKind) -> Events:
        """Those of one of these kinds."""
        return self[np.isin(self["kind"], [int(kind) for kind in kinds])]

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each event: names for numbers, and a column for each coordinate.

        kind, wall and senses are categories; second and wall are missing where there is none;
        "first_position" becomes first_position_x, first_position_y and first_position_z.
        """
        import pandas as pd

        from ._kinesphere import no_body

        def category(column: str, kinds: Any) -> Any:
            return pd.Categorical.from_codes(self[column], categories=[str(kind) for kind in kinds])

        columns: dict[str, Any] = {}
        for name in self.array.dtype.names or ():
            column = self[name]
            if column.ndim == 2:
                for axis, letter in enumerate("xyz"):
                    columns[f"{name}_{letter}"] = column[:, axis]
            else:
                columns[name] = column
        columns["kind"] = category("kind", EventKind)
        columns["senses"] = category("senses", Senses)
        walls = category("wall", Wall)
        columns["wall"] = walls.remove_categories(["none"])
        columns["second"] = pd.array(self["second"], dtype="Int64")
        columns["second"][self["second"] == no_body] = pd.NA
        return pd.DataFrame(columns)
