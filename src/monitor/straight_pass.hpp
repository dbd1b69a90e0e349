// How two tracks pass each other if both go straight on.
#pragma once

#include <algorithm>

#include "monitor/reachable_set.hpp"

namespace kinesphere {

/// Times are absolute. Estimates, not bounds.
struct StraightPass {
  double begin =
      infinity;  ///< The two first are within the separation, from now on; +infinity if they never are.
  double end = infinity;  ///< They are within it no longer. At least `begin`.
  double closest_time = 0.0;
  double closest_distance = 0.0;  ///< length; for a cylinder, in the plane

  /// Returns the time at which the two are closest while they are within the separation. Precondition: they
  /// ever are.
  double closest_within() const { return std::clamp(closest_time, begin, end); }
};

/// Returns how two tracks with these states at `now` pass each other. Cost: O(1).
StraightPass straight_pass(const State& first, const State& second, const Components& separation, double now);

}  // namespace kinesphere
