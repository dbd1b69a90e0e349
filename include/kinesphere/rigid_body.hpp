// Rigid bodies: balls, capsules, boxes and convex hulls that move and turn together.
//
//   const BodyId dumbbell = world.add_rigid_body({
//       .body = {.position = {5, 5, 5}, .mass = 2},
//       .parts = {{.a = {-1, 0, 0}, .b = {-1, 0, 0}, .radius = 0.5},
//                 {.a = {1, 0, 0}, .b = {1, 0, 0}, .radius = 0.5}},
//       .rotation = {.angular_velocity = {0, 0, 3}},
//       .inertia = {0, 2, 2}}).value();
//
// A point fixed in a body whose position accelerates by at most A, and which turns with angular speed at most
// w and angular acceleration at most a, accelerates by at most
//   A + (a + w^2) d,   d = its distance from the position,
// since its acceleration is that of the position plus alpha x r + omega x (omega x r). So each part of a
// rigid body is a body with unknown trajectory and an acceleration limit, and all that is certain of such
// bodies is certain of the parts (docs/guarantee.md, "Bodies that turn").
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// A rotation as a unit quaternion w + x i + y j + z k.
struct Quaternion {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr bool operator==(const Quaternion&, const Quaternion&) = default;
};

/// Returns the rotation by |turn| radians about the direction of `turn`.
Quaternion rotation_by(const Vec3& turn);
/// Returns the rotation `second` after `first`, of length 1.
Quaternion after(const Quaternion& second, const Quaternion& first);
/// Returns the angle between two orientations, from 0 to pi (radians).
double angle_between(const Quaternion& a, const Quaternion& b);
/// Returns the vector turned by the rotation.
Vec3 rotated(const Quaternion& rotation, const Vec3& vector);
/// Returns the vector turned back.
Vec3 rotated_back(const Quaternion& rotation, const Vec3& vector);

/// Orientation and angular velocity of a rigid body at one instant.
struct Rotation {
  Quaternion orientation{};  ///< turns a vector of the body into one of the world
  Vec3 angular_velocity{};   ///< in the world's axes (radians / time)

  friend constexpr bool operator==(const Rotation&, const Rotation&) = default;
};

/// A part of a rigid body: all points within `radius` of the convex hull of a, b and the points of `more`,
/// which are relative to the body's position, before it is turned. Without `more` it is a capsule, or a ball
/// if a == b. A body that bounces should have no `radius` of less than two contact tolerances: two hulls do
/// not know how deep they overlap beyond their radii.
struct RigidPart {
  Vec3 a{};
  Vec3 b{};
  double radius = 1.0;       ///< >= 0 (length)
  std::vector<Vec3> more{};  ///< at most limits::most_hull_points - 2

  friend bool operator==(const RigidPart&, const RigidPart&) = default;
};

/// Returns all that is within `radius` of the convex hull of some points, at least one. Three points make a
/// plate. Of no point it makes NaN, which World::add_rigid_body() refuses.
RigidPart hull_part(std::span<const Vec3> points, double radius);
/// Returns all that is within `radius` of a box. A box without height, lower.z == upper.z, is a rectangle, as
/// worlds of two dimensions need it.
RigidPart box_part(const Box& box, double radius);

/// Any callable. It must set rotations[k] to the rotation of ids[k] at `time`. It is called directly after
/// the Probe, for the same time and those of its bodies that are rigid. Rules and errors: as for Probe.
using RotationProbe =
    std::function<void(std::span<const BodyId> ids, double time, std::span<Rotation> rotations)>;

/// Definition of a rigid body: World::add_rigid_body(). Its parts move and turn together, and never meet each
/// other.
struct RigidBody {
  /// As for World::add(). `position` is the point about which the body turns, usually its centre of mass;
  /// the limits are those of its motion. The radius is replaced by that of the ball around it that contains
  /// all parts. `position_error` and `velocity_error` hold for every point of the body.
  BodyDefinition body{};
  /// At least one. One part alone that is a ball around the position is a ball that turns: it meets others as
  /// a ball of World::add() does, and as fast.
  std::vector<RigidPart> parts{};
  /// Rotation at the world's current time.
  Rotation rotation{};
  /// a >= 0 (radians / time^2): the largest angular acceleration between the changes that the caller
  /// declares. At 0 the body keeps its angular velocity, as a free ball, a free dumbbell and a free capsule
  /// without spin about its axis do; the world then knows its rotation without a RotationProbe.
  double angular_acceleration_limit = 0.0;
  /// w >= 0 (radians / time): the largest angular speed. Must be finite if the limit above is not 0.
  double largest_angular_speed = std::numeric_limits<double>::infinity();
  /// Moments of inertia (mass length^2) about the body's own axes, which must be principal axes of inertia.
  /// Contacts do not turn the body about an axis with moment 0 or infinity. The world only passes them on, to
  /// Event::first_spin_gain.
  Vec3 inertia{};

  friend bool operator==(const RigidBody&, const RigidBody&) = default;
};

}  // namespace kinesphere
