// Figure 5: average time to simulate a second, over the number of spheres.
#include <fmt/format.h>

#include <utility>

#include "research/bench/measurement.hpp"
#include "research/bench/published.hpp"
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

}  // namespace kinesphere::program
