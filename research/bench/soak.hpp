// `kinesphere bench soak`: a monitor that is fed faulty reports for long, against the truth.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "research/monitoring/soak.hpp"

namespace kinesphere::program {

struct SoakOptions {
  SoakSettings settings;
  bool write = false;  ///< the reports, for `kinesphere watch`
  std::string alerts;  ///< what it told of them
};

/// `options` must live until the command line has been parsed.
CLI::App* add_bench_soak_command(CLI::App& bench, SoakOptions& options);
/// Returns the exit code, which tells whether anything was missed or wrong. Throws ProgramError.
int bench_soak(const SoakOptions& options);

}  // namespace kinesphere::program
