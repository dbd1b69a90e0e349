// Relative motion of two bounds from a time on, with radii, and magnitudes for rounding margins.
#pragma once

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere {

/// Relative motion in terms of d = t - from >= 0:
///   centre difference  C(d) = offset + velocity d + 1/2 acceleration d^2
///   growth             Gamma(d) = growth + growth_speed d + 1/2 acceleration_limit d^2
/// Growth is the increase of the two radii since the reports. Each size bounds the sum of the magnitudes of
/// the terms in its coefficient, and is widened and capped (rounding.hpp). Precondition: `from` is not before
/// either report.
struct RelativeMotion {
  Vec3 offset, velocity, acceleration;
  double radii;  ///< sum of r + e0 over the two bodies
  double growth, growth_speed, acceleration_limit;
  double offset_size, velocity_size, acceleration_size;

  [[gnu::always_inline]] RelativeMotion(const Bound& a, const Bound& b, double from)
      : RelativeMotion(Part(a, from), Part(b, from)) {}

  Vec3 centre_at(double d) const { return offset + (velocity + acceleration * (0.5 * d)) * d; }
  Vec3 velocity_at(double d) const { return velocity + acceleration * d; }
  double growth_at(double d) const { return growth + (growth_speed + 0.5 * acceleration_limit * d) * d; }
  double growth_speed_at(double d) const { return growth_speed + acceleration_limit * d; }
  double size_at(double d) const { return offset_size + (velocity_size + 0.5 * acceleration_size * d) * d; }

 private:
  /// One bound, advanced to `from`.
  struct Part {
    [[gnu::always_inline]] Part(const Bound& bound, double from)
        : s(from - bound.time),
          centre(bound.position + (bound.velocity + bound.planned_acceleration * (0.5 * s)) * s),
          velocity(bound.velocity + bound.planned_acceleration * s),
          acceleration(bound.planned_acceleration),
          radius(bound.radius),
          growth((bound.growth_speed + 0.5 * bound.acceleration_limit * s) * s),
          growth_speed(bound.growth_speed + bound.acceleration_limit * s),
          acceleration_limit(bound.acceleration_limit),
          acceleration_size(rounding::widened(norm_one(acceleration) + acceleration_limit)),
          velocity_size(rounding::widened(norm_one(bound.velocity) + bound.growth_speed) +
                        acceleration_size * s),
          offset_size(rounding::widened(norm_one(bound.position) + radius) + velocity_size * s) {}

    double s;
    Vec3 centre, velocity, acceleration;
    double radius, growth, growth_speed, acceleration_limit;
    double acceleration_size, velocity_size, offset_size;
  };

  RelativeMotion(const Part& a, const Part& b)
      : offset(a.centre - b.centre),
        velocity(a.velocity - b.velocity),
        acceleration(a.acceleration - b.acceleration),
        radii(a.radius + b.radius),
        growth(a.growth + b.growth),
        growth_speed(a.growth_speed + b.growth_speed),
        acceleration_limit(a.acceleration_limit + b.acceleration_limit),
        offset_size(rounding::capped(a.offset_size + b.offset_size)),
        velocity_size(rounding::capped(a.velocity_size + b.velocity_size)),
        acceleration_size(rounding::capped(a.acceleration_size + b.acceleration_size)) {}
};

/// The motion of one bound relative to another from a time on, as a bound.
struct BoundBesideBound {
  Bound bound{};
  double slack = 0.0;  ///< by which their distance may be smaller or larger at that time (length)

  /// The motion relative to something at rest.
  explicit BoundBesideBound(const Bound& moving) : bound(moving) {}
  /// `radius` is the part of the other bound's radius that does not count (length).
  [[gnu::noinline]] BoundBesideBound(const Bound& moving, const Bound& other, double time,
                                     double radius = 0.0)
      : BoundBesideBound(RelativeMotion(moving, other, time), radius, time) {}

 private:
  BoundBesideBound(const RelativeMotion& motion, double radius, double time)
      : bound{.time = time,
              .position = motion.offset,
              .velocity = motion.velocity,
              .planned_acceleration = motion.acceleration,
              .radius = motion.radii - radius,
              .growth_speed = motion.growth_speed + rounding::margin * motion.velocity_size,
              .acceleration_limit = motion.acceleration_limit + rounding::margin * motion.acceleration_size},
        slack(motion.growth + rounding::margin * motion.offset_size) {}
};

}  // namespace kinesphere
