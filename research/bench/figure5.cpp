// Figure 5: average time to simulate a second, over the number of spheres.
#include <fmt/format.h>

#include <utility>

#include "research/bench/measurement.hpp"
#include "research/bench/published.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {

void bench_figure5(const Report& report, const BenchSettings& settings) {
  report.note(fmt::format("{} s of the first experiment each.", settings.figure_seconds));
  ResultTable table({"n", "seed", "contacts", "paper_ms", "world_ms", "paper_to_world", "published_ms",
                     "speedup", "paper_hash", "world_hash"});
  bool known = false;
  for (const std::uint32_t bodies : settings.figure_bodies) {
    const auto scenes = seeded_scenes(first_experiment(bodies, settings.figure_seconds), 1);
    const auto series = measure({paper_engine(), world_engine()}, scenes, settings.repetitions);
    const double paper = series[0].per_simulated_second();
    const auto published = published_times(bodies);
    known = known || published;
    table.row({std::uint64_t{bodies}, std::uint64_t{1}, series[0].contacts(), 1e3 * paper,
               1e3 * series[1].per_simulated_second(), ratio(series[0], series[1]),
               published ? Cell(1e3 * published->proposed) : Cell(),
               published ? Cell(published->proposed / paper) : Cell(), series[0].hash(), series[1].hash()});
  }
  report.table("figure5", table);
  std::vector<Curve> curves{{"paper_ms", "the paper''s algorithm"}, {"world_ms", "default engine"}};
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
