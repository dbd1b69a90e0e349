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
import late
import pair
import regions

PICTURES = {
    "bound": bound.draw,
    "regions": regions.draw,
    "pair": pair.draw,
    "late": late.draw,
    "build": charts.draw_build,
    "costs": charts.draw_costs,
    "misses": charts.draw_misses,
    "film": film.draw,
    "film-still": lambda: film.draw(moving=False),
}


def main():
    folder = Path(__file__).resolve().parent
    made = {folder / f"{name}.svg": draw().svg() for name, draw in PICTURES.items()}
    if sys.argv[1:] == ["--check"]:
        stale = [path.name for path, text in made.items() if not path.exists() or path.read_text() != text]
        sys.exit(f"docs/pictures: not as make.py makes them: {', '.join(stale)}" if stale else 0)
    for path, text in made.items():
        path.write_text(text)


if __name__ == "__main__":
    main()
