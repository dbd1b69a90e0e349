// Certified times and gaps between a bound and a solid that is placed: at rest, or carried by another bound.
//
// A carried solid does not turn, so the motion of a body relative to it is again that of a bound, and the
// solid is at rest in it: all that is certain of solids at rest (shape.hpp) is certain of carried ones. What
// the two bounds may have grown and what the difference of their motions loses to rounding count against
// either answer.
#pragma once

#include "bound/relative_motion.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// A box, a convex solid, a mesh or a difference of two, at rest or with its origin at the centre of
/// `carrier`. Refers to both.
template <class Solid>
struct Placed {
  const Solid& solid;
  const Bound* carrier = nullptr;  ///< none at rest
  /// Part of the carrier's radius that stands for the solid (length); the rest is its position error.
  double radius = 0.0;

  /// Another solid at the same place.
  template <class Other>
  Placed<Other> with(const Other& other) const {
    return {other, carrier, radius};
  }
  /// The motion of a bound relative to the solid from a time on.
  BoundBesideBound beside(const Bound& bound, double time) const {
    return carrier ? BoundBesideBound(bound, *carrier, time, radius) : BoundBesideBound(bound);
  }
  /// Where the origin of the solid is at a time, if it goes straight on.
  Vec3 origin(double time) const { return carrier ? carrier->centre_at(time) : Vec3{}; }
  Vec3 velocity(double time) const { return carrier ? carrier->velocity_at(time) : Vec3{}; }
  /// The bound of a point of the solid; `radius` of it does not count.
  Bound of_point(const Vec3& point, double time) const {
    Bound bound = carrier ? *carrier : Bound{.time = time};
    bound.position += point;
    return bound;
  }
};

template <class Solid>
double earliest_meeting(const Bound& bound, const Placed<Solid>& shape, double from, double until,
                        double distance = 0.0) {
  if (!shape.carrier) return earliest_meeting(bound, shape.solid, from, until, distance);
  const auto [motion, slack] = shape.beside(bound, from);
  return earliest_meeting(motion, shape.solid, from, until, distance + slack);
}

template <class Solid>
double earliest_separation(const Bound& bound, const Placed<Solid>& shape, double from, double until,
                           double distance) {
  if (!shape.carrier) return earliest_separation(bound, shape.solid, from, until, distance);
  const auto [motion, slack] = shape.beside(bound, from);
  return earliest_separation(motion, shape.solid, from, until, distance - slack);
}

template <class Solid>
GapLimits gap_limits(const Bound& bound, const Placed<Solid>& shape, double t) {
  if (!shape.carrier) return gap_limits(bound, shape.solid, t);
  const auto [motion, slack] = shape.beside(bound, t);
  const GapLimits gap = gap_limits(motion, shape.solid, t);
  return {gap.lower - slack, gap.upper + slack};
}

}  // namespace kinesphere
