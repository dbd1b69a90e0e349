"""Separation in recorded streams of reports, which the program `kinesphere` watches."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Optional, Union, overload

import numpy as np
import numpy.typing as npt

from .events import html_of
from .programs import PathLike, run_program

if TYPE_CHECKING:
    import pandas as pd

_not_here = {"serve", "snapshot", "snapshot_every", "alerts", "text", "quiet", "summary"}


class Alerts(Sequence[dict[str, Any]]):
    """Alerts in the order in which they were told, each a dict with the fields of docs/watch.md (Alerts).

    alerts["closest_distance"] is a column: numbers with NaN where an alert has none, else objects with None.
    alerts.of("predicted", "verdict") are those of these events.
    """

    def __init__(self, rows: list[dict[str, Any]], summary: dict[str, Any]) -> None:
        self.rows = rows
        self.summary = summary
        """What was read and told, as `kinesphere watch --summary` has it."""

    def __len__(self) -> int:
        return len(self.rows)

    @overload
    def __getitem__(self, key: int) -> dict[str, Any]:
        ...

    @overload
    def __getitem__(self, key: slice) -> Alerts:
        ...

    @overload
    def __getitem__(self, key: str) -> npt.NDArray[Any]:
        ...

    def __getitem__(self, key: Union[int, slice, str]) -> Any:
        if isinstance(key, slice):
            return Alerts(self.rows[key], self.summary)
        if not isinstance(key, str):
            return self.rows[key]
        values = [row.get(key) for row in self.rows]
        if self.rows and not any(key in row for row in self.rows):
            raise KeyError(key)
        if all(value is None or type(value) in (int, float) for value in values):
            return np.array(values, dtype=np.float64)
        column = np.empty(len(values), dtype=object)
        column[:] = values
        return column

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def __repr__(self) -> str:
        return f"<{len(self)} alerts>"

    def of(self, *events: str) -> Alerts:
        """The alerts whose event is one of these."""
        return Alerts([row for row in self.rows if row["event"] in events], self.summary)

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each alert."""
        import pandas as pd

        return pd.DataFrame(self.rows)

    def _repr_html_(self) -> Optional[str]:
        """In a notebook: the first rows as a table, where pandas is there."""
        return html_of(self, repr(self))


def watch(
    stream: Union[PathLike, Iterable[Union[str, bytes]]],
    separation: Union[str, Sequence[str]],
    *,
    program: Optional[PathLike] = None,
    **options: Any,
) -> Alerts:
    """Who comes too near to whom in a recorded stream of reports: the alerts of `kinesphere watch`.

    stream: a file, or its lines: readsb, SBS, OpenSky, AIS, tables or JSON lines. separation: what is watched
    for, such as "cylinder:5NM:1000ft" or "sphere:0.5NM:12min"; or several. All other options are those of the
    program of that name, with _ for -: own="211000001", acceleration=5, only=["within", "lost"],
    no_classes=True (`kinesphere watch --help`, docs/watch.md).
    program: where it is, if not in PATH.

    It reads the stream to its end; a Monitor watches one that goes on. Raises InvalidValue with the program's
    question or error, FileNotFoundError without the program; what the program warns about becomes a warning.
    """
    for name in _not_here & options.keys():
        raise TypeError(f"watch: {name} must not be given: it is an option of the program alone")
    file: PathLike = "-"
    lines: Optional[bytes] = None
    if isinstance(stream, (str, os.PathLike)):
        file = stream
    else:
        lines = b"\n".join(line.encode() if isinstance(line, str) else line for line in stream) + b"\n"
    wanted = [separation] if isinstance(separation, str) else list(separation)
    with tempfile.TemporaryDirectory() as folder:
        summary = Path(folder) / "summary.json"
        options = {**options, "separation": wanted, "summary": summary}
        told = run_program(
            "watch", program, "watch", options, [file], argument="stream", standard_input=lines
        )
        return Alerts([json.loads(line) for line in told.splitlines()], json.loads(summary.read_text()))
