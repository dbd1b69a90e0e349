"""Approaches in files of recorded motion, which the program `kinesphere` reads."""

from __future__ import annotations

import csv
import os
import re
import shutil
import subprocess
import tempfile
import warnings
from pathlib import Path
from typing import Any, Literal, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from .approaches import Approaches
from .errors import InvalidValue

PathLike = Union[str, "os.PathLike[str]"]


def tracks_in(
    files: Union[PathLike, Sequence[PathLike]],
    distance: Union[float, str],
    *,
    format: Optional[str] = None,
    columns: Optional[str] = None,
    where: Optional[str] = None,
    dates: Optional[Literal["day-first", "month-first"]] = None,
    frame_rate: Optional[float] = None,
    time_unit: Optional[Literal["s", "ms", "us", "ns", "min", "h", "d", "frames"]] = None,
    unit: Optional[Literal["m", "km", "cm", "mm", "um", "ft", "nmi", "yd", "mi", "deg"]] = None,
    positions: Optional[str] = None,
    projection: Literal["auto", "plane", "earth"] = "auto",
    missing: Literal["fail", "skip", "split"] = "fail",
    duplicates: Literal["fail", "first", "mean"] = "fail",
    max_speed: Optional[float] = None,
    max_gap: Optional[float] = None,
    interpolate: Literal["spline", "linear"] = "spline",
    tolerance: Optional[float] = None,
    program: Optional[PathLike] = None,
) -> Approaches:
    """Finds every time that two bodies recorded in text files were closer to each other than `distance`.

    It starts the program `kinesphere tracks`, so that files mean what they mean to it (docs/tables.md): columns
    and units by their names, files of known tools, GPX, XYZ and dumps of LAMMPS.

    files: one or several; an id goes on from one to the next. distance: in metres, or in the file's lengths
    where their unit is not known; a text may have a unit, as "5NM".
    format: a known tool, such as "movebank", where the header does not tell it. columns: which column is what,
    as "id=who,time=3:ms,x=east,y=north,z=up:ft". where: the rows that count, as "id != -1 and speed < 40".
    dates: what 03/04/2025 begins with. frame_rate: frames per second. time_unit, unit: of numbers whose column
    does not say it. positions: what x and y are: "plane", "lonlat", or a zone as "utm:33N".
    All others are the options of the program of that name (docs/tracks.md).
    program: where it is, if not in PATH.

    Ids are texts. Times are numbers of the file's unit, or datetime64 (in UTC where the file says a zone);
    frames are seconds since frame 0. Positions are those of the file, with NaN as z of motion in a plane.

    Raises InvalidValue with the program's question or error, FileNotFoundError without the program; what the
    program warns about becomes a warning.
    """
    where_it_is = program if program is not None else shutil.which("kinesphere")
    if where_it_is is None:
        raise FileNotFoundError(
            "tracks_in: there is no program `kinesphere` in PATH, so program must say where it is"
        )
    names = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    options = {
        "format": format, "columns": columns, "where": where, "dates": dates, "frame-rate": frame_rate,
        "time-unit": time_unit, "unit": unit, "positions": positions, "projection": projection, "missing": missing,
        "duplicates": duplicates, "max-speed": max_speed, "max-gap": max_gap, "interpolate": interpolate,
        "tolerance": tolerance, "distance": distance,
    }  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "approaches.csv"
        command = [os.fspath(where_it_is), "tracks", f"--contacts={table}"]
        command += [f"--{name}={value}" for name, value in options.items() if value is not None]
        command += ["--", *(os.path.abspath(name) for name in names)]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode != 0:
            raise InvalidValue(
                f"tracks_in: {run.stderr.strip().removeprefix('kinesphere: ')}", "out_of_range", "files"
            )
        for line in run.stderr.splitlines():
            if line.startswith("kinesphere: warning: "):
                warnings.warn(line.removeprefix("kinesphere: warning: "), stacklevel=2)
        with table.open(newline="") as lines:
            rows = list(csv.DictReader(lines))
    probes = re.search(r"^probes +([\d,]+)", run.stdout, re.MULTILINE)
    return Approaches(_array_of(rows), int(probes[1].replace(",", "")) if probes else 0)


def _array_of(rows: list[dict[str, str]]) -> npt.NDArray[np.void]:
    def text(name: str) -> list[str]:
        return [row[name] for row in rows]

    def numbers(name: str) -> npt.NDArray[np.float64]:
        return np.array([float(value) if value else np.nan for value in text(name)])

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
    kinds: list[Any] = [(name, column.dtype, column.shape[1:]) for name, column in columns.items()]
    array: npt.NDArray[np.void] = np.zeros(len(rows), dtype=kinds)
    for name, column in columns.items():
        array[name] = column
    return array


def _times(texts: list[str]) -> npt.NDArray[Any]:
    """Numbers, or dates: all are of one kind."""
    try:
        return np.array([float(text) for text in texts])
    except ValueError:
        return np.array([text.removesuffix("Z") for text in texts], dtype="datetime64[ns]")
