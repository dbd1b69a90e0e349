// The support function of boxes and triangles, and the size of their coordinates.
#pragma once

#include <algorithm>

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// How far a shape reaches in a direction: the greatest dot product of the direction and a point of the
/// shape.
inline double reach(const Box& box, const Vec3& direction) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    sum += std::max(direction[axis] * box.lower[axis], direction[axis] * box.upper[axis]);
  return sum;
}

inline double reach(const Triangle& t, const Vec3& direction) {
  return std::max({dot(direction, t.a), dot(direction, t.b), dot(direction, t.c)});
}

/// What goes into a computation about a shape, for margins. Sums, so that a number that is none spoils them.
inline double size_of(const Box& box) { return norm_one(box.lower) + norm_one(box.upper); }
inline double size_of(const Triangle& t) { return norm_one(t.a) + norm_one(t.b) + norm_one(t.c); }

}  // namespace kinesphere
