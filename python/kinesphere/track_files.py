"""Approaches in files of recorded motion, which the program `kinesphere` reads."""

from __future__ import annotations

import csv
import json
import os
import tempfile
from pathlib import Path
from typing import Any, Literal, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from .approaches import Approaches
from .programs import PathLike, run_program


def tracks_in(
    files: Union[PathLike, Sequence[PathLike]],
    distance: Union[float, str, None] = None,
    *,
    separation: Optional[str] = None,
    format: Optional[str] = None,
    columns: Optional[str] = None,
    where: Optional[str] = None,
    dates: Optional[Literal["day-first", "month-first"]] = None,
    frame_rate: Optional[float] = None,
    time_unit: Optional[Literal["s", "ms", "us", "ns", "min", "h", "d", "frames", "clock"]] = None,
    unit: Optional[Literal["m", "km", "cm", "mm", "um", "ft", "nmi", "yd", "mi", "deg"]] = None,
    positions: Optional[str] = None,
    projection: Literal["auto", "plane", "earth"] = "auto",
    altitude: Literal["barometric", "geometric"] = "barometric",
    missing: Literal["fail", "skip", "split"] = "fail",
    duplicates: Literal["fail", "first", "mean"] = "fail",
    max_speed: Optional[float] = None,
    max_gap: Optional[float] = None,
    plan: bool = False,
    interpolate: Optional[Literal["spline", "linear"]] = None,
    outside: Literal["vanish", "stay", "go-on"] = "vanish",
    tolerance: Optional[float] = None,
    error: Optional[str] = None,
    largest_speed: Optional[str] = None,
    acceleration: Optional[str] = None,
    sizes: bool = False,
    heading: Optional[Literal["motion", "x-axis", "compass"]] = None,
    same: Union[str, Sequence[str], Mapping[str, str], None] = None,
    ignore: Union[str, Sequence[str], None] = None,
    count_handovers: bool = False,
    ground: Union[float, str, None] = None,
    from_: Union[float, str, None] = None,
    until: Union[float, str, None] = None,
    only: Union[str, int, Sequence[Union[str, int]], None] = None,
    min_duration: Optional[float] = None,
    program: Optional[PathLike] = None,
) -> Approaches:
    """Finds every time that two bodies recorded in text files were closer to each other than `distance`.

    It starts the program `kinesphere tracks`, so that files mean what they mean to it (docs/tables.md): columns
    and units by their names, files of known tools, GPX, XYZ and dumps of LAMMPS, sentences of AIS, and messages
    of receivers of ADS-B.

    files: one or several; an id goes on from one to the next. distance: in metres, or in the file's lengths
    where their unit is not known; a text may have a unit, as "5NM". separation: instead of a distance, as
    "cylinder:5NM:1000ft"; approaches then have horizontal_distance and vertical_distance, too.
    error: how far positions may be off, at samples and for each second from the nearest one, as "10m:2m/s"; approaches
    are then possible ones, and "certain" says which are certain.
    largest_speed, acceleration: what bodies keep between their samples, as "20kt" and "2m/s2"; both bound how far they
    may be from the straight way, which they then go.
    sizes: distances are between bodies as wide, long and tall as the file says, which are turned as its headings or their
    motion say; heading: what headings count from, if that shows it not. from_, until: a window of time, as
    numbers or dates of the file. only: approaches of this id, or of these. min_duration: in seconds.
    format: a known tool, such as "movebank", where the header does not tell it. columns: which column is what,
    as "id=who,time=3:ms,x=east,y=north,z=up:ft". where: the rows that count, as "id != -1 and speed < 40".
    dates: what 03/04/2025 begins with. frame_rate: frames per second. time_unit, unit: of numbers whose column
    does not say it. positions: what x and y are: "plane", "lonlat", or a zone as "utm:33N". altitude: which one
    is the height of aircraft in messages.
    plan: rows are waypoints, between which ways go straight on however far apart these are. interpolate: "spline",
    or in a plan "linear", when not given. outside: before its first and after its last sample a body is not there,
    stays at that sample, or goes straight on.
    same: ids that are other ids, as {"17": "18"} or "17=18". ignore: ids to leave out. Both may be "@FILE".
    All others are the options of the program of that name (docs/tracks.md).
    program: where it is, if not in PATH.

    Ids are texts. Times are numbers of the file's unit, or datetime64 (in UTC where the file says a zone);
    frames are seconds since frame 0. first_before, first_after, second_before and second_after are the times of the
    samples between which closest_time lies, and samples_apart the longer of the two times between them, in seconds.
    Positions are those of the file, with NaN as z of motion in a plane.

    The result's summary is what `kinesphere tracks --summary` writes: what was read, and what was not looked at, as
    "not_looked_at_s" of the seconds "together_s" that pairs are there together, "pairs_never_looked_at" and
    "ids_without_track". A warning tells it where it is much, or where no approach is found.

    Raises InvalidValue with the program's question or error, FileNotFoundError without the program; what the
    program warns about becomes a warning.
    """
    if (distance is None) == (separation is None):
        raise TypeError("tracks_in: either distance or separation must be given")
    names = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    ids = only if only is None or isinstance(only, (str, int)) else ",".join(map(str, only))
    joined = [f"{one}={other}" for one, other in same.items()] if isinstance(same, Mapping) else same
    options: dict[str, Any] = {
        "format": format, "columns": columns, "where": where, "dates": dates, "frame_rate": frame_rate,
        "time_unit": time_unit, "unit": unit, "positions": positions, "projection": projection,
        "altitude": altitude, "missing": missing, "duplicates": duplicates, "max_speed": max_speed,
        "max_gap": max_gap, "plan": plan, "interpolate": interpolate, "outside": outside, "tolerance": tolerance, "error": error, "largest_speed": largest_speed, "acceleration": acceleration, "sizes": sizes,
        "heading": heading,
        "same": joined, "ignore": ignore, "count_handovers": count_handovers, "ground": ground,
        "from": from_, "until": until, "only": ids, "min_duration": min_duration,
        "distance": distance, "separation": separation,
    }  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        table, written = Path(folder) / "approaches.csv", Path(folder) / "summary.json"
        options |= {"contacts": table, "summary": written, "quiet": True}
        run_program("tracks_in", program, "tracks", options, names, argument="files")
        with table.open(newline="") as lines:
            reader = csv.DictReader(lines)
            rows = list(reader)
        summary = json.loads(written.read_text())
    is_geographic = "distance_m" in (reader.fieldnames or ())
    return Approaches(_array_of(rows), summary["probes"], summary, is_geographic)


