// `kinesphere-bench`: measurements that anyone can repeat, and scenes under the algorithms of other papers.
#include <CLI/CLI.hpp>

#include "base/program_error.hpp"
#include "command_line.hpp"
#include "research/bench/detector_options.hpp"
#include "research/bench/frames.hpp"
#include "research/bench/gas.hpp"
#include "research/bench/monitoring.hpp"
#include "research/bench/paper.hpp"
#include "research/bench/paths.hpp"
#include "research/bench/shapes/shapes.hpp"
#include "research/bench/soak.hpp"
#include "research/bench/speed/speed.hpp"
#include "research/bench/vessels.hpp"
#include "scenes/run.hpp"
#include "scenes/verify.hpp"

int main(int argc, char** argv) {
  namespace program = kinesphere::program;
  CLI::App app("Measurements of Kinesphere, and comparisons with what was published.", "kinesphere-bench");
  program::BenchOptions paper_options{.output = "bench-paper", .only = {}};
  program::SpeedOptions speed_options{{.output = "bench-speed", .only = {}}, {}};
  program::BenchOptions gas_options{.output = "bench-gas", .only = {}};
  program::BenchOptions frames_options{.output = "bench-frames", .only = {}};
  program::BenchOptions shapes_options{.output = "bench-shapes", .only = {}};
  program::VesselOptions vessel_options;
  program::MonitoringOptions monitoring_options;
  program::SoakOptions soak_options;
  program::PathOptions path_options;
  program::RunOptions run_options;
  program::VerifyOptions verify_options;
  program::DetectorOptions detector_options;
  const CLI::App& paper = *add_bench_paper_command(app, paper_options);
  const CLI::App& speed = *add_bench_speed_command(app, speed_options);
  const CLI::App& gas = *add_bench_gas_command(app, gas_options);
  const CLI::App& frames = *add_bench_frames_command(app, frames_options);
  const CLI::App& shapes = *add_bench_shapes_command(app, shapes_options);
  const CLI::App& vessels = *add_bench_vessels_command(app, vessel_options);
  const CLI::App& monitoring = *add_bench_monitoring_command(app, monitoring_options);
  const CLI::App& soak = *add_bench_soak_command(app, soak_options);
  const CLI::App& paths = *add_bench_paths_command(app, path_options);
  CLI::App& run = *add_run_command(app, run_options);
  CLI::App& verify = *add_verify_command(app, verify_options);
  for (CLI::App* command : {&run, &verify}) add_detector_options(*command, detector_options);
  const auto run_command = [&] {
    if (paper) return bench_paper(paper_options);
    if (speed) return bench_speed(speed_options);
    if (gas) return bench_gas(gas_options);
    if (frames) return bench_frames(frames_options);
    if (shapes) return bench_shapes(shapes_options);
    if (vessels) return bench_vessels(vessel_options);
    if (monitoring) return bench_monitoring(monitoring_options);
    if (soak) return bench_soak(soak_options);
    if (paths) return bench_paths(path_options);
    if (run) {
      if (detector_options.name != "world" && (run_options.threads || !run_options.record.empty()))
        throw program::ProgramError("--threads, --record: expected only with --detector world");
      return program::run(run_options, detector_options.chosen());
    }
    return program::verify(verify_options, detector_options.chosen());
  };
  return program::run_program(app, run_command, argc, argv);
}
