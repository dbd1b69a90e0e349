// `kinesphere-bench speed`: the cost of missing nothing, compared with the cost of looking now and then.
#pragma once

#include <CLI/App.hpp>
#include <optional>

#include "research/bench/options.hpp"

namespace kinesphere::program {

struct SpeedOptions : BenchOptions {
  std::optional<int> threads;  ///< compare this many threads with one, instead of rivals
};

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_speed_command(CLI::App& bench, SpeedOptions& options);
/// Runs the benchmark and returns the exit code. Throws ProgramError.
int bench_speed(const SpeedOptions& options);

}  // namespace kinesphere::program
