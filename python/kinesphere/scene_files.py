"""Scenes of JSON files, as the program `kinesphere run FILE` reads them."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Union

from ._kinesphere import Scene, _scene
from .errors import InvalidValue


def read_scene(file: Union[str, os.PathLike[str]]) -> Scene:
    """The scene of a JSON file of `kinesphere run`, to the last bit. Raises InvalidValue, which names the field."""
    try:
        fields = json.loads(Path(file).read_bytes(), object_pairs_hook=_fields, parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise InvalidValue(
            f"read_scene: file must be JSON, but {file}: {error}", "out_of_range", "file"
        ) from None
    if not isinstance(fields, dict):
        raise InvalidValue(
            f"read_scene: file must have a scene {{...}}, but {file} has none", "out_of_range", "file"
        )
    return scene_of(fields)


def scene_of(fields: dict[str, Any]) -> Scene:
    """The scene with these fields of a scene file: what pickle calls, under a name that it can write down."""
    return _scene(fields)


def _fields(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    fields = dict(pairs)
    if len(fields) < len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(f"expected each field once: {next(name for name in names if names.count(name) > 1)}")
    return fields


def _no_number(text: str) -> None:
    raise ValueError(f"{text} is no number")
