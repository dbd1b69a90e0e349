// `kinesphere-bench gas`: collision rate and pressure of hard spheres, compared with theory.
#pragma once

#include <CLI/App.hpp>

#include "research/bench/options.hpp"

namespace kinesphere::program {

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_gas_command(CLI::App& bench, BenchOptions& options);
/// Runs the benchmark and returns the exit code. Throws ProgramError.
int bench_gas(const BenchOptions& options);

}  // namespace kinesphere::program
