// `kinesphere bench speed`: what it costs to miss nothing, against what it costs to look now and then.
#pragma once

#include <CLI/App.hpp>
#include <optional>

#include "research/bench/options.hpp"

namespace kinesphere::program {

struct SpeedOptions : BenchOptions {
  std::optional<int> threads;  ///< compare these with one instead of rivals
};

/// `options` must live until the command line has been parsed.
CLI::App* add_bench_speed_command(CLI::App& bench, SpeedOptions& options);
/// Returns the exit code. Throws ProgramError.
int bench_speed(const SpeedOptions& options);

}  // namespace kinesphere::program
