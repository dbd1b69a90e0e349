// How two tracks pass each other if both go straight on.
#pragma once

#include <algorithm>

#include "monitor/reachable_set.hpp"

namespace kinesphere {

/// Times are absolute. Estimates, not bounds.
struct StraightPass {
  double begin = infinity;  ///< when the two are first within the separation; +infinity if never
  double end = infinity;    ///< when they are no longer within it; at least `begin`
  double closest_time = 0.0;
  double closest_distance = 0.0;  ///< length; for a cylinder, in the plane

  /// Returns the time at which the two are closest while they are within the separation. Precondition: they
  /// ever are.
  double closest_within() const { return std::clamp(closest_time, begin, end); }
};

/// Returns how two tracks with these states at `now` pass each other. Cost: O(1).
StraightPass straight_pass(const State& first, const State& second, const Components& separation, double now);

/// Returns the time until which two tracks that go straight on can still avoid the pass: from then on no
/// accelerations, of which the difference is at most `limit`, keep them out of the separation. `now` if it is
/// too late, +infinity if the pass never is within, or if the separation is that of well clear. An estimate:
/// at this time all places that the two can reach at one moment are within. Cost: about 80 evaluations of the
/// distance.
double avoidable_until(const State& first, const State& second, const ErrorBound& limit,
                       const Components& separation, const StraightPass& pass, double now);

}  // namespace kinesphere
