#!/usr/bin/env bash
# Builds the library in WebAssembly and its npm package, and tests them in Node.js, with and without SIMD.
# Usage: run.sh <native program, for the hashes>
set -euo pipefail

program=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
{ cmake --preset browser && cmake --build --preset browser; } >"$log" 2>&1 || { cat "$log"; exit 1; }

export KINESPHERE_PROGRAM=$program KINESPHERE_PACKAGE=$PWD/build/browser/browser/package
cd browser/test
node --test package.test.mjs consumer.test.mjs
KINESPHERE_SIMD=1 node --test scenes.test.mjs
KINESPHERE_SIMD=0 node --test scenes.test.mjs
