#!/usr/bin/env bash
# Sets up what is missing, builds research/ and runs its tests and its part of the lint. Arguments are passed on to ctest.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh research
cmake --preset research
cmake --build --preset research
scripts/lint.sh research
exec ctest --preset research --parallel $(($(nproc) + 1)) "$@"
