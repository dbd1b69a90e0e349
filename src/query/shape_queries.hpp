// What queries ask of shapes at rest: how far a region is from one, and when a way meets it.
#pragma once

#include "kinesphere/shape.hpp"

namespace kinesphere {

/// How far the surfaces of a box and a shape are apart: certainly apart where `lower` is above zero,
/// certainly touching where `upper` is not; between these, only the signs mean something.
GapLimits gap_limits(const Box& region, const HalfSpace& shape);
GapLimits gap_limits(const Box& region, const Box& shape);
GapLimits gap_limits(const Box& region, const Triangle& shape);

/// The part of a way after which a shape is met: at least `lower`; at most `upper`, if it certainly is met.
struct RayLimits {
  double lower;  ///< infinite when it certainly is not met
  double upper;  ///< infinite when it may not be met
};

/// Of a sphere, a Bound whose velocity is its direction, of length 1: lengths of the way are times.
RayLimits first_touch(const Bound& sphere, const HalfSpace& shape, double length);
RayLimits first_touch(const Bound& sphere, const Box& shape, double length);
RayLimits first_touch(const Bound& sphere, const Triangle& shape, double length);

}  // namespace kinesphere
