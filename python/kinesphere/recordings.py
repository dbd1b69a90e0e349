"""Runs and worlds as bytes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._kinesphere import GameWorld, World, _read_recording
from .events import Events
from .ids import BodyId


@dataclass(frozen=True)
class RecordedRun:
    """All that happened: events, and the states that were reported, in the order in which they came."""

    start_time: float
    end_time: float
    events: Events
    times: npt.NDArray[np.float64]
    """Of the reports, shape (n,)."""
    bodies: npt.NDArray[np.int64]
    positions: npt.NDArray[np.float64]
    """Shape (n, 3)."""
    velocities: npt.NDArray[np.float64]


def read_recording(
    recording: bytes, pair_filter: Callable[[BodyId, BodyId], bool] | None = None
) -> RecordedRun:
    """All that happened in what World.stop_recording() returned, or in the file of `kinesphere run --record`.
    The run is repeated for it, as Replay does: `pair_filter` is needed if its world had one. Raises InvalidValue
    for bytes that are no recording, StateError (diverged) where the run goes another way."""
    return RecordedRun(*_read_recording(recording, pair_filter))


def restored(snapshot: bytes) -> World:
    """What a pickled world calls: World.restore() under a name that pickle can write down."""
    return World.restore(snapshot)


def restored_game(snapshot: bytes, respond: Any) -> GameWorld:
    """What a pickled game calls, as restored()."""
    return GameWorld.restore(snapshot, respond)
