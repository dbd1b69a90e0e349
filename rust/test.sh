#!/usr/bin/env bash
# Tests the crate without network: its tests, and that its examples print what those in C print.
# Usage: test.sh <cargo> <folder of libkinesphere-c.so> <build folder> <file with the hash of the shared scene>
#   <game loop in C> <monitor in C>
set -euo pipefail

cargo=$1 hash=$4 game_loop=$5 monitor=$6
export KINESPHERE_LIB_DIR=$2 CARGO_TARGET_DIR=$3/rust
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
cd "$source"
"$cargo" test --offline --quiet
example() { "$cargo" run --offline --quiet --example "$1"; }
diff <(example game_loop) <("$game_loop")
diff <(example monitor) <("$monitor")
"$source/../tests/c/has_hash.sh" "$hash" "$cargo" run --offline --quiet --example shared_scene