def _array_of(rows: list[dict[str, str]]) -> npt.NDArray[np.void]:
    def text(name: str) -> list[str]:
        return [row[name] for row in rows]

    def numbers(name: str) -> npt.NDArray[np.float64]:
        """Of a column whose name may have a unit behind it."""
        return np.array(
            [
                float(
                    row.get(name)
                    or row.get(f"{name}_m")
                    or row.get(f"{name}_mps")
                    or row.get(f"{name}_s")
                    or "nan"
                )
                for row in rows
            ]
        )

    def place(of: str) -> npt.NDArray[np.float64]:
        return np.stack([numbers(f"{of}_{axis}") for axis in "xyz"], axis=1)

    times = {name: _times(text(name)) for name in ("begin", "end", "closest_time")}
    columns: dict[str, npt.NDArray[Any]] = {
        "first": np.array(text("first"), dtype=str),
        "second": np.array(text("second"), dtype=str),
        "begin": times["begin"],
        "end": times["end"],
        "begins_with_track": np.array([value == "true" for value in text("begins_with_track")]),
        "ends_with_track": np.array([value == "true" for value in text("ends_with_track")]),
        "closest_time": times["closest_time"],
        "closest_distance": numbers("distance"),
        "first_position": place("first"),
        "second_position": place("second"),
        "relative_speed": numbers("relative_speed"),
    }
    for name in ("first_before", "first_after", "second_before", "second_after"):
        columns[name] = _times(text(name))
    columns["samples_apart"] = numbers("samples_apart")
    for name in ("horizontal_distance", "vertical_distance"):
        if rows and {name, f"{name}_m"} & rows[0].keys():
            columns[name] = numbers(name)
    if rows and "certain" in rows[0]:
        columns["certain"] = np.array([value == "true" for value in text("certain")])
    kinds: list[Any] = [(name, column.dtype, column.shape[1:]) for name, column in columns.items()]
    array: npt.NDArray[np.void] = np.zeros(len(rows), dtype=kinds)
    for name, column in columns.items():
        array[name] = column
    return array


def _times(texts: list[str]) -> npt.NDArray[Any]:
    """Numbers, or dates: all are of one kind, and what is empty is NaN or NaT."""
    try:
        return np.array([float(text or "nan") for text in texts])
    except ValueError:
        return np.array([text.removesuffix("Z") or "NaT" for text in texts], dtype="datetime64[ns]")
