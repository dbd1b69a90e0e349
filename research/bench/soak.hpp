// `kinesphere-bench soak`: a long run of a monitor on faulty reports, compared with the truth.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "research/monitoring/soak.hpp"

namespace kinesphere::program {

struct SoakOptions {
  SoakSettings settings;
  bool write = false;  ///< write the reports, for `kinesphere watch`
  std::string alerts;  ///< file with the alerts of `kinesphere watch` on these reports
};

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_soak_command(CLI::App& bench, SoakOptions& options);
/// Runs the soak and returns the exit code, which says if anything was missed or wrong. Throws ProgramError.
int bench_soak(const SoakOptions& options);

}  // namespace kinesphere::program
