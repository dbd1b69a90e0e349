// Where a body certainly is at the present time, also after changes that no report has followed yet.
#pragma once

#include "bound/rounding.hpp"
#include "engine/engine.hpp"

namespace kinesphere {

/// A sphere with radius `outer` around `centre` contains the body. The body contains the sphere with radius
/// `inner` if that is not negative. Rounding is covered.
struct CertainSphere {
  Vec3 centre;
  double outer;
  double inner;
};

inline CertainSphere certain_sphere_of(const Body& body, double now) {
  const Bound& bound = body.bound;
  const double s = now - bound.time;
  const double outer = bound.radius_at(now);
  const double size =
      norm_one(bound.position) + (norm_one(bound.velocity) + norm_one(bound.planned_acceleration) * s) * s;
  const double deviation = outer - body.radius + rounding::margin * (size + outer);
  return {bound.centre_at(now), body.radius + deviation, body.radius - deviation};
}

/// Returns a bound that contains the body from now on. After a velocity change or new motion limits, the last
/// report determines only the present position and, without a velocity change, the velocity.
inline Bound present_bound(const Body& body, const Change* change, double now) {
  const Bound& last = body.bound;
  if (!change) return last;
  const MotionLimits& limits = change->limits;
  const bool is_unchanged = last.growth_speed == limits.velocity_error &&
                            last.growth_acceleration == limits.acceleration_limit &&
                            last.planned_acceleration == limits.planned_acceleration;
  if (is_unchanged && !change->velocity) return last;
  const CertainSphere sphere = certain_sphere_of(body, now);
  Bound bound{.time = now,
              .position = sphere.centre,
              .velocity = change->velocity.value_or(last.velocity_at(now)),
              .planned_acceleration = limits.planned_acceleration,
              .radius = sphere.outer,
              .growth_speed = limits.velocity_error,
              .growth_acceleration = limits.acceleration_limit};
  if (!change->velocity) {
    const double s = now - last.time;
    const double speed =
        norm_one(last.velocity) + (norm_one(last.planned_acceleration) + last.growth_acceleration) * s;
    bound.growth_speed = last.growth_speed + last.growth_acceleration * s + rounding::margin * speed;
  }
  return bound;
}

}  // namespace kinesphere
