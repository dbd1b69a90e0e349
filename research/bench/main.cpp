// `kinesphere-bench`: measurements that anyone can repeat, and scenes under the algorithms of other papers.
#include <CLI/CLI.hpp>
#include <vector>

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
  const auto add_commands = [&](CLI::App& app) {
    std::vector<program::Command> commands{
        {add_bench_paper_command(app, paper_options), [&] { return bench_paper(paper_options); }},
        {add_bench_speed_command(app, speed_options), [&] { return bench_speed(speed_options); }},
        {add_bench_gas_command(app, gas_options), [&] { return bench_gas(gas_options); }},
        {add_bench_frames_command(app, frames_options), [&] { return bench_frames(frames_options); }},
        {add_bench_shapes_command(app, shapes_options), [&] { return bench_shapes(shapes_options); }},
        {add_bench_vessels_command(app, vessel_options), [&] { return bench_vessels(vessel_options); }},
        {add_bench_monitoring_command(app, monitoring_options),
         [&] { return bench_monitoring(monitoring_options); }},
        {add_bench_soak_command(app, soak_options), [&] { return bench_soak(soak_options); }},
        {add_bench_paths_command(app, path_options), [&] { return bench_paths(path_options); }}};
    CLI::App* const run = add_run_command(app, run_options);
    CLI::App* const verify = add_verify_command(app, verify_options);
    for (CLI::App* command : {run, verify}) add_detector_options(*command, detector_options);
    commands.push_back(
        {run, [&] {
           if (detector_options.name != "world" && (run_options.threads || !run_options.record.empty()))
             throw program::ProgramError("--threads, --record: expected only with --detector world");
           return program::run(run_options, detector_options.chosen());
         }});
    commands.push_back({verify, [&] { return program::verify(verify_options, detector_options.chosen()); }});
    return commands;
  };
  return program::run_program(
      {.name = "kinesphere-bench",
       .description = "Measurements of Kinesphere, and comparisons with what was published.",
       .footer = {},
       .add_commands = {add_commands}},
      argc, argv);
}
