#!/usr/bin/env bash
# Installs a build of the library into a temporary folder, moves it, and builds the project beside this
# script against it: through find_package, and through pkg-config.
# Usage: run.sh <build folder> <library folder under the prefix> <compiler> <compiler flags>
set -euo pipefail

build=$1 libdir=$2 compiler=$3 flags=$4
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/before" >"$work/install.log"
prefix=$work/after
mv "$work/before" "$prefix"
export LD_LIBRARY_PATH=$prefix/$libdir

echo "with find_package:"
cmake -S "$source" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >"$work/configure.log"
cmake --build "$work/build"
"$work/build/consumer"

echo "with pkg-config:"
export PKG_CONFIG_PATH=$prefix/$libdir/pkgconfig
# Flags are lists of words.
# shellcheck disable=SC2046,SC2086
"$compiler" -std=c++20 $flags "$source/main.cpp" $(pkg-config --cflags --libs kinesphere) -o "$work/consumer"
"$work/consumer"
