#!/usr/bin/env bash
# Has Coq check the proofs in proof/, and prints the theorems. Fails if one does not hold, is admitted, or rests upon
# more than the classical axioms of the real numbers. Usage: prove.sh [--installed | --mutants]
#   --installed   installs nothing
#   --mutants     breaks a copy of the kernels on purpose, one bug of proof/mutants/ at a time, and fails unless the
#                 proof of what they compute then fails
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ ${1:-} != --installed ]]; then scripts/setup.sh prove; fi

# The allowed axioms: classical logic, functional extensionality, and the definition of Coq's real numbers.
allowed='Classical_Prop.classic|FunctionalExtensionality.functional_extensionality_dep|ClassicalDedekindReals.sig_(not|forall)_dec'

# Checks the proofs in the present folder, which may have other kernels.
prove() {
  local files theorems
  if grep -nE '\b(Admitted|admit|Axiom|Parameter|Conjecture|Abort)\b' ./*.v; then
    echo "prove: these are no proofs" >&2
    return 1
  fi
  read -ra files <<<"$(coqdep -Q . Kinesphere -sort ./*.v)"
  for file in "${files[@]}"; do coqc -q -Q . Kinesphere "$file" || return 1; done
  theorems=$(sed -nE 's/^Theorem ([a-z_0-9]+).*/\1/p' ./*.v)
  {
    for file in "${files[@]}"; do echo "From Kinesphere Require $(basename "$file" .v)."; done
    # All theorems in one term, so that their common dependencies are traversed once.
    echo "Definition theorems := (tt"
    for theorem in $theorems; do
      file=$(grep -lE "^Theorem $theorem\b" ./*.v)
      echo "  , @$(basename "$file" .v).$theorem"
    done
    echo "). Print Assumptions theorems."
  } >assumptions.v
  coqc -q -Q . Kinesphere assumptions.v >axioms.txt || return 1
  if grep -vE '^( |Axioms:|Closed under the global context)' axioms.txt | sed 's/ .*//' | grep -vE "^($allowed)$"; then
    echo "prove: a theorem rests upon these" >&2
    return 1
  fi
  echo "proved, from the axioms of classical real numbers alone:"
  printf '  %s\n' $theorems
}

folder=build/proof
rm -rf "$folder"
mkdir -p "$folder"

if [[ ${1:-} != --mutants ]]; then
  cp proof/*.v "$folder"
  (cd "$folder" && prove)
  exit
fi

survivors=0
for mutant in $(sed -n 's/^Mutant: //p' proof/mutants/*.patch); do
  copy=$folder/$mutant
  mkdir -p "$copy/build"
  git ls-files -z src include tests/proof proof cmake | xargs -0 cp --parents -t "$copy"
  awk -v name="Mutant: $mutant" '/^Mutant: / { found = $0 == name } found' proof/mutants/*.patch |
    (cd "$copy" && GIT_CEILING_DIRECTORIES=$PWD/.. git apply -)
  g++ -std=c++20 -I"$copy/tests" -I"$copy/src" -I"$copy/include" -DKINESPHERE_KERNEL_TERMS="\"$copy/proof/kernels.v\"" \
    "$copy/tests/proof/kernel_terms_test.cpp" -lgtest_main -lgtest -o "$copy/build/terms"
  # The tie: the computed term must differ from the proved one.
  if "$copy/build/terms" >/dev/null 2>&1; then
    echo "SURVIVES  $mutant  (the terms are the same)"
    survivors=$((survivors + 1))
    continue
  fi
  # The proof: it must fail for the computed term.
  KINESPHERE_WRITE_KERNELS=1 "$copy/build/terms" --gtest_filter=KernelTerms.AreThoseThatHaveBeenProved >/dev/null 2>&1
  if (cd "$copy/proof" && prove >../build/proof.log 2>&1); then
    echo "SURVIVES  $mutant  (everything can still be proved)"
    survivors=$((survivors + 1))
  else
    echo "caught    $mutant  by $(grep -oE 'File "[^"]*", line [0-9]+' "$copy/build/proof.log" | head -n 1)"
  fi
done
[[ $survivors == 0 ]]
