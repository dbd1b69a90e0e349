#!/usr/bin/env bash
# Installs missing packages, builds the fuzzers and runs each for this many seconds (default 60) from its corpus in
# tests/fuzz/corpus. Adds inputs that reach new code to the corpus. Fails if a fuzzer finds a failure, and keeps that input
# in build/fuzz/.
# Usage: fuzz.sh [seconds]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}
# Length of the longest input in bytes, by target.
declare -A longest=([operations]=2404 [snapshot]=1024 [mended]=121 [monitor]=4096 [http]=20000 [nmea]=4096 [tables]=2000)
scripts/setup.sh test
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
