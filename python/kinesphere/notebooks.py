"""What notebooks show of worlds and tables: HTML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Optional, Protocol, Self

from .kinds import EventKind

if TYPE_CHECKING:
    import pandas as pd

    from ._kinesphere import World

shown_rows = 10


class _HasFrame(Protocol):
    def __len__(self) -> int:
        ...

    def __getitem__(self, key: slice) -> Self:
        ...

    def to_pandas(self) -> pd.DataFrame:
        ...


def html_of(table: _HasFrame, text: str) -> Optional[str]:
    """The first rows of a table under this text; None, for which a notebook shows the text, without pandas."""
    try:
        frame = table[:shown_rows].to_pandas()
    except ImportError:
        return None
    return f"<p>{escape(text)}</p>{frame.to_html(notebook=True)}{_rest(len(table) - len(frame))}"


def compact_html(text: str, header: Sequence[str], rows: Iterable[Sequence[str]], count: int) -> str:
    """Some of `count` rows of text under this text, as a table that needs no pandas."""
    shown = list(rows)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in shown)
    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    table = f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>" if shown else ""
    return f"<p>{escape(text)}</p>{table}{_rest(count - len(shown))}"


def _rest(count: int) -> str:
    return f"<p>... and {count:,} more</p>" if count > 0 else ""


def world_html(world: World) -> str:
    """Its space, and what it has found and asked so far."""
    definition, counters = world.definition, world.counters
    rows = [("space", _space_of(definition))]
    for kind, name in (
        (EventKind.contact_begin, "contacts"),
        (EventKind.wall_begin, "wall contacts"),
        (EventKind.bound_violation, "broken promises"),
    ):
        number = counters.count(kind)
        if number > 0 or kind == EventKind.contact_begin:
            rows.append((name, f"{number:,}"))
    rows.append(("probes", f"{counters.probes:,}"))
    body = "".join(f"<tr><th>{name}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    bodies = f"{len(world):,} bod{'y' if len(world) == 1 else 'ies'}"
    return f"<p>World of {bodies} at time {world.time:.6g}</p><table>{body}</table>"


def _space_of(definition: Any) -> str:
    axes = definition["dimensions"]
    plane = "plane, " if axes == 2 else ""
    box = definition["box"]
    if box is None:
        return f"{plane}without walls"
    low, high = (
        "(" + ", ".join(f"{value:g}" for value in corner[:axes]) + ")" for corner in (box.lower, box.upper)
    )
    periodic = definition["periodic"]
    rest = f"periodic along {', '.join(periodic)}" if periodic else "with walls"
    return f"{plane}from {low} to {high}, {rest}"
