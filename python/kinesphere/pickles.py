"""What pickle calls to make motions and scenes again, under names that it can write down."""

from __future__ import annotations

import copy
from typing import Any

from ._kinesphere import Motion, RecordedTracks

Call = tuple[Any, tuple[Any, ...]]


def made(kind: type, arguments: tuple[Any, ...], options: dict[str, Any]) -> Any:
    return kind(*arguments, **options)


def reduced_motion(motion: Motion) -> Call:
    """A call that makes a motion with the same bodies under the same numbers, of which new ones get the same ones."""
    options = motion._common_arguments()
    kind, size = type(motion), len(motion)
    removed = [number for number in range(size) if number not in motion]
    filler = b""
    if removed:
        # The motion itself knows in which order it will use these numbers again: the last removed first.
        filler = _motion(kind, options, 1).write_body(0)
        spare = copy.copy(motion)
        removed = [spare.read_body(filler) for _ in removed][::-1]
    bodies = [motion.write_body(number) if number in motion else filler for number in range(size)]
    return restored_motion, (kind, options, bodies, removed)


def restored_motion(
    kind: type[Motion], options: dict[str, Any], bodies: list[bytes], removed: list[int]
) -> Motion:
    motion = _motion(kind, options, 0)
    for body in bodies:
        motion.read_body(body)
    for number in removed:
        motion.remove(number)
    return motion


def _motion(kind: type[Motion], options: dict[str, Any], bodies: int) -> Motion:
    """One with this many bodies that rest at the origin."""
    place = (0.0, 0.0, 0.0)
    if issubclass(kind, RecordedTracks):
        return kind([((0.0, 1.0), (place, place))] * bodies)
    motion: Motion = made(kind, (), {**options, "positions": [place] * bodies})
    return motion
