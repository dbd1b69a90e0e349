"""Approaches of bodies on known paths, which are polynomials of time."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from ._kinesphere import Workers, _path_approaches
from .errors import InvalidValue
from .events import columns_of

if TYPE_CHECKING:
    import pandas as pd

_ma: Any = np.ma  # its functions have no types


class PathApproaches:
    """All approaches, certified: outside of them two bodies are farther apart than the distance.

    approaches, by begin, a row for each, with the fields

    first, second: numbers of the bodies, first < second.
    begin, end: times between which the two may be within the distance: that of their polynomials is at most
    the distance asked for plus their errors.
    begins_with_path, ends_with_path: a path, or the search, begins or ends then.
    is_certain: the two are within the distance, whatever the errors are.
    closest: row of its least minimum.

    minima, by approach and time, a row for each local minimum of the distance, with the fields

    approach: row of its approach. first, second: its bodies. time.
    distance, relative_speed, first_position, first_velocity, second_position, second_velocity: of the polynomials.
    relative_position_rtn, relative_velocity_rtn: second less first in the frame of the first's orbit about the
    origin: radial, in-track and cross-track; the last two are NaN where it moves straight from or to the origin.
    is_cut_off: the distance still falls toward the begin or end of a path or of the search.
    """

    def __init__(self, approaches: npt.NDArray[np.void], minima: npt.NDArray[np.void], step: float) -> None:
        self.approaches = approaches
        self.minima = minima
        self.step = step
        """Length of the steps that the search took."""

    def __len__(self) -> int:
        return len(self.approaches)

    def __repr__(self) -> str:
        return f"<{len(self.approaches)} approaches with {len(self.minima)} minima>"

    def to_pandas(self) -> pd.DataFrame:
        """A data frame with a row for each minimum, and a column for each coordinate."""
        import pandas as pd

        return pd.DataFrame(columns_of(self.minima))


class PolynomialPaths:
    """Paths as polynomials of time, arc after arc.

    bodies: number of the body of each arc, of shape (arcs,); must not decrease.
    begins, ends: times of each arc. The arcs of a body follow each other; between them it may be absent.
    coefficients: of shape (arcs, 3, terms), with 24 terms at most.
    basis: "chebyshev", as numpy.polynomial.chebyshev has it, in (2 t - begin - end) / (end - begin) from -1 to 1;
    or "monomial", in powers of t - begin.
    errors: for each body, or for all, how far it may be from its polynomials.

    Arrays of float64 (bodies: uint32) that are contiguous are not copied; they must stay as they are.
    """

    def __init__(
        self,
        bodies: npt.ArrayLike,
        begins: npt.ArrayLike,
        ends: npt.ArrayLike,
        coefficients: npt.ArrayLike,
        *,
        basis: Literal["chebyshev", "monomial"] = "chebyshev",
        errors: npt.ArrayLike = 0.0,
    ) -> None:
        if basis not in ("chebyshev", "monomial"):
            raise _refused("basis", f'must be "chebyshev" or "monomial", but is {basis!r}')
        arrays = {
            "bodies": bodies,
            "begins": begins,
            "ends": ends,
            "coefficients": coefficients,
            "errors": errors,
        }
        for name, array in arrays.items():
            if _ma.is_masked(array):
                raise _refused(name, "must be numbers, but has masked entries: leave their arcs out")
        numbers = np.asarray(bodies)
        if numbers.ndim != 1 or (numbers.size > 0 and numbers.dtype.kind not in "iu"):
            raise _refused(
                "bodies", f"must be whole numbers of shape (arcs,), but is {numbers.dtype} of {numbers.shape}"
            )
        if numbers.size > 0 and not (numbers.min() >= 0 and numbers.max() < 2**32 - 1):
            raise _refused("bodies", "must be from 0 to 2^32 - 2")
        self.bodies = np.ascontiguousarray(numbers, np.uint32)
        self.begins = _doubles("begins", begins, self.bodies.shape)
        self.ends = _doubles("ends", ends, self.bodies.shape)
        self.coefficients = np.ascontiguousarray(coefficients, np.float64)
        if self.coefficients.ndim != 3 or self.coefficients.shape[:2] != (len(self.bodies), 3):
            raise _refused(
                "coefficients",
                f"must have shape ({len(self.bodies)}, 3, terms), but has shape {self.coefficients.shape}",
            )
        self.basis = basis
        count = int(self.bodies.max(initial=-1 if len(self.bodies) == 0 else 0)) + 1
        given = np.asarray(errors, np.float64)
        self.errors = np.full(count, float(given)) if given.ndim == 0 else np.ascontiguousarray(given)

    def approaches(
        self,
        distance: float,
        *,
        body: Optional[int] = None,
        begin: Optional[float] = None,
        end: Optional[float] = None,
        threads: Union[int, Workers] = 1,
        progress: Optional[Callable[[float], object]] = None,
    ) -> PathApproaches:
        """Finds all approaches to within the distance and all local minima during them, certified.

        body: approaches of this one alone. begin, end: leaves out what is before and after.
        threads: how many share the work, or Workers; the outcome is the same.
        progress: a function of the part that is done, up to 1. It may raise, which ends the call.

        Minima with a rise of at most twice the sum of the two errors next to them are left out.
        """
        return PathApproaches(
            *_path_approaches(
                self.bodies, self.begins, self.ends, self.coefficients, self.coefficients.shape[2], self.errors,
                self.basis == "chebyshev", distance, body, begin, end, threads, progress)
        )  # fmt: skip


def _refused(argument: str, why: str) -> InvalidValue:
    return InvalidValue(f"PolynomialPaths: {argument} {why}", "out_of_range", argument)


def _doubles(name: str, values: npt.ArrayLike, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    array = np.ascontiguousarray(values, np.float64)
    if array.shape != shape:
        raise _refused(name, f"must have shape {shape} as bodies, but has shape {array.shape}")
    return array
