// Figures 5 and 6: the time to simulate a second, and the actual events by kind, over the number of spheres.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {

void bench_figure5(const Report& report, const BenchSettings& settings) {
  report.note(fmt::format("{} s of the first experiment each.", settings.figure_seconds));
  ResultTable table({"n", "seed", "contacts", "paper_ms", "paper_ms_low", "paper_ms_high", "world_ms",
                     "world_ms_low", "world_ms_high", "paper_to_world", "paper_to_world_low",
                     "paper_to_world_high", "published_ms", "speedup", "paper_hash", "world_hash"});
  bool known = false;
  for (const std::uint32_t bodies : settings.figure_bodies) {
    const auto scenes = seeded_scenes(first_experiment(bodies, settings.figure_seconds), 1);
    const auto series = measure({paper_engine(), world_engine()}, scenes, settings.repetitions);
    const Spread paper = series[0].spread(), world = series[1].spread(),
                 to_world = ratio(series[0], series[1]);
    const auto published = published_times(bodies);
    known = known || published;
    table.row(
        {std::uint64_t{bodies}, std::uint64_t{1}, series[0].contacts(), 1e3 * paper.median, 1e3 * paper.low,
         1e3 * paper.high, 1e3 * world.median, 1e3 * world.low, 1e3 * world.high, to_world.median,
         to_world.low, to_world.high, published ? Cell(1e3 * published->proposed) : Cell(),
         published ? Cell(published->proposed / paper.median) : Cell(), series[0].hash(), series[1].hash()});
  }
  report.table("figure5", table);
  std::vector<Curve> curves{{.column = "paper_ms", .title = "the paper''s algorithm", .error_bars = true},
                            {.column = "world_ms", .title = "default engine", .error_bars = true}};
  if (known) curves.push_back({"published_ms", "published (MIPS R10000, 195 MHz)", false});
  report.plot({.name = "figure5",
               .table = "figure5",
               .title = "Average processing time",
               .y_label = "ms per simulated second",
               .curves = std::move(curves)});
  report.note(
      "Published: MIPS R10000, 195 MHz, the one value that is given as a number. Speedup: of the paper's "
      "algorithm on this machine over that.");
}

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
