#!/usr/bin/env python3
"""Writes what other languages repeat of include/kinesphere.h. What it writes is checked in.

Usage: generate.py [--check] [--root FOLDER]
  --check: writes nothing, and fails if a file is not what this would write
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

import c_test
import cplusplus
import csharp
import header
import parity
import python
import rust
import typescript

banner = "Generated from include/kinesphere.h by interface/generate.py: change the header, and run that."
begin, end = "generated from kinesphere.h: ", "end of what is generated"


def between_marks(path: Path, parts: dict[str, str]) -> str:
    """The text of a file that has generated parts: the lines between one with the name of the part and the next end."""
    text = path.read_text()
    for name, part in parts.items():
        pattern = re.compile(
            rf"^([^\n]*{re.escape(begin + name)}\n).*?(^[^\n]*{re.escape(end)}\n)", re.MULTILINE | re.DOTALL
        )
        text, count = pattern.subn(lambda found: found[1] + part + found[2], text)
        if count != 1:
            raise header.HeaderError(f"{path}: a line with '{begin}{name}' and one with '{end}' are expected")
    return text


def files(interface: header.Interface, root: Path) -> dict[str, str]:
    """The text of each file that is generated, or of which a part is."""
    return {
        "interface/fields.hpp": cplusplus.fields(interface, banner),
        "tests/c/record_sizes.c": c_test.sizes(interface, banner),
        "tests/c/record_defaults.c": c_test.defaults(interface, banner),
        "c/kinesphere-c.map": cplusplus.symbols(interface, banner),
        "browser/package/src/records.ts": typescript.records(interface, banner),
        "python/kinesphere/_kinesphere.pyi": between_marks(
            root / "python/kinesphere/_kinesphere.pyi", python.stub_parts(interface)
        ),
        "docs/parity.md": parity.page(interface, banner),
        "python/kinesphere/kinds.py": python.kinds(interface, banner),
        "python/module/definitions.hpp": python.bound_definitions(interface, banner),
        "python/module/records.hpp": python.records(interface, banner),
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
