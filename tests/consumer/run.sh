#!/usr/bin/env bash
# Installs a build of the library into a temporary folder, moves it, and builds the project next to this script against it:
# through find_package, and through pkg-config. For all compiler flags of the user, the library adds none, and its results
# equal those of this build. Only the headers of include/ and the version are installed. Without options the library alone
# is built, with nothing but a compiler and Google Highway. If the component mpi was built, the project in mpi/ is built
# against it and run as one rank; otherwise find_package reports that it is missing, and its headers are not installed. If
# the C interface was built, an example in C is built against it, by CMake without C++ and by pkg-config.
# Usage: run.sh <build folder> <library folder under the prefix> <compiler> <compiler flags> <executable scene_hash>
#   <1 with the component mpi, 0 without>
set -euo pipefail

build=$1 libdir=$2 compiler=$3 flags=$4 scene_hash=$5 mpi=$6
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/before" >"$work/install.log"
prefix=$work/after
mv "$work/before" "$prefix"
export LD_LIBRARY_PATH=$prefix/$libdir

echo "installed headers:"
(cd "$prefix/include" && find . -type f | sort) >"$work/headers"
left_out=()
if [[ -e $prefix/include/kinesphere.h ]]; then c_headers=(./kinesphere.h); else c_headers=(); fi
if [[ $mpi == 0 ]]; then left_out=(-not -path './kinesphere/distributed/*'); fi
(cd "$source/../../include" &&
  { find . -name '*.hpp' "${left_out[@]}"; printf '%s\n' ./kinesphere/version.hpp "${c_headers[@]}"; } | sort) |
  diff - "$work/headers"
if find "$prefix" -name '*kinesphere_simulation*' | grep .; then
  echo "consumer: simulation/ is installed" >&2
  exit 1
fi
wc -l <"$work/headers"

echo "with find_package:"
cmake -S "$source" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >"$work/configure.log"
cmake --build "$work/build"
"$work/build/consumer"
if grep -r INTERFACE_COMPILE_OPTIONS "$prefix/$libdir/cmake"; then
  echo "consumer: compiler flags are forced upon users of the CMake package" >&2
  exit 1
fi

echo "with the component mpi:"
configure_mpi() {
  cmake -S "$source/mpi" -B "$work/mpi" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" >"$work/configure.log" 2>&1
}
if [[ $mpi == 1 ]]; then
  configure_mpi || { cat "$work/configure.log"; exit 1; }
  cmake --build "$work/mpi"
  # Without hwloc's search for X displays (see tests/CMakeLists.txt), which takes long if localhost does not resolve.
  HWLOC_COMPONENTS=-gl "$work/mpi/mpi_consumer"
elif configure_mpi; then
  echo "consumer: the component mpi was found, but not built" >&2
  exit 1
else
  # CMake breaks lines.
  tr -s ' \n' ' ' <"$work/configure.log" | grep -o 'its component mpi was not built' ||
    { cat "$work/configure.log"; exit 1; }
fi

echo "with pkg-config:"
export PKG_CONFIG_PATH=$prefix/$libdir/pkgconfig
read -r -a link < <(pkg-config --cflags --libs kinesphere)
if pkg-config --cflags kinesphere | tr ' ' '\n' | grep -v -e '^-I' -e '^$'; then
  echo "consumer: compiler flags are forced upon users of pkg-config" >&2
  exit 1
fi
# Splits the flags into words.
read -r -a flags <<<"$flags"
"$compiler" -std=c++20 "${flags[@]}" "$source/main.cpp" "${link[@]}" -o "$work/consumer"
"$work/consumer"

expected=$("$scene_hash")
fused=()
if grep -qw fma /proc/cpuinfo; then fused=(-mfma -ffp-contract=fast); fi
# Without inlining the linker has copies of inline functions to choose from.
for optimisation in "-O2 -fno-inline" "-O3"; do
  read -r -a optimised <<<"$optimisation"
  "$compiler" -std=c++20 "${flags[@]}" "${optimised[@]}" "${fused[@]}" "$source/../same_hash/scene_hash.cpp" \
    "${link[@]}" -o "$work/scene_hash"
  hash=$("$work/scene_hash")
  echo "$hash  with $optimisation ${fused[*]}, and $expected in this build"
  [[ $hash == "$expected" ]] || { echo "consumer: results depend on its flags" >&2 && exit 1; }
done

# Programs in C cannot load a library that sanitizers check.
if [[ ${#c_headers[@]} -gt 0 && "${flags[*]}" != *sanitize* ]]; then
  echo "in C:"
  game=$source/../../examples/c/monitor.c
  cmake -S "$source/c" -B "$work/c" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DSOURCE="$game" >"$work/configure.log"
  cmake --build "$work/c"
  "$work/c/consumer" | tail -n 1
  read -r -a link < <(pkg-config --cflags --libs kinesphere-c)
  cc -std=c11 "$game" "${link[@]}" -lm -o "$work/consumer_c"
  "$work/consumer_c" | tail -n 1
fi

echo "without options:"
missing=()
for package in CLI11 fmt nlohmann_json ZLIB GTest rapidcheck MPI Zoltan; do missing+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
cmake -S "$source/../.." -B "$work/plain" -DCMAKE_CXX_COMPILER="$compiler" "${missing[@]}" -G Ninja >"$work/configure.log"
targets=$(cmake --build "$work/plain" --target help)
grep -o 'libkinesphere[^:]*' <<<"$targets" | head -n 1
if grep -E 'kinesphere_program|kinesphere_simulation|kinesphere_mpi|example_|test_|scene_hash' <<<"$targets"; then
  echo "consumer: more than the library is built without options" >&2
  exit 1
fi
