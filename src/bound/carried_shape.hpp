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

/// A box or a triangle whose origin is the centre of `carrier`. Holds references to both.
template <class Solid>
struct CarriedShape {
  const Solid& solid;
  const Bound& carrier;
  /// Part of the carrier's radius that stands for the shape (length); the rest is its position error.
  double radius = 0.0;
};

/// The motion of a bound relative to a carried shape from a time on.
struct MotionBesideShape {
  Bound bound{};
  double slack = 0.0;  ///< by which the gap may be smaller or larger at that time (length)

  template <class Solid>
  MotionBesideShape(const Bound& moving, const CarriedShape<Solid>& shape, double time)
      : MotionBesideShape(RelativeMotion(moving, shape.carrier, time), shape.radius, time) {}

 private:
  MotionBesideShape(const RelativeMotion& motion, double shape_radius, double time)
      : bound{.time = time,
              .position = motion.offset,
              .velocity = motion.velocity,
              .planned_acceleration = motion.acceleration,
              .radius = motion.radii - shape_radius,
              .growth_speed = motion.growth_speed + rounding::margin * motion.velocity_size,
              .acceleration_limit = motion.acceleration_limit + rounding::margin * motion.acceleration_size},
        slack(motion.growth + rounding::margin * motion.offset_size) {}
};

template <class Solid>
double earliest_meeting(const Bound& bound, const CarriedShape<Solid>& shape, double from, double until,
                        double distance = 0.0) {
  const MotionBesideShape motion(bound, shape, from);
  return earliest_meeting(motion.bound, shape.solid, from, until, distance + motion.slack);
}

template <class Solid>
double earliest_separation(const Bound& bound, const CarriedShape<Solid>& shape, double from, double until,
                           double distance) {
  const MotionBesideShape motion(bound, shape, from);
  return earliest_separation(motion.bound, shape.solid, from, until, distance - motion.slack);
}

template <class Solid>
GapLimits gap_limits(const Bound& bound, const CarriedShape<Solid>& shape, double t) {
  const MotionBesideShape motion(bound, shape, t);
  const GapLimits gap = gap_limits(motion.bound, shape.solid, t);
  return {gap.lower - motion.slack, gap.upper + motion.slack};
}

}  // namespace kinesphere
