#!/usr/bin/env bash
# Installs missing packages, builds the fuzzers and runs each for this many seconds (default 60) from its corpus, the
# archive tests/fuzz/corpus/<fuzzer>.tar.xz. Packs the corpus anew: the fewest inputs, old and new, that reach all the code
# that any of them reaches. Fails if a fuzzer finds a failure, and keeps that input in build/fuzz/.
# Usage: fuzz.sh [seconds [fuzzer...]]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:-60}
# Length of the longest input in bytes, by target.
declare -A longest=([operations]=1616 [snapshot]=1024 [mended]=121 [monitor]=4096 [http]=20000 [nmea]=4096 [tables]=2000)
scripts/setup.sh test
cmake --preset fuzz >/dev/null
targets=("${@:2}")
if [[ ${#targets[@]} == 0 ]]; then targets=("${!longest[@]}"); fi
cmake --build --preset fuzz --target "${targets[@]/#/fuzz_}"

for target in "${targets[@]}"; do
  archive=tests/fuzz/corpus/$target.tar.xz
  known=build/fuzz/known/$target
  found=build/fuzz/found/$target
  fewest=build/fuzz/fewest/$target
  rm -rf "$known" "$fewest"
  mkdir -p "$known" "$found" "$fewest"
  tar -xJf "$archive" -C "$known"
  echo "fuzz_$target: $seconds seconds"
  build/fuzz/tests/fuzz/fuzz_$target -max_total_time="$seconds" -max_len="${longest[$target]}" -timeout=20 \
    -artifact_prefix="build/fuzz/$target-" -print_final_stats=1 -verbosity=0 \
    "$found" "$known"
  build/fuzz/tests/fuzz/fuzz_$target -set_cover_merge=1 -use_counters=0 -verbosity=0 "$fewest" "$known" "$found"
  # The same bytes for the same inputs.
  tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=644 -cf - -C "$fewest" . | xz -9e >"$archive"
done
