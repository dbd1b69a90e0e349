#!/usr/bin/env bash
# Runs the tests and measures covered lines and branches: a summary here, pages in build/coverage/report. Arguments are
# passed on to ctest.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh coverage
build=build/coverage
mkdir -p "$build/report"
find "$build" -name "*.gcda" -delete
KINESPHERE_PRESET=coverage scripts/test.sh "$@"
gcovr --root . --filter src/ --filter toolkit/ --filter distributed/ --filter include/ --filter simulation/ --filter programs/ --exclude-throw-branches \
  --html-details "$build/report/index.html" --print-summary "$build/src" "$build/distributed" "$build/simulation" "$build/programs" "$build/tests"
