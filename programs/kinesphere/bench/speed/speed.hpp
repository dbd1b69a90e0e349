// `kinesphere bench speed`: what it costs to miss nothing, against what it costs to look now and then.
#pragma once

#include <CLI/App.hpp>

#include "bench/options.hpp"

namespace kinesphere::program {

/// `options` must live until the command line has been parsed.
void add_bench_speed_command(CLI::App& bench, BenchOptions& options);
/// Returns the exit code. Throws ProgramError.
int bench_speed(const BenchOptions& options);

}  // namespace kinesphere::program
