// `kinesphere-bench shapes`: first contacts of capsules, clusters of balls and boxes that turn, beside FCL.
#pragma once

#include <CLI/App.hpp>

#include "research/bench/options.hpp"

namespace kinesphere::program {

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_shapes_command(CLI::App& bench, BenchOptions& options);
/// Runs the benchmark and returns the exit code. Throws ProgramError.
int bench_shapes(const BenchOptions& options);

}  // namespace kinesphere::program
