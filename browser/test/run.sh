#!/usr/bin/env bash
# Builds the library in WebAssembly, its npm package and the viewer, and tests them: in Node.js, with and without SIMD, and
# the viewer and the map in chromium.
# Usage: run.sh <native program, for the hashes>
set -euo pipefail

program=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
{ cmake --preset browser && cmake --build --preset browser; } >"$log" 2>&1 || { cat "$log"; exit 1; }

export KINESPHERE_PROGRAM=$program KINESPHERE_PACKAGE=$PWD/build/browser/browser/package
export KINESPHERE_VIEWER=$PWD/build/browser/browser/viewer
export PLAYWRIGHT=$PWD/build/browser/browser/viewer-sources/node_modules/playwright-core
# Those in Node.js beside those in chromium, which wait for pictures.
node_tests() {
  cd browser/test
  node --test package.test.mjs consumer.test.mjs &&
    KINESPHERE_SIMD=1 node --test scenes.test.mjs &&
    KINESPHERE_SIMD=0 node --test scenes.test.mjs
}
(node_tests) >"$log" 2>&1 &
in_node=$!
cd browser/viewer/test
node --test viewer.test.mjs served.test.mjs hashes.test.mjs dragging.test.mjs pictures.test.mjs map.test.mjs
wait $in_node || { cat "$log"; exit 1; }
cat "$log"
