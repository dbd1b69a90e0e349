// Acceleration limits of a track: those of its class and, while they are in force, those of plans.
#pragma once

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"
#include "kinesphere/monitor/report.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Returns the lengths of a vector: in the plane, along z, and in total.
inline ErrorBound lengths_of(const Vec3& v) {
  return ErrorBound::cylinder(norm({v.x, v.y, 0.0}), std::abs(v.z));
}

/// Summary of the plans of a track that exceed the limits of its class. Until `end`, accelerations differ
/// from the class's planned acceleration by at most `limit`, whether a plan is in force or not. From `end` on
/// they differ by at most the class's limit.
struct PlansBeyondClass {
  ErrorBound limit{};
  double end = -infinity;  ///< -infinity if there is no such plan.

  /// Returns the summary of a report's plan; empty if it has none or the plan is within the limits of the
  /// class.
  static PlansBeyondClass of(const TrackReport& report, const TrackClass& track_class) {
    if (!report.plan) return {};
    const Vec3 turn = report.plan->acceleration - track_class.planned_acceleration;
    const ErrorBound limit = (lengths_of(turn) + report.plan->acceleration_limit) * (1.0 + rounding::margin);
    if (turn == Vec3{} && is_within(report.plan->acceleration_limit, track_class.acceleration_limit))
      return {};
    if (is_within(limit, track_class.acceleration_limit)) return {};
    return {largest(limit, track_class.acceleration_limit), report.plan->valid_until};
  }

  /// Returns the largest difference from the class's planned acceleration at any time from `time` on.
  const ErrorBound& limit_from(double time, const TrackClass& track_class) const {
    return time < end ? limit : track_class.acceleration_limit;
  }
  /// Returns true if these plans allow every acceleration that `other` allows, at every time.
  bool include(const PlansBeyondClass& other) const {
    return other.end == -infinity || (other.end <= end && is_within(other.limit, limit));
  }
  friend PlansBeyondClass joined(const PlansBeyondClass& a, const PlansBeyondClass& b) {
    return {largest(a.limit, b.limit), std::max(a.end, b.end)};
  }

 private:
  static bool is_within(const ErrorBound& one, const ErrorBound& other) { return least(one, other) == one; }
};

}  // namespace kinesphere
