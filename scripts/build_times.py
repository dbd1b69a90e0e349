#!/usr/bin/env python3
"""Builds in a fresh clone of the last commit, without ccache, and prints what that takes: the README's first command
without its packages, the library alone, and the Python package.

Usage: build_times.py [--csv FILE] [first | library | python ...]
       build_times.py sources      the time of each source of the first command, compiled by itself, and of each folder

Seconds of processor are of all processes together. Beside other work, and on two threads of one core, they are more. What
has to be installed: scripts/setup.sh python.
"""

import argparse
import collections
import os
import resource
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
PYTHON = "/usr/bin/python3"

# Each in a fresh clone: the commands of README.md, docs/install.md and docs/versions.md.
COMMANDS = {
    "first": ["scripts/run.sh"],
    "library": ["cmake -G Ninja -B build/library", "cmake --build build/library"],
    "python": [
        f"{PYTHON} -m pip --isolated wheel --no-build-isolation --no-index --no-deps -w wheel ./python"
    ],
}
SOURCES = [
    "cmake --preset release -DKINESPHERE_BUILD_PROGRAM=scenes -DKINESPHERE_BUILD_C=OFF -DKINESPHERE_BATCH=file"
    f" -DCMAKE_CXX_COMPILER_LAUNCHER={shlex.quote(str(Path(__file__).resolve()))}",
    "cmake --build --preset release --target kinesphere_program",
]


def children():
    """Seconds of processor of all processes that have ended, and the megabytes of the largest."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def compile_source(command):
    """Takes the place of the compiler, and notes how long it takes."""
    code = subprocess.run(command).returncode
    if "-c" in command:
        with open(os.environ["KINESPHERE_BUILD_TIMES"], "a") as log:
            print(*children(), command[command.index("-c") + 1], sep="\t", file=log)
    return code


def clone_to(folder):
    subprocess.run(["git", "clone", "-q", str(REPOSITORY), str(folder)], check=True)


def run(commands, clone, log):
    """Runs commands in a clone, with output to a file that is shown after a failure."""
    environment = {**os.environ, "CCACHE_DISABLE": "1", "KINESPHERE_BUILD_TIMES": str(log) + ".tsv"}
    environment.pop("CMAKE_CXX_COMPILER_LAUNCHER", None)
    for command in commands:
        with open(log, "a") as output:
            done = subprocess.run(
                shlex.split(command), cwd=clone, env=environment, stdout=output, stderr=output
            )
        if done.returncode != 0:
            sys.exit(f"{Path(log).read_text()}\nbuild_times: {command} failed")


def measure(what):
    """Runs in a process of its own, since the figures are those of all children."""
    with tempfile.TemporaryDirectory() as folder:
        clone = Path(folder) / "kinesphere"
        clone_to(clone)
        before, begin = children()[0], time.monotonic()
        run(COMMANDS[what], clone, Path(folder) / "log")
        wall = time.monotonic() - begin
        processor, megabytes = children()
        print(what, f"{processor - before:.0f}", f"{wall:.0f}", f"{megabytes:.0f}", sep=",")


def measure_sources():
    with tempfile.TemporaryDirectory() as folder:
        clone, log = Path(folder) / "kinesphere", Path(folder) / "log"
        clone_to(clone)
        run(SOURCES, clone, log)
        rows = [line.split("\t") for line in Path(f"{log}.tsv").read_text().splitlines()]
    sources = [(float(seconds), str(Path(source).relative_to(clone))) for seconds, _, source in rows]
    by_folder = collections.Counter()
    for seconds, source in sources:
        by_folder[str(Path(source).parent)] += seconds
    print("seconds of processor, by folder:")
    for name, seconds in by_folder.most_common():
        print(f"{seconds:7.1f}  {name}")
    print(f"{sum(by_folder.values()):7.1f}  all {len(sources)} sources\n\nof the longest sources:")
    for seconds, source in sorted(sources, reverse=True)[:30]:
        print(f"{seconds:7.1f}  {source}")


def main():
    if "KINESPHERE_BUILD_TIMES" in os.environ:
        sys.exit(compile_source(sys.argv[1:]))
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=True
    )
    parser.add_argument("--csv", type=Path, help="also write the table to this file")
    parser.add_argument("what", nargs="*", help="first, library, python, or sources")
    parser.add_argument("--measure", choices=COMMANDS, help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    if chosen.measure:
        return measure(chosen.measure)
    if chosen.what == ["sources"]:
        return measure_sources()
    unknown = [what for what in chosen.what if what not in COMMANDS]
    if unknown:
        parser.error(f"'{unknown[0]}' is none of first, library, python; sources stands alone")
    lines = ["what,processor_seconds,wall_seconds,largest_process_megabytes"]
    print(lines[0], flush=True)
    for what in chosen.what or COMMANDS:
        done = subprocess.run(
            [sys.executable, __file__, "--measure", what], stdout=subprocess.PIPE, text=True, check=True
        )
        lines.append(done.stdout.strip())
        print(lines[-1], flush=True)
    if chosen.csv:
        chosen.csv.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
