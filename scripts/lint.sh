#!/usr/bin/env bash
# Checks the format of all C++ and Python files, all sources but the tests with clang-tidy, and that neither the library nor the
# examples include the lab. The sources of a folder are checked together, as their headers take most of the time.
# Usage: lint.sh
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/lint

find include src programs browser/module python/module examples tests -name '*.[ch]pp' -print0 | xargs -0 clang-format --dry-run -Werror
/usr/bin/black --config python/pyproject.toml --quiet --diff --check python

if grep -rn '#include ["<]lab/' include examples src --exclude-dir=lab; then
  echo "lint: only the lab itself, the program and the tests may include the lab" >&2
  exit 1
fi

if grep -rnE '#include .*\.cpp[">]' include src programs browser python/module examples; then
  echo "lint: a source includes another" >&2
  exit 1
fi

# Nothing is built: a folder of its own, as clang cannot read headers that g++ has precompiled. A batch includes sources.
mkdir -p "$build"
mpi=OFF
if command -v mpicxx >/dev/null && find /usr/include /usr/local/include -name zoltan.h 2>/dev/null | grep -q .; then mpi=ON; fi
if [[ $mpi == OFF ]]; then echo "lint: without MPI and Zoltan, so clang-tidy leaves out src/distributed"; fi
cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
  -DCMAKE_CXX_FLAGS_RELEASE=-O3 -DKINESPHERE_BUILD_PROGRAM=ON -DKINESPHERE_BUILD_BENCH=ON \
  -DKINESPHERE_BUILD_MPI=$mpi >"$build/lint.log" 2>&1 ||
  { cat "$build/lint.log"; exit 1; }
if ! run-clang-tidy -quiet -p "$build" -j "$(nproc)" -checks=-bugprone-suspicious-include >"$build/lint.log" 2>&1; then
  # What was found, without the names of the files where nothing was; all of it if that is not known.
  grep -A 8 -E '(error|warning): ' "$build/lint.log" || cat "$build/lint.log"
  exit 1
fi
# All examples at once, each in a namespace of its own, as most of the time goes into their headers.
mapfile -t examples < <(find examples -maxdepth 1 -name '*.cpp' | sort)
{
  grep -h '^#include <' "${examples[@]}" | sort -u
  for example in "${examples[@]}"; do
    printf 'namespace %s {\n#include "%s"\n}\n' "$(basename "$example" .cpp)" "$PWD/$example"
  done
} >"$build/examples.cpp"
clang-tidy -quiet -checks=-bugprone-suspicious-include "$build/examples.cpp" -- -std=c++20 -Iinclude -I"$build/include" \
  >"$build/lint.log" 2>&1 || { cat "$build/lint.log"; exit 1; }
# The face for JavaScript, as emscripten's compiler reads it.
sysroot=/usr/share/emscripten/cache/sysroot
if [[ -d $sysroot ]]; then
  clang-tidy -quiet browser/module/*.cpp -- -target wasm32-unknown-emscripten --sysroot=$sysroot -isystem $sysroot/include/c++/v1 \
    -std=c++20 -Iinclude -Isrc -I"$build/include" 2>"$build/lint.log" || { cat "$build/lint.log"; exit 1; }
else
  echo "lint: without emscripten, so clang-tidy leaves out browser/module"
fi
# The one check that does not look into what a batch includes.
mapfile -t sources < <(grep -rlE '^ *using (\w+::)+\w+;' src programs examples --include='*.cpp')
clang-tidy -quiet -p "$build" -checks='-*,misc-unused-using-decls' "${sources[@]}" 2>"$build/lint.log"
