#!/usr/bin/env bash
# Breaks a copy of the sources on purpose, one deliberate bug of tests/mutants/ or research/tests/mutants/ at a time, and
# fails unless the test that the bug names notices. A file has the bugs of one folder of the sources. Each begins with
# "Mutant: NAME" and what it does; after "Caught by:" comes which test executable and which of its tests must fail, then
# the patch.
# Usage: mutants.sh [--check] [NAME...]
#   NAME...   these mutants, or all
#   --check   only sees whether each patch applies, and the folder of its tests exists
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
files=(tests/mutants/*.patch research/tests/mutants/*.patch)
check=
if [[ ${1:-} == --check ]]; then check=1 && shift; fi
if [[ $# -gt 0 ]]; then mutants=("$@"); else mapfile -t mutants < <(sed -n 's/^Mutant: //p' "${files[@]}"); fi
# Prints one mutant, with its description.
mutant() { awk -v name="Mutant: $1" '/^Mutant: / { found = $0 == name } found' "${files[@]}"; }
for name in "${mutants[@]}"; do
  [[ $(grep -hcx "Mutant: $name" "${files[@]}" | awk "{ n += \$1 } END { print n }") == 1 ]] ||
    { echo "mutants: no mutant, or more than one, is called $name" >&2; exit 2; }
done

if [[ $check ]]; then
  bad=0
  for name in "${mutants[@]}"; do
    mutant "$name" | git apply --check - || { echo "mutants: $name does not apply" >&2; bad=1; }
    folder=$(mutant "$name" | sed -n 's/^Caught by: test_\([^ ]*\).*/\1/p')
    [[ -d tests/$folder || -d research/tests/${folder#research_} ]] ||
      { echo "mutants: $name is caught by tests in no folder that there is" >&2; bad=1; }
  done
  exit $bad
fi

copy=build/mutants/source
build=build/mutants/build
scripts/setup.sh test
rm -rf "$copy"
mkdir -p "$copy"
git ls-files -z CMakeLists.txt cmake include src toolkit distributed simulation programs research examples tests | xargs -0 cp --parents -t "$copy"
cmake -S "$copy" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
  -DKINESPHERE_BUILD_TESTS=ON -DKINESPHERE_BUILD_PROGRAM=ON -DKINESPHERE_BUILD_MPI=ON \
  -DKINESPHERE_BUILD_RESEARCH=ON >/dev/null

apply() { (cd "$copy" && GIT_CEILING_DIRECTORIES=$PWD/.. git apply "$@" -); }
caught_by() { mutant "$1" | sed -n 's/^Caught by: //p'; }
# Distributed tests run in three processes, also as root and on fewer cores.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
  OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none \
  HWLOC_COMPONENTS=-gl
# A hang counts as caught.
export KINESPHERE_ROUNDS=all
run_test() {
  local command=("$build/tests/$1")
  if [[ $1 == test_distributed ]]; then command=(mpirun -n 3 "$build/tests/distributed/$1"); fi
  RC_PARAMS=seed=2005 timeout 120 "${command[@]}" --gtest_brief=1 --gtest_filter="$2"
}

targets=$(for name in "${mutants[@]}"; do caught_by "$name" | cut -d' ' -f1; done | sort -u)
# shellcheck disable=SC2086
cmake --build "$build" --target $targets >"$build/build.log" 2>&1 || { cat "$build/build.log"; exit 1; }

# Runs each of these tests once.
while read -r executable filter; do
  run_test "$executable" "$filter" </dev/null >"$build/test.log" 2>&1 ||
    { tail -n 20 "$build/test.log"; echo "mutants: $executable $filter fails without a mutant already" >&2; exit 1; }
done < <(for name in "${mutants[@]}"; do caught_by "$name"; done | sort -u)

survivors=0
for name in "${mutants[@]}"; do
  read -r executable filter <<<"$(caught_by "$name")"
  mutant "$name" | apply
  cmake --build "$build" --target "$executable" >"$build/build.log" 2>&1 || { cat "$build/build.log"; exit 1; }
  status=0
  run_test "$executable" "$filter" >"$build/test.log" 2>&1 || status=$?
  case $status in
    0) echo "SURVIVES  $name  ($filter passes)" && survivors=$((survivors + 1)) ;;
    124) echo "caught    $name  by $filter, which hangs" ;;
    *) echo "caught    $name  by $filter" ;;
  esac
  mutant "$name" | apply -R
done
[[ $survivors == 0 ]]
