"""Calls of the program `kinesphere`."""

from __future__ import annotations

import os
import shutil
import subprocess
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

from .errors import InvalidValue

PathLike = Union[str, "os.PathLike[str]"]


def run_program(
    call: str,
    program: Optional[PathLike],
    command: str,
    options: Mapping[str, Any],
    files: Iterable[PathLike],
    *,
    argument: str,
    standard_input: Optional[bytes] = None,
) -> str:
    """What the program prints. Its warnings become warnings, its error an InvalidValue of `argument`.

    options: by their names without dashes, with _ for -; True is a flag, a sequence an option for each of its
    values; None and False are left out.
    """
    where_it_is = program if program is not None else shutil.which("kinesphere")
    if where_it_is is None:
        raise FileNotFoundError(
            f"{call}: there is no program `kinesphere` in PATH, so program must say where it is"
        )
    texts = [os.fspath(where_it_is), command]
    for name, value in options.items():
        flag = f"--{name.replace('_', '-')}"
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is True:
                texts.append(flag)
            elif one is not None and one is not False:
                texts.append(f"{flag}={one}")
    texts += [
        "--",
        *(name if name == "-" else os.path.abspath(name) for name in (os.fspath(file) for file in files)),
    ]
    run = subprocess.run(texts, capture_output=True, input=standard_input)
    said = run.stderr.decode(errors="replace")
    if run.returncode != 0:
        raise InvalidValue(f"{call}: {said.strip().removeprefix('kinesphere: ')}", "out_of_range", argument)
    for line in said.splitlines():
        if line.startswith("kinesphere: warning: "):
            warnings.warn(line.removeprefix("kinesphere: warning: "), stacklevel=3)
    return run.stdout.decode()
