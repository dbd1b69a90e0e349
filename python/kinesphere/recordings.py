"""Runs and worlds as bytes."""

from __future__ import annotations

from dataclasses import dataclass

from typing import Any

import numpy as np
import numpy.typing as npt

from ._kinesphere import GameWorld, World, _read_recording
from .events import Events


@dataclass(frozen=True)
class RecordedRun:
    """What a viewer can draw: events, and the states that were reported, in the order in which they came."""

    start_time: float
    end_time: float
    events: Events
    times: npt.NDArray[np.float64]
    """Of the reports, shape (n,)."""
    bodies: npt.NDArray[np.int64]
    positions: npt.NDArray[np.float64]
    """Shape (n, 3)."""
    velocities: npt.NDArray[np.float64]


def read_recording(recording: bytes) -> RecordedRun:
    """What World.stop_recording() returned, or the file of `kinesphere run --record`. Raises InvalidValue."""
    return RecordedRun(*_read_recording(recording))


def restored(snapshot: bytes) -> World:
    """What a pickled world calls: World.restore() under a name that pickle can write down."""
    return World.restore(snapshot)


def restored_game(snapshot: bytes, respond: Any) -> GameWorld:
    """What a pickled game calls, as restored()."""
    return GameWorld.restore(snapshot, respond)
