// Two balls that go straight on relative to each other and do not grow: when do they meet or part?
//
// All rounding is covered by the parameter `margin` (length). Precondition as in quick_reject.hpp: with
// positions and displacements up to L, it is at least 2^-49 L.
#pragma once

#include <cmath>

#include "bound/rounding.hpp"
#include "kinesphere/vec3.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

class StraightPair {
 public:
  /// `offset` and `velocity`: of one of the two, seen from the other. `radii`: their sum.
  StraightPair(const Vec3& offset, const Vec3& velocity, double radii)
      : offset_(offset), velocity_(velocity), radii_(radii) {}

  /// True if the two may be within `distance` now.
  bool are_near(double distance) const {
    const double reach = radii_ + distance;
    return !(norm_squared(offset_) > reach * reach);
  }

  /// Returns a time before which the two do not come within `distance` and the margin; +infinity if they
  /// never do. Precondition: they are farther apart.
  double meeting(double distance, double margin) const {
    const double reach = radii_ + distance + margin;
    const double rise = dot(offset_, velocity_);
    if (rise >= 0.0) return infinity;
    return rounding::first_crossing(norm_squared(offset_) - reach * reach, 2.0 * rise,
                                    2.0 * norm_squared(velocity_));
  }

  /// Returns a time before which the two stay within `distance`, less the margin, of each other; 0 if that is
  /// unknown, as where they are at this distance already. Their distance is a convex function of time
  /// (two_that_go_straight_stay_within), so a time is guessed, and then tried.
  double parting(double distance, double margin) const {
    const double reach = radii_ + distance - margin;
    const double room = (1.0 - 0x1p-40) * (reach * reach) - norm_squared(offset_);
    if (!(reach > 0.0 && room > 0.0)) return 0.0;
    if (velocity_ == Vec3{}) return infinity;
    const double speed = norm_squared(velocity_), rise = dot(offset_, velocity_);
    const double root = std::sqrt(rise * rise + speed * room);
    const double d = rise > 0.0 ? room / (rise + root) : (root - rise) / speed;
    return norm_squared(offset_ + velocity_ * d) < (1.0 - 0x1p-44) * (reach * reach) ? d : 0.0;
  }

 private:
  Vec3 offset_, velocity_;
  double radii_;
};

}  // namespace kinesphere
