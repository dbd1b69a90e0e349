// What is certain of two tracks and a separation, and until when.
#pragma once

#include <utility>

#include "monitor/reachable_set.hpp"
#include "monitor/track_estimate.hpp"

namespace kinesphere {

struct SeparationForecast {
  Verdict verdict = Verdict::undecided;
  /// A certain verdict holds until then, +infinity if it does so beyond the horizon. An undecided one may be
  /// decided by the passing of time no earlier.
  double until = 0.0;
};

/// `least`: answers that would be certain for less than this (time, > 0) are not. Cost: some 100 ns for each
/// pair of claims.
SeparationForecast forecast_of(const TrackEstimate& a, const TrackEstimate& b, const Components& separation,
                               double now, double horizon, double least);

/// Limits of the distance along one component.
struct DistanceBetween {
  double lower = 0.0;
  double upper = infinity;
};
DistanceBetween distance_between(const TrackEstimate& a, const TrackEstimate& b, const Component& component,
                                 double now);

}  // namespace kinesphere
