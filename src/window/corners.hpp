// The box around a capsule's ball at the beginning and at the end of a span of time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "number/infinity.hpp"
#include "window/capsule.hpp"

namespace kinesphere {

/// In units of the capsule's frame. Some of them may be infinite or no numbers.
struct Corners {
  std::array<float, 3> lower;
  std::array<float, 3> upper;

  float middle(std::size_t axis) const { return 0.5f * (lower[axis] + upper[axis]); }
  float width(std::size_t axis) const { return upper[axis] - lower[axis]; }
  /// On any axis; infinite for what is not a number.
  float widest() const {
    float widest = 0.0f;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(width(axis) <= widest)) widest = width(axis);
    return widest < infinity ? widest : std::numeric_limits<float>::infinity();
  }
};

inline Corners corners_of(const Capsule& capsule, float from, float to) {
  Corners corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float first = capsule.centre[axis] + capsule.velocity[axis] * from;
    const float last = capsule.centre[axis] + capsule.velocity[axis] * to;
    corners.lower[axis] = std::min(first, last) - capsule.radius;
    corners.upper[axis] = std::max(first, last) + capsule.radius;
  }
  return corners;
}

}  // namespace kinesphere
