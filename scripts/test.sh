#!/usr/bin/env bash
# Sets up what is missing, builds everything, and runs all tests. Arguments are passed on to ctest.
# KINESPHERE_PRESET chooses another preset than ci, for instance:
#   KINESPHERE_PRESET=asan scripts/test.sh -R bound
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${KINESPHERE_PRESET:-ci}
scripts/setup.sh test
cmake --preset "$preset"
cmake --build --preset "$preset"
# One more than there are processors, since some tests mostly wait.
exec ctest --preset "$preset" --parallel $(($(nproc) + 1)) "$@"
