#!/usr/bin/env bash
# Sets up what is missing, builds the library, the programs and the Python package, and runs their tests.
# Usage: test.sh [--all] [arguments of ctest]
#   --all   also runs the tests with the label long: WebAssembly and its pages, the proofs, a build of the other compiler,
#           watches over NATS, more seeds and rounds of random tests, other numbers of ranks. For those with the
#           label alone: test.sh --all -L long
# KINESPHERE_PRESET chooses another preset than ci, for instance:
#   KINESPHERE_PRESET=asan scripts/test.sh -R bound
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${KINESPHERE_PRESET:-ci}
tests=$preset
packages=test
if [[ ${1:-} == --all ]]; then
  if [[ $preset != ci ]]; then echo "test: --all is for the preset ci, not $preset" >&2 && exit 2; fi
  tests=all
  packages=all
  shift
fi
scripts/setup.sh "$packages"
cmake --preset "$preset"
cmake --build --preset "$preset"
# Two more than there are processors, since some tests mostly wait.
exec ctest --preset "$tests" --parallel $(($(nproc) + 2)) "$@"
