"""Names of bodies: whole numbers, which are indices of arrays as long as no body has been removed."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt


class BodyId(int):
    """Names a body for as long as it lives.

    The number is index + 2**32 * generation. When a body is removed its index may be used again, with
    another generation, so an old id is recognised as stale and never mistaken for a newer body. It also
    knows the world that gave it out: another one refuses it (foreign_body). Arrays of ids, and whole numbers,
    are taken by every world.
    """

    world: int

    def __new__(cls, number: int, world: int = 0) -> BodyId:
        body = super().__new__(cls, number)
        body.world = world
        return body

    @property
    def index(self) -> int:
        return int(self) & 0xFFFFFFFF

    @property
    def generation(self) -> int:
        return int(self) >> 32

    def __repr__(self) -> str:
        return str(self.index) if self.generation == 0 else f"{self.index} (generation {self.generation})"

    __str__ = __repr__


def index_of(ids: npt.ArrayLike) -> npt.NDArray[np.int64]:
    """The indices of these ids, for arrays with a place for each body, in worlds that remove bodies."""
    numbers: npt.NDArray[Any] = np.asarray(ids)
    return np.bitwise_and(numbers.astype(np.int64), 0xFFFFFFFF)
