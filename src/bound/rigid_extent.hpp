// The volume of a rigid body as certificates see it: bounds of points that are fixed in a turning body.
#pragma once

#include <algorithm>
#include <span>

#include "bound/rounding.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/rigid_body.hpp"

namespace kinesphere {

/// Returns the largest distance of a point of the part from the origin, without rounding margin.
inline double outer_radius(const RigidPart& part) {
  return std::max(norm(part.a), norm(part.b)) + part.radius;
}

/// A rigid body between two reports. A ball is one with a single part at its position. Holds references.
struct RigidExtent {
  const Bound& bound;   ///< of the body's position
  double radius = 0.0;  ///< part of the bound's radius that stands for the parts; the rest is its error
  std::span<const RigidPart> parts;
  Rotation rotation{};       ///< at the time of the bound
  double spin = 0.0;         ///< largest angular speed since then (radians / time)
  double spin_growth = 0.0;  ///< largest angular acceleration (radians / time^2)

  /// Returns the bound of a ball around a point that is fixed in the body: its acceleration differs from the
  /// planned one by at most A + (a + w^2) d (rigid_body.hpp).
  Bound of_point(const Vec3& point, double ball_radius) const {
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

/// A rigid body and its partner: a RigidExtent, a shape at rest, or a CarriedShape. Holds references.
template <class Other>
struct RigidPair {
  const RigidExtent& body;
  const Other& other;
};

}  // namespace kinesphere
