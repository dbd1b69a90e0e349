// `kinesphere-bench satellites`: every approach of satellites, by a monitor, by brute force and by fixed
// steps.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace kinesphere::program {

struct SatelliteOptions {
  std::string file;
  std::string output = "bench-satellites";
  std::string approaches;  ///< table to write; empty: none
  double days = 1.0;
  double distance = 5.0;  ///< km
  double window = 128.0;  ///< window of the monitor (s)
  std::uint32_t every = 1;
  std::uint32_t repetitions = 1;
  std::vector<double> steps{1.0, 10.0, 60.0};  ///< s
};

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_satellites_command(CLI::App& bench, SatelliteOptions& options);
/// Runs the benchmark and returns the exit code: exit_disagreement if the monitor has missed an approach, or
/// reported one that did not happen. Throws ProgramError.
int bench_satellites(const SatelliteOptions& options);

}  // namespace kinesphere::program
