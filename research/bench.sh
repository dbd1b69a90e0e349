#!/usr/bin/env bash
# Builds `kinesphere-bench` and measures the library against its rivals: tables go to research/results/, into
# a folder named after processor, cores and compiler. Takes half an hour; keep the machine quiet meanwhile.
# Arguments are passed on to `kinesphere-bench speed`, for instance: bench.sh --full
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh research
cmake --preset bench
cmake --build --preset bench

compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/bench/CMakeCache.txt)
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
machine=$(echo "${processor:-$(uname -m)} $(nproc) cores $("$compiler" --version | sed 's/^c++ /g++ /;1q' | cut -d' ' -f1) $("$compiler" -dumpversion)" |
  tr '[:upper:]' '[:lower:]' | tr -cs 'a-z0-9+\n' '-')
exec build/bench/research/kinesphere-bench speed --output "research/results/$machine" "$@"
