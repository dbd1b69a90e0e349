// What the single operations of the event-driven detectors cost: the figures from which a cell size follows.
#pragma once

#include <cstdint>

namespace kinesphere {

class Motion;

/// In nanoseconds, though only their ratios matter. The defaults are those of one machine, and fixed: with
/// them the cell size, and with it the whole run, is the same everywhere.
struct UnitCosts {
  double pair_test = 60.0;        ///< whether two bounds can meet before their next reset
  double visit = 8.0;             ///< of a body that stands in a neighbouring cell
  double tree_operation = 90.0;   ///< an insertion into the event tree, or a removal
  double cell_operation = 120.0;  ///< to find a cell in the subspace tree, enter it or leave it
  double probe = 250.0;           ///< a report, and the new bound's crossings, reset and walls

  static constexpr UnitCosts reference() { return {}; }
};

/// Measures them on this machine, for trees of as many bodies as `motion` has and for reports of it at
/// `time`, before which no velocity may have been set. Takes about 0.1 s. What is chosen by these costs
/// differs from run to run; with PaperOptions that is the order of work, so probes and counters, but no
/// contact beyond its promise.
UnitCosts calibrate_unit_costs(const Motion& motion, double time);

}  // namespace kinesphere
