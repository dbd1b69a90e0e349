// What the default engine is to reach against its rivals, and whether it does.
#pragma once

#include <string>
#include <vector>

#include "research/bench/report.hpp"
#include "research/bench/speed/contest.hpp"

namespace kinesphere::program {

struct Verdict {
  std::string goal;    ///< its number in docs/performance.md
  std::string figure;  ///< what is measured
  std::string scene;
  std::string against;  ///< a rival and its settings; empty where there is none
  bool at_most;         ///< measured <= limit is wanted, measured >= limit otherwise
  double limit;
  double measured;

  bool met() const { return at_most ? measured <= limit : measured >= limit; }
};

/// Of all goals whose scenes and rivals are among the results.
std::vector<Verdict> verdicts(const SpeedResults& results);

/// A line for each.
ResultTable table_of(const std::vector<Verdict>& verdicts);

/// The verdicts, and for each scene the slowest fixed steps that miss nothing.
void save_verdicts(const Report& report, const std::vector<SpeedScene>& scenes, const SpeedResults& results);

}  // namespace kinesphere::program
