#!/usr/bin/env bash
# Runs one scene with the library built by both compilers, at several optimisation levels and with sanitizers. Fails unless
# all of them, and the given build of tests/same_hash/scene_hash.cpp, have equal events bit for bit, and replay a recording
# of that build without a divergence. Repeats this for a user of each build who compiles the headers in ways that change
# rounding, without inlining, so that the linker chooses among copies of inline functions.
# Usage: same_hash.sh [<the executable scene_hash> [<name of a build>]]
#   Without an executable, builds the one of the preset ci. With a name, makes that build only, on one core.
set -euo pipefail

if [[ $# -gt 0 ]]; then scene_hash=$(realpath "$1"); fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ $# == 0 ]]; then
  cmake --preset ci
  cmake --build --preset ci --target scene_hash
  scene_hash=$PWD/build/ci/tests/scene_hash
fi

# Name, compiler and flags of each build, besides the given one: both compilers with all features of this processor
# (-march=native enables fused multiply-add and wider vectors), once as a shared library; and one without optimisation,
# with sanitizers.
configurations=(
  "clang-O0-sanitized clang++ -O0 -fsanitize=address,undefined -fno-sanitize-recover=all"
  "gcc-O3-native g++ -O3 -DNDEBUG -march=native"
  "clang-O3-native-shared clang++ -O3 -DNDEBUG -march=native"
)

foreign_flags=(-std=c++20 -O2 -fno-inline -ffp-contract=fast)
if grep -qw fma /proc/cpuinfo; then foreign_flags+=(-mfma); fi

mkdir -p build/hash
jobs=()
if [[ $# -gt 1 ]]; then
  jobs=(--parallel 1)
  named=$(printf '%s\n' "${configurations[@]}" | grep "^$2 ") || { echo "same_hash: no build is named $2" >&2; exit 1; }
  configurations=("$named")
fi
recording=$(mktemp build/hash/recording-XXXXXX)
trap 'rm -f "$recording"' EXIT
expected=$("$scene_hash" record "$recording")
echo "$expected  $scene_hash"
different=0
for configuration in "${configurations[@]}"; do
  read -r name compiler flags <<<"$configuration"
  build=build/hash/$name
  mkdir -p "$build"
  # All public headers, for all of their inline functions.
  (cd include && find kinesphere -name '*.hpp' | sort | sed 's/.*/#include <&>/') >"$build/every_header.cpp"
  shared=OFF
  if [[ $name == *shared ]]; then shared=ON; fi
  if ! { cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" \
           -DCMAKE_BUILD_TYPE=None -DKINESPHERE_BUILD_TESTS=ON \
           -DBUILD_SHARED_LIBS="$shared" &&
         cmake --build "$build" --target scene_hash "${jobs[@]}"; } >"$build/build.log" 2>&1; then
    cat "$build/build.log"
    exit 1
  fi
  hash=$("$build/tests/scene_hash")
  replayed=$("$build/tests/scene_hash" replay "$recording" || true)
  # g++ has an option to emit every inline function, used or not.
  keep=()
  if [[ $compiler == g++ ]]; then keep=(-fkeep-inline-functions); fi
  library=("$build"/src/libkinesphere.*)
  read -r -a flags <<<"$flags"
  "$compiler" "${flags[@]}" "${foreign_flags[@]}" "${keep[@]}" -Iinclude -I"$build/include" \
    tests/same_hash/scene_hash.cpp "$build/every_header.cpp" "${library[0]}" -lhwy -Wl,-rpath,"$PWD/$build/src" \
    -o "$build/foreign_user"
  foreign=$("$build/foreign_user")
  echo "$hash  ${replayed:-diverged}  $foreign  $name"
  if [[ $hash != "$expected" || $replayed != "$expected" || $foreign != "$expected" ]]; then
    different=$((different + 1))
  fi
done

if [[ $different != 0 ]]; then
  echo "same_hash: $different of ${#configurations[@]} builds find other events, or other ones in the recording" >&2
  exit 1
fi
