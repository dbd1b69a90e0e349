// Queries about shapes at rest: gap to a region, and first hit by a moving sphere.
#pragma once

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Limits of the gap between a box and a shape: they are certainly apart if lower > 0, and certainly touch if
/// upper <= 0. Only the signs are meaningful; the magnitudes are not distances.
GapLimits gap_limits(const Box& region, const HalfSpace& shape);
GapLimits gap_limits(const Box& region, const Box& shape);
GapLimits gap_limits(const Box& region, const Triangle& shape);
GapLimits gap_limits(const Box& region, const Mesh& shape);

/// Distance along a ray at which a shape is met: at least `lower`, and at most `upper` if it is certainly
/// met.
struct RayLimits {
  double lower;  ///< infinite if the shape is certainly not met
  double upper;  ///< infinite if the shape may not be met
};

/// Intersects the path of a sphere with a shape. Precondition: sphere.velocity is a unit vector, so that
/// times equal distances along the path.
template <class Solid>
RayLimits first_touch(const Bound& sphere, const Solid& shape, double length);
RayLimits first_touch(const Bound& sphere, const Mesh& shape, double length);

}  // namespace kinesphere
