#!/usr/bin/env bash
# Builds distributed worlds and kinesphere-mpi with MPICH, and without Zoltan, and runs their tests.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh mpich
cmake --preset mpich
cmake --build build/mpich --target test_distributed test_program_mpi
# MPICH's ranks wait busily: more of them than processors take minutes for each test.
for ranks in $(seq "$(($(nproc) < 4 ? $(nproc) : 4))"); do
  echo "on $ranks ranks:"
  mpiexec.mpich -n "$ranks" build/mpich/tests/distributed/test_distributed --gtest_brief=1 </dev/null
done
build/mpich/tests/program_mpi/test_program_mpi --gtest_brief=1
