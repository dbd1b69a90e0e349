// `kinesphere-bench paper`: the list of its sections, and every number of them that no option gives.
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "base/program_error.hpp"
#include "base/standard_output.hpp"
#include "research/bench/commands.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {
namespace {

/// A section, in the order of the paper.
struct Section {
  std::string_view name;  ///< name for --only
  std::string_view title;
  void (*run)(const Report& report, const BenchSettings& settings);
};

constexpr Section sections[] = {
    {"cells", "Section 3.2: the cost model's choice of a cell size", bench_cells},
    {"trimming", "Section 3.3: candidates later than the reset left out", bench_trimming},
    {"figure5", "Figure 5: real time per simulated second", bench_figure5},
    {"figure6", "Figure 6: actual events", bench_figure6},
    {"table1", "Table 1: against Hubbard's broad phase, and others", bench_table1},
    {"circulation", "Section 4.3, figures 7 and 8: particles in a velocity field", bench_circulation},
    {"growth", "Section 4.2: O(log n) per event", bench_growth},
};

const BenchSettings& bench_settings(Effort effort) {
  static const BenchSettings quick{
      .name = "quick",
      .repetitions = 1,
      .figure_bodies = {20, 40},
      .figure_seconds = 0.2,
      .table1 = {{10, 0.2, 2}, {20, 0.1, 1}},
      .miss_seconds = 0.2,
      .circulation_bodies = 50,
      .circulation_seconds = 0.4,
      .snapshot_time = 0.2,
      .sequence_interval = 0.2,
      .growth_scales = {1, 2},
      .growth_seconds = 0.02,
      .growth_bodies = 2000,
      .trimming = {{40, 0.2, 1}},
      .cell_bodies = {40},
      .cell_speeds = {1.0},
      .cell_factors = {0.7, 1.0, 1.4},
      .cell_body_seconds = 4,
  };
  static const BenchSettings usual{
      .name = "usual",
      .repetitions = 3,
      .figure_bodies = {500, 1000, 1500, 2000, 2500, 3000, 3500},
      .figure_seconds = 4,
      .table1 = {{30, 15, 20}, {100, 15, 20}, {300, 15, 5}, {1000, 2, 5}},
      .miss_seconds = 15,
      .circulation_bodies = 1000,
      .circulation_seconds = 7,
      .snapshot_time = 2,
      .sequence_interval = 1,
      .growth_scales = {1, 2, 3, 5, 7, 10},
      .growth_seconds = 0.1,
      .growth_bodies = 27000,
      .trimming = {{500, 2, 1}, {1000, 1, 1}, {2000, 0.5, 1}},
      .cell_bodies = {250, 1000, 2000},
      .cell_speeds = {0.2, 1.0},
      .cell_factors = {0.35, 0.5, 0.7, 0.85, 1.0, 1.2, 1.4, 2.0, 2.8},
      .cell_body_seconds = 500,
  };
  static const BenchSettings full = [] {
    BenchSettings longer = usual;
    longer.name = "full";
    longer.repetitions = 5;
    longer.figure_seconds = 15;
    longer.table1 = {{30, 15, 50}, {100, 15, 50}, {300, 15, 50}, {1000, 15, 50}};
    longer.growth_seconds = 0.25;
    longer.growth_bodies = 125000;
    longer.trimming = {{500, 15, 1}, {1000, 15, 1}, {2000, 5, 1}, {3500, 2, 1}};
    longer.cell_body_seconds = 5000;
    return longer;
  }();
  return chosen(effort, quick, usual, full);
}

void bench_paper(const BenchOptions& options, const Report& report) {
  const BenchSettings& settings = bench_settings(options.effort());
  if (!report.draws()) {
    report.note(
        "gnuplot is not installed: curves are left as scripts (*.gp). On Debian, install gnuplot-nox and run "
        "`gnuplot *.gp` in that folder.");
  }
  report.note(fmt::format(
      "Effort {}, seeds from 1 on. Times are CPU time of this process from the moment when all bodies are "
      "in; medians of repetitions ({}), in which those who are compared take turns. Every row has the hash "
      "of all contacts from seed 1, to the last bit: it is the same in every run. Those of two detectors "
      "differ, as bounces magnify the last bit. Results go to {}.",
      settings.name, settings.repetitions, options.output));
  const auto begin = std::chrono::steady_clock::now();
  for (const Section& section : sections) {
    if (!options.has(section.name)) continue;
    report.heading(section.title);
    section.run(report, settings);
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  print("Done in {:.0f} s.\n", spent.count());
}

}  // namespace

Command add_paper(CLI::App& app) {
  return add_benchmark(app, {.name = "paper",
                             .description = "Repeat the paper's evaluation; takes minutes",
                             .full_description = "The paper's lengths and repetitions; takes an hour or more",
                             .parts = names_of_parts(sections),
                             .run = bench_paper});
}

}  // namespace kinesphere::program
