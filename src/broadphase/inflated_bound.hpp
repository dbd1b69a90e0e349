// A body's bound as searches need it: with a margin around it that has to be kept free.
#pragma once

#include <algorithm>

#include "bound/quick_reject.hpp"

namespace kinesphere {

struct InflatedBound {
  BoundAt moved;  ///< bound at the present time
  double margin;  ///< length

  /// Returns the box around the body's straight path during `duration`, with the largest radius in that time
  /// plus the margin.
  Box box_of_way(double duration) const {
    const Vec3 end = moved.centre + moved.velocity * duration;
    const double half = moved.radius_after(duration) + margin;
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(moved.centre[axis], end[axis]) - half;
      box.upper[axis] = std::max(moved.centre[axis], end[axis]) + half;
    }
    return box;
  }
};

}  // namespace kinesphere
