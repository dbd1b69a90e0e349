// Growth of the cost of an event with the number of spheres, at constant density.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {
namespace {

/// Returns 1000 k^3 spheres in a box k times as long as the paper's.
SceneParameters scaled_experiment(std::uint32_t k, double seconds) {
  SceneParameters parameters = first_experiment(1000 * k * k * k, seconds);
  parameters.box.upper *= k;
  return parameters;
}

struct Cost {
  std::uint64_t events = 0;
  double nanoseconds = 0.0;  ///< for each event
  double pair_tests = 0.0;   ///< for each event
};

Cost cost_of(const Series& series, const std::vector<std::uint64_t DetectorCounters::*>& kinds) {
  Cost cost;
  double seconds = 0.0;
  double pair_tests = 0.0;
  for (const Run& run : series.runs) {
    for (const auto kind : kinds) cost.events += run.count(kind);
    seconds += run.simulating;
    pair_tests += static_cast<double>(run.count(&DetectorCounters::certificates));
  }
  cost.nanoseconds = 1e9 * seconds / static_cast<double>(cost.events);
  cost.pair_tests = pair_tests / static_cast<double>(cost.events);
  return cost;
}

}  // namespace

void bench_growth(const Report& report, const BenchSettings& settings) {
  report.note(fmt::format("{} s of the first experiment, in boxes as dense as that of 1000 spheres.",
                          settings.growth_seconds));
  ResultTable table({"n", "seeds", "paper_events", "tests_per_event", "paper_ns", "paper_ns_per_log2_n",
                     "world_steps", "world_ns", "world_ns_per_log2_n", "paper_setup_s", "world_setup_s",
                     "paper_hash", "world_hash"});
  for (const std::uint32_t k : settings.growth_scales) {
    const SceneParameters parameters = scaled_experiment(k, settings.growth_seconds);
    const std::uint64_t seeds = std::max(settings.growth_bodies / parameters.bodies, 1u);
    const auto series = measure({paper_engine(), world_engine()}, seeded_scenes(parameters, seeds), 1);
    const Cost paper = cost_of(series[0], {&DetectorCounters::entering, &DetectorCounters::leaving,
                                           &DetectorCounters::resetting, &DetectorCounters::colliding});
    const Cost world = cost_of(series[1], {&DetectorCounters::starts, &DetectorCounters::restarts,
                                           &DetectorCounters::pair_checks, &DetectorCounters::wall_checks});
    const double log_n = std::log2(parameters.bodies);
    table.row({std::uint64_t{parameters.bodies}, seeds, paper.events, paper.pair_tests, paper.nanoseconds,
               paper.nanoseconds / log_n, world.events, world.nanoseconds, world.nanoseconds / log_n,
               series[0].preparing(), series[1].preparing(), series[0].hash(), series[1].hash()});
  }
  report.table("growth", table);
  report.plot({.name = "growth",
               .table = "growth",
               .title = "Cost of an event at constant density",
               .y_label = "ns",
               .logarithmic = true,
               .curves = {{"paper_ns", "the paper''s algorithm, per event"},
                          {"world_ns", "default engine, per step"}}});
  report.note(
      "The paper: O(log n) per event, which would make \"per log2 n\" constant. The pair tests of an event "
      "tell whether its work grows; where only its time does, the trees have outgrown the caches.");
}

}  // namespace kinesphere::program
