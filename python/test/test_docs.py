"""Each block of Python in docs/python.md runs by itself, in a clone of the repository, as the page says."""

import os
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("KINESPHERE_PROGRAM")
BLOCKS = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/python.md").read_text(), re.M | re.S)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: next(filter(None, reversed(block.splitlines()))))
def test_a_block_of_the_guide(block: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if "ks.watch(" in block or "ks.tracks_in(" in block:
        if PROGRAM is None:
            pytest.skip("KINESPHERE_PROGRAM does not name the program")
        monkeypatch.setenv("PATH", os.path.dirname(PROGRAM), prepend=os.pathsep)
    for optional in ("pandas", "matplotlib"):
        if optional in block:
            pytest.importorskip(optional)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(ROOT)
    exec(compile(block, "docs/python.md", "exec"), {"__name__": "guide"})
