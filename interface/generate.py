#!/usr/bin/env python3
"""Writes what other languages repeat of include/kinesphere.h. What it writes is checked in.

Usage: generate.py [--check] [--root FOLDER]
  --check: writes nothing, and fails if a file is not what this would write
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import c_test
import cplusplus
import csharp
import header
import rust
import typescript

banner = "Generated from include/kinesphere.h by interface/generate.py: change the header, and run that."
begin, end = "generated from kinesphere.h: begin", "generated from kinesphere.h: end"


def between_marks(path: Path, text: str) -> str:
    """The text of a file of which a part is generated: the lines between two that have the marks."""
    lines = path.read_text().splitlines(keepends=True)
    marks = [k for k, line in enumerate(lines) if begin in line or end in line]
    if len(marks) != 2 or begin not in lines[marks[0]] or end not in lines[marks[1]]:
        raise header.HeaderError(f"{path}: a line with '{begin}' and one with '{end}' are expected")
    return "".join([*lines[: marks[0] + 1], text, *lines[marks[1] :]])


def files(interface: header.Interface, root: Path) -> dict[str, str]:
    """The text of each file that is generated, or of which a part is."""
    return {
        "interface/fields.hpp": cplusplus.fields(interface, banner),
        "tests/c/record_defaults.c": c_test.defaults(interface, banner),
        "c/kinesphere-c.map": cplusplus.symbols(interface, banner),
        "browser/package/src/records.ts": typescript.records(interface, banner),
        "csharp/src/Native.cs": csharp.native(interface, banner),
        "csharp/src/Records.cs": csharp.records(interface, banner),
        "rust/src/sys.rs": rust.sys(interface, banner),
        "rust/src/records.rs": rust.records(interface, banner),
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--check", action="store_true", help="write nothing; fail if a file is not what this would write"
    )
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent, metavar="FOLDER")
    given = parser.parse_args()
    try:
        interface = header.read((given.root / "include/kinesphere.h").read_text())
        made = files(interface, given.root)
    except (header.HeaderError, OSError) as error:
        print(f"generate: {error}", file=sys.stderr)
        return 1
    stale = [
        name
        for name, text in made.items()
        if not (given.root / name).exists() or (given.root / name).read_text() != text
    ]
    for name in [] if given.check else stale:
        (given.root / name).parent.mkdir(parents=True, exist_ok=True)
        (given.root / name).write_text(made[name])
    if given.check and stale:
        print(f"generate: stale: {', '.join(stale)}; run interface/generate.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
