// `kinesphere bench`: measurements that anyone can repeat.
#pragma once

#include <CLI/App.hpp>

#include "bench/monitoring.hpp"
#include "bench/options.hpp"
#include "bench/satellites.hpp"
#include "bench/soak.hpp"
#include "bench/speed/speed.hpp"
#include "bench/vessels.hpp"

namespace kinesphere::program {

struct BenchCommands {
  BenchOptions paper{.output = "bench-paper", .only = {}};
  SpeedOptions speed{{.output = "bench-speed", .only = {}}, {}};
  BenchOptions gas{.output = "bench-gas", .only = {}};
  VesselOptions vessels;
  MonitoringOptions monitoring;
  SoakOptions soak;
  SatelliteOptions satellites;
};

/// `commands` must live until the command line has been parsed.
CLI::App* add_bench_command(CLI::App& program, BenchCommands& commands);
/// Runs what the command line asked for. Returns the exit code. Throws ProgramError.
int bench(const CLI::App& command, const BenchCommands& commands);

}  // namespace kinesphere::program
