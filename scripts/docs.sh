#!/usr/bin/env bash
# Builds the documentation site, static files for any web server: the guides (MkDocs with Material), and the references of
# C++ and C (Doxygen), Python, and TypeScript (TypeDoc, if asked for or installed already). Any warning, broken link or
# public symbol without a description fails. Look at it with: python3 -m http.server --directory build/docs/site
# The first page runs the library in WebAssembly, which takes a minute to build, once, and build tools from npm.
# Without Emscripten and npm it has a film instead, and says so.
# Usage: docs.sh [--typescript] [--viewer] [--still] [output folder, else build/docs/site]
#   --typescript: gets TypeDoc from npm, once
#   --viewer: builds the viewer, too (in minutes), and the first page leads to it
#   --still: the film, also where the library could be built
# KINESPHERE_PYTHON names an interpreter that has the Python package; if there is none the package is built, in minutes.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
typescript=no
viewer=no
live=yes
while [[ ${1:-} == --* ]]; do
  case $1 in
    --typescript) typescript=yes ;;
    --viewer) viewer=yes ;;
    --still) live=no ;;
    *) echo "docs: there is no option $1" >&2 && exit 2 ;;
  esac
  shift
done
work=$PWD/build/docs
site=$(realpath -m "${1:-$work/site}")
if [[ -n $(ls -A "$site" 2>/dev/null || true) && ! -e $site/search/search_index.json ]]; then
  echo "docs: $site is no site, so it is not replaced" >&2
  exit 1
fi
scripts/setup.sh docs
mkdir -p "$work" && rm -rf "$work/generated" "$site"
export KINESPHERE_GENERATED=$work/generated
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; echo "docs: failed: $1" >&2; exit 1; }; }

# A wheel of the package in a virtual environment of its own, anew after a change of its sources.
python=${KINESPHERE_PYTHON:-}
if [[ ! -x $python ]]; then python=$work/python/bin/python; fi
if [[ $python == "$work"/* ]] && { [[ ! -e $work/python/made ]] || [[ -n $(find python/module python/kinesphere -newer "$work/python/made") ]]; }; then
  echo "docs: building the Python package for its reference"
  rm -rf "$work/python"
  quietly /usr/bin/python3 -m venv --system-site-packages --without-pip "$work/python"
  quietly env -C python /usr/bin/python3 setup.py -q egg_info --egg-base "$work" sdist --dist-dir "$work/python"
  quietly /usr/bin/python3 -m pip --isolated --python "$python" install --no-build-isolation --no-index --no-deps \
    "$work"/python/kinesphere-*.tar.gz
  touch "$work/python/made"
fi
quietly "$python" scripts/docs/python_reference.py "$KINESPHERE_GENERATED/reference/python.md"

tools=$work/typedoc
typedoc=$tools/node_modules/.bin/typedoc
if [[ $typescript == yes && ! -x $typedoc ]]; then
  mkdir -p "$tools" && cp scripts/docs/package.json scripts/docs/package-lock.json "$tools"
  quietly npm --prefix "$tools" ci --no-audit --no-fund
fi

if [[ $viewer == yes ]]; then scripts/setup.sh browser; fi
if ! command -v emcc >/dev/null || ! command -v npm >/dev/null; then
  if [[ $live == yes ]]; then echo "docs: the first page has a film: emcc and npm would make it live"; fi
  live=no
fi
targets=()
if [[ $live == yes ]]; then targets+=(live); fi
if [[ $viewer == yes ]]; then targets+=(viewer) && export KINESPHERE_VIEWER=yes; fi
if [[ ${#targets[@]} -gt 0 ]]; then
  echo "docs: building for browsers: ${targets[*]}"
  quietly cmake --preset browser
  quietly cmake --build --preset browser --target "${targets[@]}"
fi
if [[ $live == yes ]]; then export KINESPHERE_LIVE=$PWD/build/browser/browser/live; fi
# Before MkDocs, whose search has the names of this reference, too.
version=$(sed -n 's/^project(kinesphere VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
mkdir -p "$KINESPHERE_GENERATED"
doxygen - <<<"$(cat scripts/docs/Doxyfile)
PROJECT_NUMBER = $version
OUTPUT_DIRECTORY = $KINESPHERE_GENERATED"

address=$(sed -nE 's/^project\(kinesphere .*HOMEPAGE_URL "(.+)"$/\1/p' CMakeLists.txt)
if [[ -n $address ]]; then export KINESPHERE_REPOSITORY=$address; fi
/usr/bin/python3 -m mkdocs build --strict --quiet --site-dir "$site"
mv "$KINESPHERE_GENERATED/cpp" "$site/reference/cpp"
if [[ $viewer == yes ]]; then
  cp -r build/browser/browser/viewer "$site/viewer"
  # The other page of the viewer's folder needs a watch that runs.
  rm "$site"/viewer/map.html "$site"/viewer/assets/{map,coast}-*
fi

if [[ -x $typedoc ]]; then
  rm -rf "$tools/src" && cp -r browser/package/src browser/package/tsconfig.json browser/package/README.md scripts/docs/typedoc.json "$tools"
  quietly env -C "$tools" "$typedoc" --out "$site/reference/typescript"
else
  echo "docs: without the reference of TypeScript: --typescript gets TypeDoc"
fi

/usr/bin/python3 scripts/docs/check_links.py "$site"
