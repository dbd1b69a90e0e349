#!/usr/bin/env bash
# `kinesphere tracks` beside a script that builds a tree in each frame (python3-scipy), on the reports of 2,708
# vessels: both in turn, five times each, and the median of the ratios of their CPU times.
# Usage: compare.sh [build folder; default: build/bench] [seconds between two frames; default: 1]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${1:-build/bench}
program=$build/programs/kinesphere
step=${2:-1}
python=${PYTHON:-/usr/bin/python3}
"$python" -c 'import scipy' || { echo "compare.sh: needs scipy: apt install python3-scipy" >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$build/research/kinesphere-bench" vessels "$folder/vessels.csv"

# CPU seconds, user and system, of a command.
cpu() {
  local TIMEFORMAT='%U %S'
  { time "$@" >"$folder/told"; } 2>&1 | tail -n 1 | awk '{print $1 + $2}'
}

for turn in 1 2 3 4 5; do
  ours=$(cpu "$program" tracks "$folder/vessels.csv" --distance 50)
  grep -E '^(approaches|probes)' "$folder/told" | sed 's/^/  /'
  theirs=$(cpu "$python" research/tracks/tree_per_frame.py "$folder/vessels.csv" --distance 50 --step "$step")
  sed 's/^/  /' "$folder/told"
  awk -v ours="$ours" -v theirs="$theirs" -v turn="$turn" \
    'BEGIN {printf "turn %d: kinesphere %.2f s, tree per frame %.2f s\n", turn, ours, theirs}'
  echo "$ours $theirs" >>"$folder/turns"
done
awk '{print $1 / $2}' "$folder/turns" | sort -n | sed -n 3p | sed 's/^/median ratio of CPU times: /'
