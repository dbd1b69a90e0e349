// A body's bound as searches need it: with the room around it that is to be kept free.
#pragma once

#include <algorithm>

#include "bound/quick_reject.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

struct InflatedBound {
  BoundAt moved;  ///< moved on to the present
  double margin;  ///< length

  /// Around its way straight on for this long, in its largest size.
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
