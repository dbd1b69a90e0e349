// The volume of a rigid body as certificates see it: bounds of points that are fixed in a turning body.
#pragma once

#include <span>

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/rigid_body.hpp"

namespace kinesphere {

/// The ball around a part, without rounding margin.
struct PartBall {
  Vec3 middle;    ///< in the body
  double arm;     ///< distance of the middle from the position
  double radius;  ///< of the ball
};

/// A rigid body between two reports. A ball is one with a single part at its position. Refers to the parts.
struct RigidExtent {
  Bound bound;          ///< of the body's position
  double radius = 0.0;  ///< part of the bound's radius that stands for the parts; the rest is its error
  std::span<const RigidPart> parts;
  std::span<const PartBall> balls;  ///< around the parts
  Rotation rotation{};              ///< at the time of the bound
  double spin = 0.0;                ///< largest angular speed since then (radians / time)
  double spin_growth = 0.0;         ///< largest angular acceleration (radians / time^2)
  bool is_foreseen = false;         ///< at a time later than that of its report

  /// True if the body flies and turns exactly as the last report says.
  bool is_exact() const { return spin_growth == 0.0 && bound.is_exact(); }
  /// Returns the largest speed (length / time), relative to its position, of a point that is fixed in the
  /// body.
  double turning_speed() const { return spin * radius; }
  /// Returns the same body with a report at `time`, which is not earlier. Precondition: is_exact().
  RigidExtent at(double time) const {
    if (time == bound.time) return *this;
    const double s = time - bound.time;
    RigidExtent later = *this;
    later.is_foreseen = true;
    later.bound.time = time;
    later.bound.position = bound.centre_at(time);
    later.bound.velocity = bound.velocity_at(time);
    const double way = (norm_one(bound.velocity) + norm_one(bound.planned_acceleration) * s) * s;
    later.bound.radius += rounding::margin * (norm_one(bound.position) + way + spin * s * radius);
    later.rotation.orientation = after(rotation_by(rotation.angular_velocity * s), rotation.orientation);
    return later;
  }

  /// Returns the bound of a ball around a point that is fixed in the body: its acceleration differs from the
  /// planned one by at most A + (a + w^2) d (rigid_body.hpp).
  [[gnu::always_inline]] Bound of_point(const Vec3& point, double ball_radius) const {
    const Vec3 arm = rotated(rotation.orientation, point);
    const double reach = norm(point) * (1.0 + rounding::margin);
    Bound ball = bound;
    ball.position += arm;
    ball.velocity += cross(rotation.angular_velocity, arm);
    ball.radius = ball_radius + (bound.radius - radius) + rounding::margin * reach;
    ball.growth_speed += rounding::margin * spin * reach;
    ball.acceleration_limit += (spin_growth + spin * spin) * reach * (1.0 + rounding::margin);
    return ball;
  }
};

/// A rigid body and its partner: a RigidExtent, a HalfSpace, or a Placed solid.
template <class Other>
struct RigidPair {
  RigidExtent body;
  Other other;

  /// True if the motion of the two is known exactly.
  bool is_exact() const {
    if constexpr (requires { other.is_exact(); })
      return body.is_exact() && other.is_exact();
    else if constexpr (requires { other.carrier; })
      return body.is_exact() && !other.carrier;
    else
      return body.is_exact();
  }
  /// Returns an upper limit of the speed (length / time) at which any two points, one fixed in each of the
  /// two, move relative to each other at `time`, but for the errors of the reports.
  double relative_speed(double time) const {
    const Vec3 velocity = body.bound.velocity_at(time);
    if constexpr (requires { other.turning_speed(); })
      return norm(velocity - other.bound.velocity_at(time)) + body.turning_speed() + other.turning_speed();
    else if constexpr (requires { other.carrier; })
      return norm(velocity - other.velocity(time)) + body.turning_speed();
    else
      return norm(velocity) + body.turning_speed();
  }
  /// Returns the pair with a sum of growths that is less by `excess` (length / time) from `time` on.
  /// Precondition: both reports are of `time`, or their bodies stand still.
  RigidPair with_less_growth(double excess, double time) const {
    RigidPair pair = *this;
    pair.body.bound.growth_speed -= excess;
    pair.body.bound.time = time;
    return pair;
  }
  /// Returns the two with later reports. Precondition: is_exact().
  RigidPair at(double time) const {
    if constexpr (requires { other.is_exact(); })
      return {body.at(time), other.at(time)};
    else
      return {body.at(time), other};
  }
};

}  // namespace kinesphere
