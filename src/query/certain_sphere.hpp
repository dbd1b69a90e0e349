// Where a body certainly is at the present time, also after changes that no report has followed yet.
#pragma once

#include <cmath>

#include "bound/rounding.hpp"
#include "engine/engine.hpp"

namespace kinesphere {

/// A sphere with radius `outer` around `centre` contains the body. The body contains the sphere with radius
/// `inner` if that is not negative; a point of the body is within -`inner` of the centre if it is. Rounding
/// is covered.
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
  const double contained = body.has_parts() ? -body.radius : body.radius;
  return {bound.centre_at(now), body.radius + deviation, contained - deviation};
}

/// The shape of a body. Its origin is within `spread` (length) of `origin`; both are zero for a shape at
/// rest.
struct CertainShape {
  const Shape& shape;
  Vec3 origin{};
  double spread = 0.0;
};

/// Returns nullopt for a ball, also for a static one.
inline std::optional<CertainShape> certain_shape_of(const Bodies& bodies, std::uint32_t number, double now) {
  const Body& body = bodies[number];
  if (!body.has_shape() || std::holds_alternative<Ball>(bodies.shapes.of(body))) return std::nullopt;
  if (body.is_static()) return CertainShape{bodies.shapes.of(body)};
  const CertainSphere ball = certain_sphere_of(body, now);
  return CertainShape{bodies.shapes.of(body), ball.centre, ball.outer - body.radius};
}

/// Returns a bound that contains the body from now on. After a velocity change or new motion limits, the last
/// report determines only the present position and, without a velocity change, the velocity. `radius_rate` is
/// that of the body.
inline Bound present_bound(const Body& body, const Change* change, double radius_rate, double now) {
  const Bound& last = body.bound;
  if (!change) return last;
  const MotionLimits& limits = change->limits;
  const double growth_speed =
      bound_of({.velocity_error = limits.velocity_error, .radius_rate = radius_rate}, {}, now).growth_speed;
  const bool is_unchanged = last.growth_speed == growth_speed &&
                            last.acceleration_limit == limits.acceleration_limit &&
                            last.planned_acceleration == limits.planned_acceleration;
  if (is_unchanged && !change->velocity) return last;
  const CertainSphere sphere = certain_sphere_of(body, now);
  Bound bound{.time = now,
              .position = sphere.centre,
              .velocity = change->velocity.value_or(last.velocity_at(now)),
              .planned_acceleration = limits.planned_acceleration,
              .radius = sphere.outer,
              .growth_speed = growth_speed,
              .acceleration_limit = limits.acceleration_limit};
  if (!change->velocity) {
    const double s = now - last.time;
    const double speed =
        norm_one(last.velocity) + (norm_one(last.planned_acceleration) + last.acceleration_limit) * s;
    bound.growth_speed =
        last.growth_speed + last.acceleration_limit * s + rounding::margin * speed + std::abs(radius_rate);
  }
  return bound;
}

}  // namespace kinesphere
