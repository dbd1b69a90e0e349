#!/usr/bin/env bash
# Lets each fuzzer look for failures, each for so many seconds (default 60), starting from their corpora, and adds
# to those what reaches code that they did not reach. Fails, and keeps the input in build/fuzz/, when one is found.
# Usage: fuzz.sh [seconds]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}
# Each target, and the longest input that it is given, in bytes.
declare -A longest=([operations]=2404 [snapshot]=1024 [mended]=121 [monitor]=4096 [http]=20000)
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${!longest[@]/#/fuzz_}"

for target in "${!longest[@]}"; do
  found=build/fuzz/found/$target
  mkdir -p "$found"
  echo "fuzz_$target: $seconds seconds"
  build/fuzz/tests/fuzz/fuzz_$target -max_total_time="$seconds" -max_len="${longest[$target]}" -timeout=20 \
    -artifact_prefix="build/fuzz/$target-" -print_final_stats=1 -verbosity=0 \
    "$found" "tests/fuzz/corpus/$target"
  build/fuzz/tests/fuzz/fuzz_$target -merge=1 -verbosity=0 "tests/fuzz/corpus/$target" "$found"
done
