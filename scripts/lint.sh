#!/usr/bin/env bash
# Checks the format of all C++ and Python files, the names, and that dependencies point one way: research/ may use
# everything, programs and simulation/ the library, the library nothing. Then clang-tidy checks all sources but the tests
# and research/, or those of research/ alone. The sources of a target are checked together, as their headers take most of
# the time.
# Usage: lint.sh [text | research]
#   text: without clang-tidy, in seconds
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/lint
part=${1:-all}
if [[ ! $part =~ ^(all|text|research)$ ]]; then echo "lint: usage: lint.sh [text | research]" >&2 && exit 2; fi

find include src toolkit distributed c simulation programs research browser/module python/module examples tests \( -name '*.[ch]' -o -name '*.[ch]pp' \) \
  -print0 | xargs -0 clang-format --dry-run -Werror
/usr/bin/black --config python/pyproject.toml --quiet --diff --check python docs scripts packaging interface

scripts/set_version.sh

# What other languages repeat of the header of C is generated from it.
python3 -B interface/generate.py --check

if grep -rn '#include ["<]\(simulation\|research\)/' include examples src toolkit distributed c ||
  grep -rn '#include ["<]research/' simulation programs browser python tests; then
  echo "lint: the library may not include simulation/, and nothing but research/ itself may include research/" >&2
  exit 1
fi
if grep -rn '#include ["<]kinesphere\.h[">]' include src toolkit distributed simulation programs research browser python; then
  echo "lint: the C interface is for users; nothing here but c/ and its examples and tests may include it" >&2
  exit 1
fi

# The folders of src and then of toolkit, in the order of docs/architecture.md: each includes only those before it.
engine=(number input archive parallel bound space contact bodies core processor engine query recording world)
toolkit=(placement motion paths monitor)
if ! diff <(printf '%s\n' "${engine[@]}" | sort) <(basename -a src/*/ | sort) ||
  ! diff <(printf '%s\n' "${toolkit[@]}" | sort) <(basename -a toolkit/*/ | sort); then
  echo "lint: scripts/lint.sh and docs/architecture.md must list all folders of src and toolkit" >&2
  exit 1
fi
# Scripts that not every change runs name folders of tests.
for script in scripts/{sanitize,windows}.sh; do
  for room in $(tr '\n' ' ' <"$script" | grep -oP ' (rooms|tests)=\(\K[a-z][^)]*'); do
    if [[ ! -d tests/$room ]]; then echo "lint: $script names tests/$room, which there is not" >&2 && exit 1; fi
  done
