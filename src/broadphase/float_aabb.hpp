// The box around a capsule's ball at the beginning and at the end of a span of time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "broadphase/swept_sphere.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// In units of the capsule's frame. Some of them may be infinite or no numbers.
struct FloatAabb {
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

inline FloatAabb float_aabb_of(const SweptSphere& sphere, float from, float to) {
  FloatAabb aabb;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float first = sphere.centre[axis] + sphere.velocity[axis] * from;
    const float last = sphere.centre[axis] + sphere.velocity[axis] * to;
    aabb.lower[axis] = std::min(first, last) - sphere.radius;
    aabb.upper[axis] = std::max(first, last) + sphere.radius;
  }
  return aabb;
}

}  // namespace kinesphere
