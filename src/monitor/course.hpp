// What is certain of two tracks and a separation, and until when.
#pragma once

#include <utility>

#include "monitor/claim.hpp"
#include "monitor/knowledge.hpp"

namespace kinesphere {

struct Course {
  Verdict verdict = Verdict::undecided;
  /// A certain verdict holds until then, +infinity if it does so beyond the horizon. An undecided one may be
  /// decided by the passing of time no earlier.
  double until = 0.0;
};

/// `least`: answers that would be certain for less than this (time, > 0) are not. Cost: some 100 ns for each
/// pair of claims.
Course course_of(const Knowledge& a, const Knowledge& b, const Components& separation, double now,
                 double horizon, double least);

/// Limits of the distance along one component.
struct DistanceBetween {
  double lower = 0.0;
  double upper = infinity;
};
DistanceBetween distance_between(const Knowledge& a, const Knowledge& b, const Component& component,
                                 double now);

}  // namespace kinesphere
