// Which sides of a box may a bound reach in a while? Some sums and products, where earliest_exit() takes
// roots.
#pragma once

#include "bound/quick_reject.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// The box, but without end, from -infinity to +infinity, on each axis on which no point of the bound comes
/// within `room` of a side for this time. The bound counts as one that moves straight on, with
/// radius_after(duration); that lies between its places now and then. Rounding is covered by `room` as in
/// QuickReject. A number that is none clears no axis.
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

/// Whether a box has an end on any axis.
inline bool has_sides(const Box& box) {
  return box.upper.x != infinity || box.upper.y != infinity || box.upper.z != infinity;
}

}  // namespace kinesphere
