#!/usr/bin/env bash
# Builds the engine's tests with a sanitizer and runs all but the longest: ten minutes of processor time with the build.
# For all tests: KINESPHERE_PRESET=tsan scripts/test.sh. Further arguments are passed on to ctest.
# Usage: sanitize.sh asan | tsan [arguments of ctest]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${1:-}
if [[ $preset != asan && $preset != tsan ]]; then echo "sanitize: usage: sanitize.sh asan | tsan [arguments of ctest]" >&2 && exit 2; fi
shift
rooms=(archive contact bodies core processor engine input motion parallel space stream world)
# Tests that repeat themselves over many scenes, bodies or bytes, beside those with the label long.
longest='LargeRound|Answers.AreNeverLater|Queries.AgreeWith|InAThousandScenes|BadSnapshot|FailedAdvance|TenThousandBullets'

scripts/setup.sh test
cmake --preset "$preset"
cmake --build --preset "$preset" --target "${rooms[@]/#/test_}"
exec ctest --preset "$preset" --parallel "$(nproc)" -L "^($(IFS='|' && echo "${rooms[*]}"))\$" -E "$longest" "$@"
