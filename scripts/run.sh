#!/usr/bin/env bash
# Sets up what is missing, builds the program, and runs the main job: the first experiment of the paper.
# Arguments are passed on to `kinesphere run paper1`, for instance: run.sh --bodies 500
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# Only the program may write to standard output.
scripts/setup.sh run >&2
# The program for scenes alone, unless all of it has been built here.
scenes=(-DKINESPHERE_BUILD_PROGRAM=scenes -DKINESPHERE_BUILD_C=OFF)
if grep -qs '^KINESPHERE_BUILD_PROGRAM:.*=ON$' build/release/CMakeCache.txt; then scenes=(); fi
cmake --preset release "${scenes[@]}" >&2
cmake --build --preset release --target kinesphere_program >&2
exec build/release/programs/kinesphere run paper1 "$@"
