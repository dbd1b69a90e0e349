// `kinesphere-bench monitoring`: certain statements about recorded tracks from few, late and noisy reports,
// beside alarms that extrapolate in straight lines; and the number of reports that keep every pair decided.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "research/monitoring/recorded_sky.hpp"
#include "tracks/reading_policy.hpp"

namespace kinesphere::program {

struct MonitoringOptions {
  std::vector<std::string> files;
  TrackOptions reading;
  double distance = 0.0;
  double look_ahead = 0.0;
  ReportingSettings reporting;
  double window = 1.0;
  std::uint64_t seeds = 3;
  std::vector<double> polling_tolerances;
};

/// Adds the command. `options` must live until the command line has been parsed.
CLI::App* add_bench_monitoring_command(CLI::App& bench, MonitoringOptions& options);
/// Runs the benchmark and returns the exit code. Throws ProgramError.
int bench_monitoring(const MonitoringOptions& options);

}  // namespace kinesphere::program
