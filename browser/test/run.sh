#!/usr/bin/env bash
# Builds the library in WebAssembly, its npm package and the viewer, and tests them: in Node.js, with and without SIMD, and
# the viewer, the map and the documentation's first page in chromium.
# Usage: run.sh <native program, for the hashes> [build | node | pages | site | accessible]
#   With a second argument only that part; the others need what `build` has built.
set -euo pipefail

program=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export KINESPHERE_PROGRAM=$program KINESPHERE_PACKAGE=$PWD/build/browser/browser/package
export KINESPHERE_VIEWER=$PWD/build/browser/browser/viewer
export PLAYWRIGHT=$PWD/build/browser/browser/viewer-sources/node_modules/playwright-core

build() {
  mkdir -p build/browser
  { cmake --preset browser && cmake --build --preset browser; } >build/browser/build.log 2>&1 ||
    { cat build/browser/build.log; return 1; }
}
node_tests() {
  cd browser/test
  node --test package.test.mjs answers.test.mjs body_map.test.mjs rigid_bodies.test.mjs monitor.test.mjs first_programs.test.mjs \
    shared_scene.test.mjs game_world.test.mjs consumer.test.mjs
  KINESPHERE_SIMD=1 node --test scenes.test.mjs
  KINESPHERE_SIMD=0 node --test scenes.test.mjs
}
pages() {
  cd browser/viewer/test
  node --test viewer.test.mjs served.test.mjs dragging.test.mjs pictures.test.mjs map.test.mjs \
    fields.test.mjs link.test.mjs pair.test.mjs
}
export KINESPHERE_SITE=$PWD/build/browser/site
site() {
  scripts/docs.sh --viewer "$KINESPHERE_SITE"
  node --test browser/viewer/test/first_page.test.mjs browser/viewer/test/two_bodies.test.mjs
}
# Takes minutes: all pages of the site that `site` has made.
accessible() {
  node --test browser/viewer/test/accessible.test.mjs
}

case ${2:-all} in
  build) build ;;
  node) node_tests ;;
  pages) pages ;;
  site) site ;;
  accessible) accessible ;;
  all) build; (node_tests); (pages); site; accessible ;;
  *) echo "run: no part is named $2" >&2; exit 1 ;;
esac
