// Section 4.1: the certified iteration, the numerical root of the quartic and its closed form.
#include <fmt/format.h>

#include <utility>
#include <vector>

#include "bench/measurement.hpp"
#include "bench/meeting_solvers.hpp"
#include "bench/sections.hpp"

namespace kinesphere::program {
namespace {

/// What becomes of the paper's algorithm with each of them.
void compare_engines(const Report& report, const BenchSettings& settings) {
  ResultTable table({"n", "seconds", "solver", "ms_per_second", "time_ratio", "probes", "contacts", "hash"});
  constexpr std::pair<MeetingSolver, const char*> solvers[] = {{MeetingSolver::certified, "certified"},
                                                               {MeetingSolver::numeric, "numeric"},
                                                               {MeetingSolver::closed_form, "closed form"}};
  std::vector<NamedDetector> engines;
  for (const auto& [solver, name] : solvers) engines.push_back(paper_engine({.solver = solver}));
  for (const Trial& trial : settings.trimming) {
    const auto scenes = seeded_scenes(first_experiment(trial.bodies, trial.seconds), trial.seeds);
    const auto series = measure(engines, scenes, settings.repetitions);
    for (std::size_t k = 0; k < series.size(); ++k) {
      table.row({std::uint64_t{trial.bodies}, trial.seconds, std::string(solvers[k].second),
                 1e3 * series[k].per_simulated_second(), ratio(series[k], series[0]),
                 series[k].result().counters.probes, series[k].contacts(), series[k].hash()});
    }
  }
  report.note("The paper's algorithm with each of them, on the first experiment:");
  report.table("solvers_engine", table);
}

}  // namespace

void bench_solvers(const Report& report, const BenchSettings& settings) {
  report.note(fmt::format("{} pairs of bounds of each family, seed 1.", settings.solver_pairs));
  ResultTable table({"pairs", "solver", "ns", "late", "largest_lateness", "deepest_overlap", "missed",
                     "largest_earliness"});
  for (const MeetingSolverRow& row : compare_meeting_solvers(settings.solver_pairs)) {
    table.row({std::string(row.pairs), std::string(row.solver), row.nanoseconds, row.late_share,
               row.largest_lateness, row.deepest_overlap, row.missed_share, row.largest_earliness});
  }
  report.table("solvers", table);
  report.note(
      "late, missed: parts of the pairs that meet. A solver that is never late cannot overlook a contact.");
  compare_engines(report, settings);
}

}  // namespace kinesphere::program
