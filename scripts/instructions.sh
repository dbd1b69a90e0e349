#!/usr/bin/env bash
# Counts the instructions of small scenes (run_scene() and all its calls, under valgrind). Fails if a count differs from
# tests/instructions/counts.txt by 3 % or more, in either direction; --update keeps the new counts. Counts are comparable
# only with equal compiler, flags, C library and valgrind; otherwise nothing is counted, and the exit code is 77.
# Usage: instructions.sh [--update] [build folder; default: build/ci]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
update=false
if [[ ${1:-} == --update ]]; then update=true && shift; fi
build=${1:-build/ci}
counts=tests/instructions/counts.txt
slack_percent=3

cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
command -v valgrind >/dev/null || { echo "instructions: skipped: valgrind is not installed" && exit 77; }
build_type=$(cached CMAKE_BUILD_TYPE)
conditions="compiler  $("$(cached CMAKE_CXX_COMPILER)" --version | sed '1s/^c++ /g++ /;1q')
flags     $(xargs <<<"$(cached CMAKE_CXX_FLAGS) $(cached "CMAKE_CXX_FLAGS_${build_type^^}")")
library   $(getconf GNU_LIBC_VERSION) on $(uname -m)
valgrind  $(valgrind --version)"

# Uses the variants of memcpy and the like for every processor, no environment, and symbols bound at the start.
count() {
  local profile counted
  profile=$(mktemp)
  env -i LD_BIND_NOW=1 GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-AVX512F,-AVX512VL,-AVX512BW,-ERMS,-FSRM \
    "$(command -v valgrind)" --tool=callgrind --callgrind-out-file="$profile" --toggle-collect='kinesphere::run_scene(*' \
    "$build/programs/kinesphere" run "$@" --hash-only >/dev/null 2>"$profile.log" || { cat "$profile.log" >&2; exit 1; }
  counted=$(sed -n 's/^summary: //p' "$profile")
  rm -f "$profile" "$profile.log"
  [[ $counted -gt 0 ]] || { echo "instructions: nothing was counted: is there no kinesphere::run_scene() any more?" >&2; exit 1; }
  echo "$counted"
}

if $update; then
  scenes=$(sed -n 's/^[0-9]* *run //p' "$counts")
  {
    sed -n '/^#/p' "$counts"
    echo "$conditions"
    while read -r -a scene; do
      counted=$(count "${scene[@]}")
      printf '%-11s run %s\n' "$counted" "${scene[*]}"
    done <<<"$scenes"
  } >"$counts.new"
  mv "$counts.new" "$counts"
  cat "$counts"
  exit
fi

recorded=$(grep -E '^(compiler|flags|library|valgrind) ' "$counts")
if [[ $recorded != "$conditions" ]]; then
  echo "instructions: skipped: $counts was counted with < and this is >"
  diff <(echo "$recorded") <(echo "$conditions") || exit 77
fi

failures=0
while read -r expected _ scene; do
  read -r -a arguments <<<"$scene"
  counted=$(count "${arguments[@]}")
  verdict=$(awk -v counted="$counted" -v expected="$expected" -v slack="$slack_percent" 'BEGIN {
    change = 100 * (counted / expected - 1)
    printf("%+.2f %%%s", change, change > slack ? ", TOO MANY" : change < -slack ? ", FEWER: keep them with --update" : "")
  }')
  echo "$scene: $counted instructions, $verdict"
  if [[ $verdict == *,* ]]; then failures=$((failures + 1)); fi
done < <(grep '^[0-9]' "$counts")
if [[ $failures != 0 ]]; then
  echo "instructions: $failures of the counts are off by more than $slack_percent %; if that is meant: scripts/instructions.sh --update $build" >&2
  exit 1
fi
