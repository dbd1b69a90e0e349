// `kinesphere bench monitoring`: what is certain about recorded tracks from few, late and noisy reports,
// beside alarms that take everybody to go straight on; and how few reports keep every pair decided.
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

/// `options` must live until the command line has been parsed.
CLI::App* add_bench_monitoring_command(CLI::App& bench, MonitoringOptions& options);
/// Returns the exit code. Throws ProgramError.
int bench_monitoring(const MonitoringOptions& options);

}  // namespace kinesphere::program
