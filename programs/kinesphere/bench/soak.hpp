// `kinesphere bench soak`: a monitor that is fed faulty reports for long, against the truth.
#pragma once

#include <CLI/App.hpp>

#include "lab/monitoring/soak.hpp"

namespace kinesphere::program {

/// `settings` must live until the command line has been parsed.
void add_bench_soak_command(CLI::App& bench, SoakSettings& settings);
/// Returns the exit code, which tells whether anything was missed or wrong. Throws ProgramError.
int bench_soak(const SoakSettings& settings);

}  // namespace kinesphere::program
