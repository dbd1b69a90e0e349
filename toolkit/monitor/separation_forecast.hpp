// The verdict about two tracks and a separation, and the time until which it holds.
#pragma once

#include "monitor/reachable_set.hpp"
#include "monitor/track_estimate.hpp"

namespace kinesphere {

struct SeparationForecast {
  Verdict verdict = Verdict::undecided;
  /// A certain verdict holds until this time; +infinity if it holds beyond the horizon. Time alone decides an
  /// undecided pair no earlier than this.
  double until = 0.0;
};

/// Returns the verdict about a pair at time `now`, with a forecast up to `horizon`. A verdict that would be
/// certain for less than `least` (time, > 0) is undecided. Cost: about 100 ns for each pair of reachable
/// sets.
SeparationForecast forecast_of(const TrackEstimate& a, const TrackEstimate& b, const Components& separation,
                               double now, double horizon, double least);

/// Returns a time by which the pair certainly is within the separation, now or ahead, as far as that follows
/// from the distance at one moment; +infinity if none is found. Stays of at most `least` (time, > 0) may be
/// overlooked. Cost: that of 3 forecasts where nothing is near, of 64 at most.
double certain_within_by(const TrackEstimate& a, const TrackEstimate& b, const Components& separation,
                         double now, double least);

/// Limits of the distance between two tracks along one component (length).
struct DistanceBetween {
  double lower = 0.0;
  double upper = infinity;
};
DistanceBetween distance_between(const TrackEstimate& a, const TrackEstimate& b, const Component& component,
                                 double now);

}  // namespace kinesphere