done
# Usage: includes_only_earlier <folder> <prefix of its rooms in includes> <room>...
includes_only_earlier() {
  local folder=$1 prefix=$2 k later
  shift 2
  for ((k = 1; k < $#; ++k)); do
    later=$(IFS='|' && echo "${*:k+1}")
    if grep -rnE "#include \"$prefix($later)/" "$folder/${!k}"; then
      echo "lint: $folder/${!k} may include only folders that docs/architecture.md lists before it" >&2
      exit 1
    fi
  done
}
includes_only_earlier src '' "${engine[@]}"
includes_only_earlier toolkit '' "${toolkit[@]}"
of_toolkit=$(IFS='|' && echo "${toolkit[*]}")
if grep -rnE "#include \"($of_toolkit)/" src distributed; then
  echo "lint: src is the engine and knows nothing of toolkit, which stands on it" >&2
  exit 1
fi
if grep -rnE '#include "distributed/' src toolkit simulation c programs/kinesphere; then
  echo "lint: distributed/ is for worlds over MPI; the library and its other users may not include it" >&2
  exit 1
fi
includes_only_earlier programs/kinesphere '' base formats serving scenes tracks view watch
includes_only_earlier programs/kinesphere/formats formats/ fields nmea tables recordings streams
includes_only_earlier programs/kinesphere/watch watch/ source clock tracks monitor policy output
beyond_input=$(IFS='|' && echo "${engine[*]:2}")
if grep -rnE "#include \"($beyond_input|$of_toolkit|distributed)/" c; then
  echo "lint: of src, c/ may include number/ and input/ alone" >&2
  exit 1
fi

if grep -rnE '#include .*\.cpp[">]' include src toolkit distributed c simulation programs research browser python/module examples; then
  echo "lint: a source includes another" >&2
  exit 1
fi

# Functions that IEEE 754 does not round correctly, of which each machine has its own; plain_gap.cpp is for audits alone.
if grep -rnE 'std::(a?(sin|cos|tan)h?|atan2|exp(2|m1)?|log(2|10|1p)?|pow|cbrt|hypot|fma|[lt]gamma|erfc?)\(' src toolkit distributed include \
  --exclude=plain_gap.cpp; then
  echo "lint: results of the library must be equal on every machine; src/number/angles.hpp has sines" >&2
  exit 1
fi

# Names that the glossary has replaced. The CHANGELOG and docs/migration.md may use them.
retired='Islands|KickComparison|LatePairs|PartSize|BodyKick|KeptContacts|Answerer|Agenda|HotPair|Unsettled|FoundPairs|Outlook'
retired+='|Judgement|Horizons|ContactBook|RecentContacts|WhileTrue|StillDue|WindowLayer|CapsuleTable|RoomyBound|Tempo|Pacing'
retired+='|MovedBound|SizeLevels|KnownSpace|Parcel|Outbox|LocalWorld|PhasePart|DanglingLinks|PairShare|ReportNeed'
retired+='|ScopedFlag|UntoldEvents|OpenRecord|FixedDefinition|add_fixed|tell_violations|report_violations|refuse_violations|refilter|set_timing|FramesDefinition|SteeredDefinition'
retired+='|growth_acceleration|set_velocity_all|WithoutProbe'
# A plain search: in a clone of another user git refuses to search, which would pass for success.
if grep -rnwE "$retired" . --include='*.'{cpp,hpp,md,v,py,ts} --exclude={CHANGELOG,migration}.md \
  --exclude-dir={.git,build,node_modules,_skbuild}; then
  echo "lint: these names are retired: docs/glossary.md has those to use" >&2
  exit 1
fi

# How many files, but for tests, docs and what is generated, name one example of what a recipe of CONTRIBUTING.md adds. The numbers only
# fall: a change that lowers one lowers it here and in the recipe.
recipes=(
  'already_?touching 9 a field of an event'
  'radius_?rate 19 a field of a body'
  'zeno_?interval 21 a field of the definition of a world'
  'Triangle 44 a static shape'
  'earliest_?approach 11 a query'
  'sbs 8 a format of messages'
)
# The lines that interface/generate.py has not written, each after the name of its file.
hand_written='FNR == 1 { made = /Generated from include\/kinesphere\.h/; part = 0 }
  /generated from kinesphere\.h: / { part = 1 } !made && !part { print FILENAME ":" $0 } /end of what is generated/ { part = 0 }'
for recipe in "${recipes[@]}"; do
  read -r word most what <<<"$recipe"
  files=$(grep -rliwE "$word" browser c csharp distributed include programs python rust simulation src toolkit \
    --include='*.'{c,cpp,cs,h,hpp,map,py,pyi,rs,ts} --exclude-dir={build,dist,examples,node_modules,target,test,tests,_skbuild} |
    xargs awk "$hand_written" | grep -iwE "$word" | cut -d : -f 1 | sort -u | wc -l)
  if [[ $files != "$most" ]] || ! grep -q "| $what | .* | $most |" CONTRIBUTING.md; then
    echo "lint: $files files name $word; scripts/lint.sh and CONTRIBUTING.md say $most for $what, which may only fall" >&2
    exit 1
  fi
done

# Fields that languages hand on are in no file there that was written by hand.
bindings=(c csharp/src rust/src browser/module browser/package/src python/module python/kinesphere)
for word in 'already_?touching' 'prediction_?confirmation' 'spread_?window_?starts'; do
  if find "${bindings[@]}" -regex '.*\.\(cpp\|cs\|hpp\|py\|pyi\|rs\|ts\)' -print0 | xargs -0 awk "$hand_written" | grep -iwE "$word"; then
    echo "lint: interface/generate.py writes what languages repeat of a field; a binding names $word by hand" >&2
    exit 1
  fi
done

scripts/mutants.sh --check

# The headers under another compiler's standard library, libc++, where Emscripten is there.
if command -v em++ >/dev/null; then
  find include/kinesphere -name '*.hpp' ! -path '*/distributed/*' ! -name kinesphere.hpp -printf '#include "%p"\n' |
    em++ -std=c++20 -Wall -Wextra -Werror -fsyntax-only -Iinclude -x c++ -
fi

if [[ $part == text ]]; then exit; fi

# Nothing is built: a folder of its own, since clang cannot read headers that g++ has precompiled. A batch includes
# sources.
mkdir -p "$build"
mpi=OFF
if command -v mpicxx >/dev/null && find /usr/include /usr/local/include -name zoltan.h 2>/dev/null | grep -q .; then mpi=ON; fi
if [[ $mpi == OFF ]]; then echo "lint: without MPI and Zoltan, so clang-tidy leaves out distributed"; fi
declare -A batches_of=([target]=1 [file]=file)
for batch in target file; do
  cmake -S . -B "$build/$batch" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -DCMAKE_CXX_FLAGS_RELEASE=-O3 -DKINESPHERE_WARNINGS=ON -DKINESPHERE_BATCH=${batches_of[$batch]} -DKINESPHERE_BUILD_PROGRAM=ON -DKINESPHERE_BUILD_RESEARCH=ON \
    -DKINESPHERE_BUILD_MPI=$mpi -DKINESPHERE_BUILD_C=ON >"$build/lint.log" 2>&1 ||
    { cat "$build/lint.log"; exit 1; }
done
# Prints the findings of clang-tidy and nothing else; on any other failure its whole output.
tidy() {
  local said
  said=$(clang-tidy -quiet "$@" 2>&1) || { grep -A 8 -E '(error|warning): ' <<<"$said" || echo "$said"; return 1; }
}
export -f tidy
# Each line of this file is a call of clang-tidy. They run in parallel, the longest first.
calls=$build/calls
check() { printf '%q ' tidy "$@" >>"$calls" && echo >>"$calls"; }
: >"$calls"
batches=-checks=-bugprone-suspicious-include,-misc-unused-using-decls
research_paths="^$PWD/($build/target/)?research/"
of_part() { if [[ $part == research ]]; then grep -E "$research_paths"; else grep -vE "$research_paths"; fi; }
mapfile -t sources < <(sed -n 's/^ *"file": "\(.*\)".*/\1/p' "$build/target/compile_commands.json" | of_part)
for source in "${sources[@]}"; do check -p "$build/target" $batches "$source"; done
# The check that skips included batches, classes and functions.
using() { grep -rlE '^using [^=]*::[^=]*;' "$@" --include='*.cpp' || true; }
unused=-checks=-*,misc-unused-using-decls
if [[ $part == research ]]; then folders=(research); else folders=(src toolkit distributed c simulation programs examples); fi
for source in $(using "${folders[@]}"); do check -p "$build/file" "$unused" "$source"; done

check_examples() {
  # Checks all examples at once, each in a namespace of its own, since their headers take most of the time.
  local examples
  mapfile -t examples < <(find examples -maxdepth 1 -name '*.cpp' | sort)
  {
    grep -h '^#include <' "${examples[@]}" | sort -u
    for example in "${examples[@]}"; do
      printf 'namespace %s {\n#include "%s"\n}\n' "$(basename "$example" .cpp)" "$PWD/$example"
    done
  } >"$build/examples.cpp"
  check $batches "$build/examples.cpp" -- -std=c++20 -Iinclude -I"$build/target/include"
}

# Checks the JavaScript interface with emscripten's headers.
check_browser() {
  local sysroot=/usr/share/emscripten/cache/sysroot
  if [[ ! -d $sysroot ]]; then echo "lint: without emscripten, so clang-tidy leaves out browser/module" && return; fi
  local wasm=(-target wasm32-unknown-emscripten --sysroot=$sysroot -isystem $sysroot/include/c++/v1 -std=c++20 -I.
    -Iinclude -Isrc -Itoolkit -I"$build/target/include")
  printf "#include \"$PWD/%s\"\n" browser/module/*.cpp >"$build/faces.cpp"
  check $batches "$build/faces.cpp" -- "${wasm[@]}"
  for source in $(using browser/module); do check "$unused" "$source" -- "${wasm[@]}"; done
}

if [[ $part == all ]]; then check_examples && check_browser; fi
xargs -P "$(nproc)" -d '\n' -n 1 bash -c <"$calls"
