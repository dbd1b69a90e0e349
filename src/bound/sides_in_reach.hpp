// Determines which sides of a box a bound may reach within a duration. Needs only sums and products, whereas
// earliest_exit() needs roots.
#pragma once

#include "bound/quick_reject.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Returns the box with infinite limits on each axis on which no point of the bound comes within `margin` of
/// a side during `duration`. The bound is treated as moving on a straight line with radius_after(duration),
/// so its extremes are at the start and the end. `margin` covers rounding as in QuickReject. NaN clears no
/// axis.
inline Box sides_in_reach(const BoundAt& bound, const Box& box, double duration, double margin) {
  const double reach = bound.radius_after(duration) + margin;
  Box near = box;
  for (int axis = 0; axis < 3; ++axis) {
    const double now = bound.centre[axis];
    const double then = now + bound.velocity[axis] * duration;
    const double least = box.lower[axis] + reach;
    const double greatest = box.upper[axis] - reach;
    if (!(least < now && now < greatest && least < then && then < greatest)) continue;
    near.lower[axis] = -infinity;
    near.upper[axis] = infinity;
  }
  return near;
}

/// True if a box has finite limits on any axis.
inline bool has_sides(const Box& box) {
  return box.upper.x != infinity || box.upper.y != infinity || box.upper.z != infinity;
}

}  // namespace kinesphere
