#!/usr/bin/env bash
# Checks the format of all C++ files, all sources but the tests with clang-tidy, and that neither the library nor the
# examples include the lab.
# Usage: lint.sh [build folder with compile_commands.json; default: build/ci]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/ci}

find include src programs examples tests -name '*.[ch]pp' -print0 | xargs -0 clang-format --dry-run -Werror
if grep -rn '#include ["<]lab/' include examples src --exclude-dir=lab; then
  echo "lint: only the lab itself, the program and the tests may include the lab" >&2
  exit 1
fi
# The build may have been made for g++, whose warnings clang does not all know.
if ! run-clang-tidy -quiet -p "$build" -j "$(nproc)" -extra-arg=-Wno-unknown-warning-option "^$PWD/(src|programs|examples)/" >"$build/lint.log" 2>&1; then
  # What was found, without the names of the files where nothing was; all of it if that is not known.
  grep -A 8 -E '(error|warning): ' "$build/lint.log" || cat "$build/lint.log"
  exit 1
fi
