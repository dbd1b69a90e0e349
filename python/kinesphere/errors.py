"""What is raised: the library's own message, with the argument and the body that it names."""

from __future__ import annotations

from typing import Optional

from .ids import BodyId


class KinesphereError(Exception):
    """Of the library.

    code: what is wrong, as the C++ library calls it: "out_of_range", "stale_body" and so on.
    argument: the argument that is wrong, as the library calls it.
    body: the id of the body that it concerns, or None.
    """

    def __init__(
        self, message: str, code: str = "", argument: str = "", body: Optional[BodyId] = None
    ) -> None:
        super().__init__(message, code, argument, body)
        self.code = code
        self.argument = argument
        self.body = body

    def __str__(self) -> str:
        return str(self.args[0])


class InvalidValue(KinesphereError, ValueError):
    """A value that cannot be: of another shape, not finite, out of its range, bytes that are no snapshot."""


class BodyError(KinesphereError, LookupError):
    """An id that this world never gave out, or of a body that has been removed, or of another world."""


class StateError(KinesphereError, RuntimeError):
    """A call that is not possible now, or not of this body: inside a probe, of a disabled or static body."""


_values = {
    "not_finite", "out_of_range", "time_backwards", "outside_domain", "overlapping", "null_probe", "null_callback",
    "bad_snapshot", "bad_bytes", "bad_recording",
}  # fmt: skip
_bodies = {"unknown_body", "stale_body", "foreign_body"}


def error_of(code: str, argument: str, body: Optional[BodyId], message: str) -> KinesphereError:
    # Constructors are the caller's "World", not "World::create".
    message = message.replace("::create: ", ": ", 1)
    kind = InvalidValue if code in _values else BodyError if code in _bodies else StateError
    return kind(message, code, argument, body)
