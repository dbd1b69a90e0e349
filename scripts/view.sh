#!/usr/bin/env bash
# Sets up what is missing, builds the program and the viewer, and shows the viewer in a browser. Arguments are passed on to
# `kinesphere view`, for instance: view.sh --no-browser --port 8000, or view.sh crowd.txt --format pedpy
set -euo pipefail

called_from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# Only the program may write to standard output.
scripts/setup.sh browser >&2
cmake --preset release >&2
cmake --build --preset release >&2
cmake --preset browser >&2
cmake --build --preset browser >&2
program=$PWD/build/release/programs/kinesphere
# Arguments may be files in the caller's folder.
cd "$called_from"
exec "$program" view "$@"
