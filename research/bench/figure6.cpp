// Figure 6: the number of actual events by kind, and the paper's remark that colliding events bound the
// others.
#include <fmt/format.h>

#include <algorithm>

#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {

void bench_figure6(const Report& report, const BenchSettings& settings) {
  report.note(
      fmt::format("{} s of the first experiment each, with the paper's algorithm.", settings.figure_seconds));
  ResultTable table({"n", "seed", "entering", "leaving", "resetting", "colliding", "each_below", "sum_below",
                     "sum_to_colliding", "hash"});
  for (const std::uint32_t bodies : settings.figure_bodies) {
    const auto scenes = seeded_scenes(first_experiment(bodies, settings.figure_seconds), 1);
    const Series series = measure({paper_engine()}, scenes, 1).front();
    const Run& run = series.runs.front();
    const std::uint64_t entering = run.count(&DetectorCounters::entering);
    const std::uint64_t leaving = run.count(&DetectorCounters::leaving);
    const std::uint64_t resetting = run.count(&DetectorCounters::resetting);
    const std::uint64_t colliding = run.count(&DetectorCounters::colliding);
    const std::uint64_t sum = entering + leaving + resetting;
    table.row({std::uint64_t{bodies}, std::uint64_t{1}, entering, leaving, resetting, colliding,
               std::max({entering, leaving, resetting}) <= colliding, sum <= colliding,
               static_cast<double>(sum) / static_cast<double>(colliding), series.hash()});
  }
  report.table("figure6", table);
  report.plot({.name = "figure6",
               .table = "figure6",
               .title = "The number of actual events",
               .y_label = "events",
               .curves = {{"colliding", "colliding"},
                          {"entering", "entering"},
                          {"leaving", "leaving"},
                          {"resetting", "resetting"}}});
  report.note(
      "The paper: \"The numbers of entering, leaving, and resetting events are bounded by the number of "
      "colliding events.\" Here: whether each of the three is at most that number, and whether their sum "
      "is.");
}

}  // namespace kinesphere::program
