#!/usr/bin/env bash
# Sets up what is missing, builds the program, and runs the main job: the first experiment of the paper.
# Arguments are passed on to `kinesphere run paper1`, for instance: run.sh --bodies 500
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# Only the program may write to standard output.
scripts/setup.sh run >&2
cmake --preset release >&2
cmake --build --preset release --target kinesphere_program >&2
exec build/release/programs/kinesphere run paper1 "$@"
