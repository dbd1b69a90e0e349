"""What pickle calls to make motions and maps again, under names that it can write down."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np

from ._kinesphere import BodyMap, FrameMotion, Motion, RecordedTracks

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
        return kind([((0.0, 1.0), (place, place))] * bodies, **options)
    motion: Motion = made(kind, (), {**options, "positions": [place] * bodies})
    return motion


def restored_map(motions: list[Motion], bodies: list[tuple[int, int, int]]) -> BodyMap:
    """Makes a map of bodies: the id of each, the place of its motion in the list, and its number there."""
    bodies_of_motions = BodyMap()
    for body, place, number in bodies:
        bodies_of_motions._connect(body, motions[place], number)
    return bodies_of_motions


_rest = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def reduced_frames(motion: FrameMotion) -> Call:
    """A call as reduced_motion(). Numbers removed since the latest frame are not used again before the next."""
    size = len(motion)
    spare, next_frame = copy.copy(motion), copy.copy(motion)
    free = list(iter(lambda: spare.add(spare.latest_time, *_rest), size))[::-1]
    bodies = [motion.write_body(number) if number in motion else None for number in range(size)]
    present = [number for number in range(size) if number in motion]
    for number in present:
        next_frame.remove(number)
    _push_nobody(next_frame, size)
    order = [next_frame.add(next_frame.latest_time, *_rest) for _ in range(size)][::-1]
    removed = order[len(free) : size - len(present)]
    return restored_frames, (
        type(motion),
        motion._common_arguments(),
        motion.latest_frame,
        bodies,
        free,
        removed,
        None if motion.has_equal_frames else (motion.previous_time, motion.latest_time),
    )


def _push_nobody(motion: FrameMotion, size: int, time: float | None = None) -> None:
    """A frame of a motion whose bodies have all been removed."""
    motion.push(np.full((size, 3), np.nan), time, rotations=motion.latest_rotations())


def _times(frames: int, start: float, last: tuple[float, float] | None) -> Sequence[float | None]:
    """Times for so many frames, of which the last two come when they came; frames of equal length need none."""
    if last is None or frames == 0:
        return [None] * frames
    # The frames before are half a length off, so that they are not those of equal length.
    early = [start + (last[0] - start) * (k + 0.5) / (frames - 1) for k in range(frames - 2)]
    return [*early, *last][-frames:]


def restored_frames(
    kind: type[FrameMotion],
    options: dict[str, Any],
    latest_frame: int,
    bodies: list[bytes | None],
    free: list[int],
    removed: list[int],
    last_times: tuple[float, float] | None = None,
) -> FrameMotion:
    motion, size = kind(np.empty((0, 3)), **options), len(bodies)
    times = _times(latest_frame, motion.latest_time, last_times)
    for time in times[:-1]:
        _push_nobody(motion, 0, time)
    used = sorted(set(range(size)).difference(free))
    if latest_frame > 0:
        # The last number that is removed is the first to be used again.
        for _ in range(size):
            motion.add(motion.latest_time, *_rest)
        for number in [*free, *reversed(used)]:
            motion.remove(number)
        _push_nobody(motion, size, times[-1])
    for number in used:
        body = bodies[number]
        if body is None:
            motion.add(motion.latest_time, *_rest)
        else:
            motion.read_body(body)
    for number in removed:
        motion.remove(number)
    return motion
