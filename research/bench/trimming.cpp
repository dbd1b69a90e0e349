// Section 3.3: candidates that come after the reset of their bound need not enter the event tree.
#include "research/bench/measurement.hpp"
#include "research/bench/sections.hpp"

namespace kinesphere::program {

void bench_trimming(const Report& report, const BenchSettings& settings) {
  ResultTable table({"n", "seconds", "trimming", "inserted", "removed", "largest_tree", "ms_per_second",
                     "time_ratio", "contacts", "hash"});
  bool same = true;
  for (const Trial& trial : settings.trimming) {
    const auto scenes = seeded_scenes(first_experiment(trial.bodies, trial.seconds), trial.seeds);
    const auto series =
        measure({paper_engine(), paper_engine({.trimming = false})}, scenes, settings.repetitions);
    for (const bool trimming : {true, false}) {
      const Series& one = series[trimming ? 0 : 1];
      const DetectorCounters& c = one.result().counters;
      table.row({std::uint64_t{trial.bodies}, trial.seconds, std::string(trimming ? "on" : "off"),
                 c.event_insertions, c.event_removals, c.largest_queue, 1e3 * one.per_simulated_second(),
                 ratio(one, series[0]).median, one.contacts(), one.hash()});
    }
    same = same && series[0].hash() == series[1].hash();
  }
  report.table("trimming", table);
  report.note(same ? "With and without, the contacts are the same to the last bit."
                   : "With and without, the contacts are NOT the same to the last bit.");
}

}  // namespace kinesphere::program
