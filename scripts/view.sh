#!/usr/bin/env bash
# Sets up what is missing, builds the program and the viewer, and shows the viewer in a browser. Arguments are passed on to
# `kinesphere view`, for instance: view.sh --no-browser --port 8000
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# Standard output belongs to the program.
scripts/setup.sh browser >&2
cmake --preset release >&2
cmake --build --preset release >&2
cmake --preset browser >&2
cmake --build --preset browser >&2
exec build/release/programs/kinesphere view "$@"
