// Goals of the default engine against its rivals, and verdicts on them.
#pragma once

#include <string>
#include <vector>

#include "research/bench/report.hpp"
#include "research/bench/speed/contest.hpp"

namespace kinesphere::program {

struct Verdict {
  std::string goal;    ///< its number in research/decisions.md
  std::string figure;  ///< what is measured
  std::string scene;
  std::string against;  ///< a rival and its settings; empty if there is none
  bool at_most;         ///< true: measured <= limit is wanted; false: measured >= limit
  double limit;
  double measured;

  bool met() const { return at_most ? measured <= limit : measured >= limit; }
};

/// Returns the verdicts on all goals with scenes and rivals among the results.
std::vector<Verdict> verdicts(const SpeedResults& results);

/// Returns a table with a row for each verdict.
ResultTable table_of(const std::vector<Verdict>& verdicts);

/// Saves the verdicts, and for each scene the slowest fixed steps that miss nothing.
void save_verdicts(const Report& report, const std::vector<SpeedScene>& scenes, const SpeedResults& results);

}  // namespace kinesphere::program
