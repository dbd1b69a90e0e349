#!/usr/bin/env bash
# Cross-compiles for Windows with MinGW-w64, and runs the tests of the library and of the C interface under Wine.
# Usage: windows.sh [<filter of GoogleTest>]
#   without a filter: all tests of the folders of src and toolkit but the longest
# Google Highway and RapidCheck for Windows are built from Debian's sources, which are taken from
# build/windows/sources/{highway,rapidcheck} if they are there.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh windows
build=$PWD/build/windows
prefix=$build/prefix
sources=$build/sources
mkdir -p "$sources"

# Usage: source_of <Debian's name of a source package>
source_of() {
  if [[ -e $sources/$1 ]]; then return; fi
  local lists=$sources/lists
  mkdir -p "$lists/partial"
  # The sources of the packages that this system takes.
  apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | sort -u >"$sources/list"
  local apt=(apt-get -q -o "Dir::Etc::sourcelist=$sources/list" -o Dir::Etc::sourceparts=/dev/null
    -o "Dir::State::lists=$lists" -o "Dir::Cache=$sources")
  (cd "$sources" && "${apt[@]}" update && "${apt[@]}" source --download-only "$1" && dpkg-source -x "$1"_*.dsc "$1.new") ||
    { echo "windows: apt-get has no sources of $1 here; put them into $sources/$1" >&2; exit 1; }
  mv "$sources/$1.new" "$sources/$1"
}
# Usage: cross <sources> <folder of the build> [options]
cross() {
  cmake -S "$1" -B "$build/$2" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/windows.cmake" -DCMAKE_BUILD_TYPE=Release \
    -DKINESPHERE_WINDOWS_PREFIX="$prefix" -DCMAKE_INSTALL_PREFIX="$prefix" "${@:3}"
}

if [[ ! -e $prefix/complete ]]; then
  source_of highway
  source_of rapidcheck
  cross "$sources/highway" highway -DBUILD_TESTING=OFF -DHWY_ENABLE_EXAMPLES=OFF -DHWY_ENABLE_CONTRIB=OFF
  cross /usr/src/googletest googletest -DBUILD_GMOCK=OFF
  cross "$sources/rapidcheck" rapidcheck -DRC_ENABLE_GTEST=ON
  for part in highway googletest rapidcheck; do cmake --build "$build/$part" --target install; done
  touch "$prefix/complete"
fi

# Results for the same flags as in the preset ci, with assertions.
cross . kinesphere -DCMAKE_CXX_FLAGS_RELEASE=-O3 -DKINESPHERE_BUILD_C=ON -DKINESPHERE_BUILD_TESTS=ON \
  -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
tests=(archive bodies bound contact core engine input monitor motion number parallel paths placement processor
  query simulation space world)
cmake --build "$build/kinesphere" --target kinesphere kinesphere_c scene_hash c_interface c_shared_scene shared_scene \
  "${tests[@]/#/test_}"

# Wine's own folder, and none of its messages.
export WINEPREFIX=$build/wine WINEDEBUG=-all DISPLAY='' RC_PARAMS=seed=2005
run() { wine "$@" </dev/null | tr -d '\r'; }
bin=$build/kinesphere/tests
if [[ $# == 0 ]]; then
  echo "the same hash as on Linux:"
  cp "$build"/kinesphere/c/*.dll "$bin/c/"
  expected=$(<tests/same_hash/shared_scene.txt)
  for program in shared_scene c_shared_scene; do
    hash=$(run "$bin/c/$program.exe" | sort -u)
    echo "$hash  $program"
    [[ $hash == "$expected" ]] || { echo "windows: it is $expected on Linux" >&2; exit 1; }
  done
  run "$bin/c/c_interface.exe"
fi
for test in "${tests[@]}"; do
  # The longest are those that ctest labels `long` (cmake/tests.cmake).
  long=$(sed -nE "s/^set\(kinesphere_long_$test +(.*)\)\$/\1/p; /^set\(kinesphere_long_$test\$/{n;s/^ *(.*)\)\$/\1/p}" cmake/tests.cmake)
  echo "test_$test:"
  run "$bin/test_$test.exe" --gtest_brief=1 --gtest_filter="${1:-*}-$long"
done
