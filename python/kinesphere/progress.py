"""The bar of World.run(progress=True)."""

from __future__ import annotations

import warnings
from typing import Any


class Bar:
    """A bar by tqdm, which draws it in a notebook or a terminal; without tqdm a warning, and no bar."""

    def __init__(self, start: float, until: float) -> None:
        self._start, self._until = start, until
        self._bar: Any = None
        try:
            from tqdm.auto import tqdm
        except ImportError:
            warnings.warn(
                "run: progress=True needs tqdm, which is not installed; a function works without",
                stacklevel=2,
            )
            self._make: Any = None
        else:
            self._make = tqdm

    def __call__(self, time: float) -> None:
        if self._make is None:
            return
        if self._bar is None:
            form = "{l_bar}{bar}| {n:.4g}/{total:.4g} [{elapsed}<{remaining}]"
            self._bar = self._make(total=self._until - self._start, desc="world.time", bar_format=form)
        self._bar.update(time - self._start - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
