// Section 4.1: the certified iteration, the numerical root of the quartic and its closed form.
#include <fmt/format.h>

#include "bench/meeting_solvers.hpp"
#include "bench/sections.hpp"

namespace kinesphere::program {

void bench_solvers(const Report& report) {
  report.note(fmt::format("{} pairs of bounds of each family, seed 1.", report.settings().solver_pairs));
  ResultTable table({"pairs", "solver", "ns", "late", "largest_lateness", "deepest_overlap", "missed",
                     "largest_earliness"});
  for (const MeetingSolverRow& row : compare_meeting_solvers(report.settings().solver_pairs)) {
    table.row({std::string(row.pairs), std::string(row.solver), row.nanoseconds, row.late_share,
               row.largest_lateness, row.deepest_overlap, row.missed_share, row.largest_earliness});
  }
  report.table("solvers", table);
  report.note(
      "late, missed: parts of the pairs that meet. A solver that is never late cannot overlook a contact.");
}

}  // namespace kinesphere::program
