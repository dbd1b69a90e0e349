#!/usr/bin/env bash
# Brings the sources of the library into foreign projects, by FetchContent and by add_subdirectory.
#   configure   looks at what would be compiled: the library alone, optimised even if the project does not say how to
#               build, by one flag that is the library's own; and compiles all public headers as part of projects with
#               strict warnings as errors, without exceptions, in C++23, by g++, clang++ and, if there, with libc++.
#   build       builds such a project, with global flags that are hostile to the library, and runs it: its results are
#               those of all systems, and of the given program.
#   native      the same without flags, on other systems, whose compilers may not know them.
# Usage: embedded.sh configure <compiler> | build <compiler> <executable scene_hash> | native <compiler>
set -euo pipefail

what=$1 compiler=$2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
repository=$(cd "$source/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Usage: configure <fetched | subdirectory> [options]
configure() {
  cmake -S "$source/$1" -B "$work/$1" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DFETCHCONTENT_SOURCE_DIR_KINESPHERE="$repository" -DKINESPHERE="$repository" "${@:2}" >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
}
fail() {
  echo "embedded: $*" >&2
  exit 1
}

if [[ $what != configure ]]; then
  flags="no flags"
  if [[ $what == build ]]; then
    flags="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror -fno-exceptions -fno-rtti -ffast-math"
    configure fetched -DCMAKE_CXX_FLAGS="$flags"
  else
    configure fetched
  fi
  # One compilation after the other, beside other tests.
  cmake --build "$work/fetched" --parallel 1
  "$work/fetched/consumer"
  hash=$("$work/fetched/shared_scene" | tr -d '\r' | sort -u)
  echo "$hash  with $flags"
  [[ $hash == "$(<"$source/../same_hash/shared_scene.txt")" ]] || fail "results are not those of other systems"
  if [[ $what == build && $("$work/fetched/scene_hash") != $("$3") ]]; then fail "results depend on flags of the project"; fi
  exit 0
fi

for way in fetched subdirectory; do
  configure $way
  commands=$(grep '"command"' "$work/$way/compile_commands.json")
  library=$(grep -E 'kinesphere(_rare)?\.dir' <<<"$commands")
  echo "$way: $(wc -l <<<"$library") sources of the library, optimised"
  if grep -v -- ' -O3 ' <<<"$library"; then fail "the library is not optimised in a project without a build type"; fi
  if grep 'consumer\.dir' <<<"$commands" | grep -e ' -O' -e ' -W' -e '-ffp-contract'; then
    fail "flags of the library are forced upon the project"
  fi
  if grep -vE '(kinesphere|kinesphere_rare|consumer|scene_hash|shared_scene)\.dir' <<<"$commands"; then
    fail "more than the library is built"
  fi
done
# A project that does say how to build is obeyed.
configure fetched -DCMAKE_BUILD_TYPE=Debug
if grep -E 'kinesphere(_rare)?\.dir' "$work/fetched/compile_commands.json" | grep -e ' -O[123]'; then
  fail "the library is optimised in a debug build"
fi

version=$(find "$work/fetched" -name version.hpp)
(cd "$repository/include" && find kinesphere -name '*.hpp' -not -path '*/distributed/*' | sort) |
  sed 's/.*/#include <&>/' >"$work/all.cpp"
echo 'int main() { return kinesphere::version.empty(); }' >>"$work/all.cpp"
sed -i '1i #include <kinesphere/version.hpp>' "$work/all.cpp"
strict=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wdouble-promotion
  -Wnon-virtual-dtor -Woverloaded-virtual -pedantic-errors -Werror)
projects=("g++ -std=c++20" "g++ -std=c++20 -fno-exceptions" "g++ -std=c++23")
if command -v clang++ >/dev/null; then
  projects+=("clang++ -std=c++20 -Wmicrosoft" "clang++ -std=c++2b -fno-exceptions")
  if clang++ -stdlib=libc++ -std=c++20 -include version -x c++ -fsyntax-only /dev/null 2>/dev/null; then
    projects+=("clang++ -std=c++20 -stdlib=libc++ -fno-exceptions" "clang++ -std=c++2b -stdlib=libc++")
  fi
fi
for project in "${projects[@]}"; do
  read -r -a command <<<"$project"
  "${command[@]}" "${strict[@]}" -fsyntax-only -I"$repository/include" -I"${version%/kinesphere/version.hpp}" "$work/all.cpp"
  echo "public headers: clean by $project"
done
