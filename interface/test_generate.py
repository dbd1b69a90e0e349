#!/usr/bin/env python3
"""Tests that generated files are up to date, and that each change of the header reaches them."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import generate
import header

root = Path(__file__).resolve().parent.parent


def run(folder: Path, *options: str) -> subprocess.CompletedProcess:
    command = [sys.executable, "-B", str(root / "interface/generate.py"), "--root", str(folder), *options]
    return subprocess.run(command, capture_output=True, text=True)


class Generated(unittest.TestCase):
    def setUp(self) -> None:
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = Path(made.name)
        self.header = self.folder / "include/kinesphere.h"
        self.header.parent.mkdir()
        self.names = list(generate.files(header.read((root / "include/kinesphere.h").read_text()), root))
        for name in ["include/kinesphere.h", *self.names]:
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(root / name, self.folder / name)

    def change(self, pattern: str, replacement: str) -> None:
        text, count = re.subn(pattern, replacement, self.header.read_text(), count=1, flags=re.DOTALL)
        self.assertEqual(count, 1, pattern)
        self.header.write_text(text)

    def changed(self) -> set[str]:
        """The files that the generator writes after a change of the header, which its check must name."""
        before = {name: (self.folder / name).read_text() for name in self.names}
        stale = run(self.folder, "--check").stderr
        self.assertEqual(run(self.folder).stderr, "")
        names = {name for name in self.names if (self.folder / name).read_text() != before[name]}
        self.assertEqual(names, {name for name in self.names if name in stale})
        self.assertEqual(run(self.folder, "--check").returncode, 0)
        return names

    def assert_in(self, name: str, text: str) -> None:
        self.assertIn(text, (self.folder / name).read_text())

    def test_files_are_up_to_date(self) -> None:
        found = run(root, "--check")
        self.assertEqual((found.returncode, found.stderr), (0, ""))

    def test_files_say_in_their_first_line_that_they_are_generated(self) -> None:
        for name in self.names:
            text = (root / name).read_text()
            whole = f"{generate.begin}" not in text
            self.assertTrue(not whole or generate.banner.split(":")[0] in text.splitlines()[0], name)

    def test_a_stale_file_is_named(self) -> None:
        with (self.folder / "rust/src/sys.rs").open("a") as file:
            file.write("\n")
        found = run(self.folder, "--check")
        self.assertEqual(found.returncode, 1)
        self.assertEqual(found.stderr, "generate: stale: rust/src/sys.rs; run interface/generate.py\n")

    def test_a_field_of_an_event_reaches_all_languages(self) -> None:
        self.change(
            r"(  double acceleration_limit;\n)(} ks_event;)", r"\1  double heat;  ///< Of a trial.\n\2"
        )
        self.assertEqual(
            self.changed(),
            {
                "browser/package/src/records.ts",
                "csharp/src/Records.cs",
                "interface/fields.hpp",
                "python/kinesphere/_kinesphere.pyi",
                "python/module/records.hpp",
                "rust/src/records.rs",
                "rust/src/sys.rs",
                "tests/c/record_sizes.c",
            },
        )
        self.assert_in("browser/package/src/records.ts", "get heat(): number { return this.number(400); }")
        self.assert_in("browser/package/src/records.ts", "export const eventAt = { size: 408,")
        self.assert_in("csharp/src/Records.cs", "public double Heat;")
        self.assert_in("rust/src/records.rs", "            heat: raw.heat,")
        self.assert_in("python/kinesphere/_kinesphere.pyi", "    def heat(self) -> float: ...")
        self.assert_in("tests/c/record_sizes.c", "HAS_SIZE(ks_event, 408);")

    def test_a_field_of_a_definition_and_its_default_reach_all_languages(self) -> None:
        self.change(
            r"(double shear_rate;\n)(} ks_world_def)",
            r"\1  double heat;  ///< >= 0, default 0.5: a trial.\n\2",
        )
        self.assertEqual(
            self.changed(),
            {
                "browser/package/src/records.ts",
                "csharp/src/Records.cs",
                "interface/fields.hpp",
                "python/kinesphere/_kinesphere.pyi",
                "python/module/definitions.hpp",
                "rust/src/records.rs",
                "rust/src/sys.rs",
                "tests/c/record_defaults.c",
                "tests/c/record_sizes.c",
            },
        )
        self.assert_in("browser/package/src/records.ts", "given.heat ?? 0.5);")
        self.assert_in("rust/src/records.rs", "            heat: self.heat,")
        self.assert_in("python/module/definitions.hpp", 'py::arg("heat") = 0.5,')
        self.assert_in("python/kinesphere/_kinesphere.pyi", "        heat: float = 0.5,")
        self.assert_in("tests/c/record_defaults.c", "CHECK(made.heat == 0.5);")

    def test_a_kind_reaches_all_languages(self) -> None:
        self.change(r"KS_EVENT_WOKE = 9", "KS_EVENT_WOKE = 9,\n  KS_EVENT_MELTED = 10")
        self.changed()
        self.assert_in("browser/package/src/records.ts", '"melted"')
        self.assert_in("csharp/src/Records.cs", "Melted = 10,")
        self.assert_in("python/kinesphere/kinds.py", "    melted = 9")
        self.assert_in("rust/src/records.rs", "10 => EventKind::Melted,")

    def test_a_function_needs_a_call_in_each_language_or_a_reason(self) -> None:
        with self.header.open("a") as file:
            file.write("KS_API ks_status ks_world_melt(ks_world world);\n")
        found = run(self.folder)
        self.assertEqual(found.returncode, 1)
        self.assertIn("docs/parity.md: ks_world_melt: C++ declares no melt", found.stderr)

    def test_a_field_that_is_no_declaration_is_refused(self) -> None:
        self.change(r"  double gap;", "  double gap = 0;")
        found = run(self.folder)
        self.assertEqual(found.returncode, 1)
        self.assertIn(
            "generate: kinesphere.h: ks_event: a field in a line of its own is expected: double gap = 0;",
            found.stderr,
        )

    def test_a_field_of_an_unknown_type_is_refused(self) -> None:
        self.change(r"  double gap;", "  float gap;")
        self.assertIn("generate: kinesphere.h: ks_event.gap: unknown type float", run(self.folder).stderr)

    def test_a_parameter_of_an_unknown_type_is_refused(self) -> None:
        self.change(
            r"ks_world_time\(ks_world world, double\* time\)", "ks_world_time(ks_world world, ks_clock* time)"
        )
        self.assertIn(
            "generate: kinesphere.h: ks_world_time: unknown type ks_clock of time", run(self.folder).stderr
        )


if __name__ == "__main__":
    unittest.main()
