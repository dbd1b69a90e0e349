#!/usr/bin/env bash
# Breaks a copy of the sources on purpose, one deliberate bug of tests/mutants/ or research/tests/mutants/ at a time, and fails unless the test
# that the bug's file names notices. Each file is a patch; lines before it say what it does and, after "Caught by:",
# which test executable and which of its tests must fail. Arguments: names of files, if not all.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ $# -gt 0 ]]; then mutants=("$@"); else mutants=(tests/mutants/*.patch research/tests/mutants/*.patch); fi

copy=build/mutants/source
build=build/mutants/build
scripts/setup.sh test
rm -rf "$copy"
mkdir -p "$copy"
git ls-files -z CMakeLists.txt cmake include src toolkit distributed simulation research tests | xargs -0 cp --parents -t "$copy"
cmake -S "$copy" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
  -DKINESPHERE_BUILD_TESTS=ON -DKINESPHERE_BUILD_MPI=ON -DKINESPHERE_BUILD_RESEARCH=ON >/dev/null

apply() { (cd "$copy" && GIT_CEILING_DIRECTORIES=$PWD/.. git apply "$@"); }
caught_by() { sed -n 's/^Caught by: //p' "$1"; }
# Distributed tests run in three processes, also as root and on fewer cores.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
  OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none \
  HWLOC_COMPONENTS=-gl
# A hang counts as caught.
run_test() {
  local command=("$build/tests/$1")
  if [[ $1 == test_distributed ]]; then command=(mpirun -n 3 "$build/tests/distributed/$1"); fi
  RC_PARAMS=seed=2005 timeout 120 "${command[@]}" --gtest_brief=1 --gtest_filter="$2"
}

targets=$(for mutant in "${mutants[@]}"; do caught_by "$mutant" | cut -d' ' -f1; done | sort -u)
# shellcheck disable=SC2086
cmake --build "$build" --target $targets >"$build/build.log" 2>&1 || { cat "$build/build.log"; exit 1; }

# Runs each of these tests once.
while read -r executable filter; do
  run_test "$executable" "$filter" </dev/null >"$build/test.log" 2>&1 ||
    { tail -n 20 "$build/test.log"; echo "mutants: $executable $filter fails without a mutant already" >&2; exit 1; }
done < <(for mutant in "${mutants[@]}"; do caught_by "$mutant"; done | sort -u)

survivors=0
for mutant in "${mutants[@]}"; do
  read -r executable filter <<<"$(caught_by "$mutant")"
  apply "$PWD/$mutant"
  cmake --build "$build" --target "$executable" >"$build/build.log" 2>&1 || { cat "$build/build.log"; exit 1; }
  if run_test "$executable" "$filter" >"$build/test.log" 2>&1; then
    echo "SURVIVES  ${mutant##*/}  ($filter passes)"
    survivors=$((survivors + 1))
  else
    echo "caught    ${mutant##*/}  by $filter"
  fi
  apply -R "$PWD/$mutant"
done
[[ $survivors == 0 ]]
