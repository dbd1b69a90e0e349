#!/usr/bin/env python3
"""Draws the pictures of the docs from runs of the Python package kinesphere. Each is dark or bright as the screen is.

Usage: make.py           writes the pictures beside this file
       make.py --check   fails unless they are as the runs make them
"""

import sys
from pathlib import Path

import bound
import charts
import film
import games
import guides
import late
import lessons
import pair
import regions
import trades
from drawing import Sheet

PICTURES = {
    "bound": bound.draw,
    "regions": regions.draw,
    "pair": pair.draw,
    "late": late.draw,
    "guides": lambda: Sheet({name: draw() for name, draw in {**lessons.DRAWINGS, **guides.DRAWINGS}.items()}),
    "charts": lambda: Sheet(
        {
            "costs": charts.draw_costs(),
            "misses": charts.draw_misses(),
            "ratios": charts.draw_ratios(),
            "frames": charts.draw_frames(),
            "build": charts.draw_build(),
        }
    ),
    "games": games.sheet,
    "trades": lambda: Sheet({name: draw() for name, draw in trades.DRAWINGS.items()}),
    "tracks": guides.tracks,
    "python": guides.python,
    "film": film.draw,
    "film-still": lambda: film.draw(moving=False),
}


def main():
    folder = Path(__file__).resolve().parent
    drawn = {name: draw() for name, draw in PICTURES.items()}
    for name in [name for name, picture in drawn.items() if picture is None]:
        print(f"docs/pictures: {name}.svg is skipped, as what draws it is not here (guides.py)")
    made = {folder / f"{name}.svg": one.svg() for name, one in drawn.items() if one is not None}
    if sys.argv[1:] == ["--check"]:
        stale = [path.name for path, text in made.items() if not path.exists() or path.read_text() != text]
        sys.exit(f"docs/pictures: not as make.py makes them: {', '.join(stale)}" if stale else 0)
    for path, text in made.items():
        path.write_text(text)


if __name__ == "__main__":
    main()
