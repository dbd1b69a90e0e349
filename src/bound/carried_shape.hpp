// Certified times and gaps between a bound and a shape that another bound carries.
//
// The shape does not turn, so the motion of a body relative to it is again that of a bound, and the shape is
// at rest in it: all that is certain of shapes at rest (shape.hpp) is certain of carried ones. What the two
// bounds may have grown and what the difference of their motions loses to rounding count against either
// answer.
#pragma once

#include "bound/relative_motion.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// A box, a triangle or a mesh whose origin is the centre of `carrier`. Holds references to both.
template <class Solid>
struct CarriedShape {
  const Solid& solid;
  const Bound& carrier;
  /// Part of the carrier's radius that stands for the shape (length); the rest is its position error.
  double radius = 0.0;
};

template <class Solid>
double earliest_meeting(const Bound& bound, const CarriedShape<Solid>& shape, double from, double until,
                        double distance = 0.0) {
  const BoundBesideBound motion(bound, shape.carrier, from, shape.radius);
  return earliest_meeting(motion.bound, shape.solid, from, until, distance + motion.slack);
}

template <class Solid>
double earliest_separation(const Bound& bound, const CarriedShape<Solid>& shape, double from, double until,
                           double distance) {
  const BoundBesideBound motion(bound, shape.carrier, from, shape.radius);
  return earliest_separation(motion.bound, shape.solid, from, until, distance - motion.slack);
}

template <class Solid>
GapLimits gap_limits(const Bound& bound, const CarriedShape<Solid>& shape, double t) {
  const BoundBesideBound motion(bound, shape.carrier, t, shape.radius);
  const GapLimits gap = gap_limits(motion.bound, shape.solid, t);
  return {gap.lower - motion.slack, gap.upper + motion.slack};
}

}  // namespace kinesphere
