// `kinesphere-bench frames`: how evenly the cost of a game is spread over its frames.
#pragma once

#include <CLI/App.hpp>

#include "research/bench/options.hpp"

namespace kinesphere::program {

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_frames_command(CLI::App& bench, BenchOptions& options);
/// Runs the benchmark and returns the exit code. Throws ProgramError.
int bench_frames(const BenchOptions& options);

}  // namespace kinesphere::program
