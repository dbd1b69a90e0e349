// The axis-aligned box around a swept sphere during a span of time, in single precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "broadphase/swept_sphere.hpp"

namespace kinesphere {

/// Box in units of the swept sphere's frame. Coordinates may be infinite or NaN.
struct FloatAabb {
  std::array<float, 3> lower;
  std::array<float, 3> upper;

  float middle(std::size_t axis) const { return 0.5f * (lower[axis] + upper[axis]); }
  float width(std::size_t axis) const { return upper[axis] - lower[axis]; }
  /// Returns the greatest width on any axis; +infinity if a width is NaN.
  float widest() const {
    // Without a branch: which axis has it is unpredictable.
    const float widest = std::max({0.0f, width(0), width(1), width(2)});
    return std::isfinite(width(0) + width(1) + width(2)) ? widest : std::numeric_limits<float>::infinity();
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
