"""Enumerations whose members print as their names."""

from enum import IntEnum


class Named(IntEnum):
    """Comparing a member with a text is a TypeError: it would be False for ever, and events would be overlooked."""

    def __eq__(self, other: object) -> bool:
        if isinstance(other, str):
            member = other if other in type(self).__members__ else self.name
            raise TypeError(
                f"{type(self).__name__}: compare with {type(self).__name__}.{member}, not with {other!r}"
            )
        return int.__eq__(self, other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = int.__hash__

    def __str__(self) -> str:
        return self.name

    def __format__(self, specification: str) -> str:
        return format(self.name, specification)
