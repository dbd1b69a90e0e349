// Table 1, continued: Hubbard's broad phase as the paper words it, which finds all crossings of faces within
// an interval whose length it does not tell.
#include <fmt/format.h>

#include <algorithm>

#include "bench/measurement.hpp"
#include "bench/published.hpp"
#include "bench/sections.hpp"

namespace kinesphere::program {
namespace {

constexpr HubbardOptions intervals[] = {{0.0, false}, {0.0, true}, {0.01, true},
                                        {0.1, true},  {0.3, true}, {1.0, true}};

double per_rebuild(const Run& run) {
  const auto rebuilds = static_cast<double>(run.count(&Counters::rebuilds));
  return static_cast<double>(run.count(&Counters::crossings)) / std::max(1.0, rebuilds);
}

}  // namespace

void bench_intervals(const Report& report, const BenchSettings& settings) {
  ResultTable table({"n", "seconds", "interval", "crossings", "rebuilds_per_s", "crossings_per_rebuild",
                     "hubbard_s", "paper_s", "ratio", "published_ratio", "hash"});
  for (const Trial& trial : settings.intervals) {
    const auto published = published_times(trial.bodies);
    for (const HubbardOptions& options : intervals) {
      const SceneParameters parameters = first_experiment(trial.bodies, trial.seconds);
      const auto series =
          measure({paper_engine(), hubbard_engine(options)}, seeded_scenes(parameters, trial.seeds), 1);
      const Run& hubbard = series[1].runs.front();
      const double rebuilds = static_cast<double>(hubbard.count(&Counters::rebuilds));
      table.row({std::uint64_t{trial.bodies}, trial.seconds,
                 options.interval > 0.0 ? Cell(options.interval) : Cell(std::string("adapted")),
                 std::string(options.all_crossings ? "all" : "to the first meeting"),
                 rebuilds / hubbard.result.simulated_time, per_rebuild(hubbard),
                 series[1].per_simulated_second(), series[0].per_simulated_second(),
                 ratio(series[1], series[0]), published ? Cell(published->ratio) : Cell(), series[1].hash()});
    }
  }
  report.table("intervals", table);
  report.note(
      "The paper says that intersections are found \"for each set of line segments\", and not in what "
      "interval "
      "of time. The longer it is, the more faces cross in it, and the wider its bounds are. Contacts are the "
      "same whatever the interval; rebuilds and probes are not.");
}

}  // namespace kinesphere::program
