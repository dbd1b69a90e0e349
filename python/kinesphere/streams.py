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

from .notebooks import compact_html, shown_rows
from .plots import least_unix_time
from .programs import PathLike, run_program

if TYPE_CHECKING:
    import pandas as pd

_fields_of_times = (
    "time",
    "since",
    "until",
    "closest_time",
    "likely_time",
    "ask_by",
    "avoidable_until",
    "inevitable_by",
)
_header = ("time", "what", "who", "distance", "closest")
_not_here = {"serve", "snapshot", "snapshot_every", "alerts", "text", "quiet", "summary"}


class Alerts(Sequence[dict[str, Any]]):
    """Alerts in the order in which they were told, each a dict with the fields of docs/watch.md (Alerts).

    alerts["closest_distance"] is a column: numbers with NaN where an alert has none, else objects with None.
    alerts.of("predicted", "verdict") are those of these events. print(alerts) and notebooks show who came how near to
    whom, with names where the stream has them and dates where its times are dates or seconds since 1970 (in UTC).
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
        return f"<{len(self)} alert{'s' * (len(self) != 1)}>"

    def __str__(self) -> str:
        """A line for each alert: when, what, who, the limits of the distance and the closest approach."""
        rows = [_text_of(row) for row in self.rows]
        widths = [max((len(row[k]) for row in rows), default=0) for k in range(len(_header))]
        return "\n".join("  ".join(map(str.ljust, row, widths)).rstrip() for row in rows) or repr(self)

    def of(self, *events: str) -> Alerts:
        """The alerts whose event is one of these."""
        return Alerts([row for row in self.rows if row["event"] in events], self.summary)

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each alert; columns of dates and of seconds since 1970 are datetime64[ns]."""
        import pandas as pd

        frame = pd.DataFrame(self.rows)
        for name in _fields_of_times:
            if name in frame and _have_dates(frame[name]):
                frame[name] = pd.Series([_date_of(value) for value in frame[name]], dtype="datetime64[ns]")
        return frame

    def _repr_html_(self) -> str:
        """In a notebook: the first alerts as print() shows them."""
        return compact_html(repr(self), _header, map(_text_of, self.rows[:shown_rows]), len(self))


def _date_of(value: Any) -> np.datetime64:
    """A date, or seconds since 1970; NaT for None."""
    if isinstance(value, str):
        return np.datetime64(value.removesuffix("Z"), "ns")
    known = value is not None and value == value
    return np.datetime64(round(value * 1e9) // 1000 * 1000 if known else "NaT", "ns")


def _have_dates(values: Iterable[Any]) -> bool:
    """Whether all times of a column are dates or seconds since 1970."""
    known = [value for value in values if value is not None and value == value]
    return bool(known) and all(isinstance(value, str) or value >= least_unix_time for value in known)


def _clock(value: Any) -> str:
    return (
        str(_date_of(value).astype("datetime64[s]")).replace("T", " ")
        if _have_dates([value])
        else f"{value:.1f}"
    )


def _length(value: float) -> str:
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.4g}"


def _text_of(row: dict[str, Any]) -> tuple[str, ...]:
    """When, what, who, the limits of the distance and the closest approach of an alert."""
    event, verdict = row["event"], row.get("verdict")
    if event == "verdict":
        event = "over" if verdict == "apart" and row.get("before") == "within" else verdict
    elif event == "prediction_ended":
        event = "over"
    names = [str(row.get(f"{one}_name") or row[one]) for one in ("first", "second", "track") if one in row]
    lost = f", {names[2]} is lost" if len(names) == 3 else ""
    limits, closest = row.get("distance"), row.get("closest_distance")
    distance = f"{_length(limits[0])} to {_length(limits[1])}" if limits and None not in limits else ""
    when = row.get("closest_time")
    approach = f"{_length(closest)} at {_clock(when)}" if closest is not None and when is not None else ""
    return _clock(row["time"]), event.replace("_", " "), " and ".join(names[:2]) + lost, distance, approach


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
