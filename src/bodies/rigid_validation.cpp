// Validation of rigid bodies and their rotations.

#include <algorithm>
#include <string>

#include "bodies/shaped_body.hpp"
#include "bodies/validation.hpp"
#include "bound/rigid_part.hpp"
#include "bound/rigid_record.hpp"

namespace kinesphere {
namespace {

/// Lengths of quaternions between 1 and this far from it are normalised (relative).
constexpr double nearly_one = 1e-6;

void require_rotation(InputCheck& check, const Rotation& rotation, BodyId body,
                      const WorldDefinition& world) {
  const auto& [orientation, spin] = rotation;
  const Vec3 axis{orientation.x, orientation.y, orientation.z};
  const double length = std::sqrt(orientation.w * orientation.w + norm_squared(axis));
  check.finite({"rotation", body, "orientation"}, length)
      .require(std::abs(length - 1.0) <= nearly_one, ErrorCode::out_of_range,
               {"rotation", body, "orientation"}, "must have length 1", length)
      .within({"rotation", body, "angular_velocity"}, spin, limits::largest_speed);
  if (world.dimensions == 3) return;
  check
      .require(axis.x == 0.0 && axis.y == 0.0, ErrorCode::out_of_range, {"rotation", body, "orientation"},
               "must turn about z alone in two dimensions", axis)
      .require(spin.x == 0.0 && spin.y == 0.0, ErrorCode::out_of_range,
               {"rotation", body, "angular_velocity"}, "must be about z alone in two dimensions", spin);
}

void require_part(InputCheck& check, const RigidPart& part, std::size_t number,
                  const WorldDefinition& world) {
  const auto subject = [number](std::string_view field) { return Subject{"parts", no_body, field, number}; };
  check.within(subject("a"), part.a, coordinate_limit(world))
      .within(subject("b"), part.b, coordinate_limit(world))
      .not_negative(subject("radius"), part.radius);
  check.require(point_count(part) <= limits::most_hull_points, ErrorCode::out_of_range, subject("more"),
                "must leave the part with a number of points of at most", limits::most_hull_points,
                point_count(part));
  if (check.error()) return;
  for (const Vec3& point : part.more) {
    check.within(subject("more"), point, coordinate_limit(world));
    require_plane(check, subject("more"), point, world);
  }
  require_plane(check, subject("a"), part.a, world);
  require_plane(check, subject("b"), part.b, world);
}

/// The parts are small enough for periodic space.
Result<void> check_parts_in_period(const RigidBody& body, const WorldDefinition& world,
                                   std::string_view call) {
  const auto reach_of = [](const RigidPart& part) {
    const PartBall ball = ball_around(part);
    return ball.arm + ball.radius;
  };
  const auto farthest =
      std::max_element(body.parts.begin(), body.parts.end(),
                       [&](const RigidPart& a, const RigidPart& b) { return reach_of(a) < reach_of(b); });
  const double needed = needed_in_period(body_of(body), 0.0, world);
  for (int axis = 0; axis < 3; ++axis) {
    if (!world.periodic[axis] || needed <= margin_in_period(world, axis)) continue;
    return Error{ErrorCode::out_of_range, "parts", no_body,
                 std::string(call) + ": parts[" + std::to_string(farthest - body.parts.begin()) + "] is " +
                     text_of(2.0 * ball_around(*farthest).radius, 9) + " long and reaches " +
                     text_of(reach_of(*farthest)) +
                     " from the position of the body, too far for a periodic box that is " +
                     text_of(world.box->upper[axis] - world.box->lower[axis]) + " long on " + "xyz"[axis] +
                     ": 2 times that + 6 position_error + separation_distance + contact_tolerance must be at "
                     "most 3/8 of the length, " +
                     text_of(margin_in_period(world, axis)) + ", but is " + text_of(needed)};
  }
  return {};
}

}  // namespace

Result<void> check_rotation(const Rotation& rotation, BodyId body, const WorldDefinition& world,
                            std::string_view call) {
  InputCheck check(call);
  require_rotation(check, rotation, body, world);
  return check.result();
}

Result<void> check_rigid_body(const RigidBody& body, const WorldDefinition& world, std::string_view call) {
  InputCheck check(call);
  check.require(!body.parts.empty(), ErrorCode::out_of_range, {"parts"}, "must have at least one part",
                body.parts.size());
  for (std::size_t k = 0; k < body.parts.size(); ++k) require_part(check, body.parts[k], k, world);
  require_rotation(check, body.rotation, no_body, world);
  check.not_negative({"angular_acceleration_limit"}, body.angular_acceleration_limit)
      .not_negative_or_infinite({"largest_angular_speed"}, body.largest_angular_speed)
      .require(body.angular_acceleration_limit == 0.0 || body.largest_angular_speed <= limits::largest_speed,
               ErrorCode::out_of_range, {"largest_angular_speed"},
               "must be finite where angular_acceleration_limit is not 0", body.largest_angular_speed);
  const double spin = norm(body.rotation.angular_velocity);
  check.require(!(spin > body.largest_angular_speed), ErrorCode::out_of_range,
                {"rotation", no_body, "angular_velocity"}, "must not exceed largest_angular_speed", spin);
  for (int axis = 0; axis < 3; ++axis) check.not_negative_or_infinite({"inertia"}, body.inertia[axis]);
  return check.result();
}

Result<void> check_new_rigid_body(const RigidBody& body, const WorldDefinition& world,
                                  std::string_view call) {
  auto valid = check_no_shear(world, call);
  if (valid) valid = check_keeps_size(body.body, call);
  if (valid) valid = check_rigid_body(body, world, call);
  if (!valid) return valid;
  WorldDefinition without_walls = world;
  without_walls.box.reset();
  valid = check_body(body_of(body), without_walls, call);
  return valid ? check_parts_in_period(body, world, call) : valid;
}

Result<void> check_keeps_size(const BodyDefinition& body, std::string_view call) {
  if (body.radius_rate == 0.0) return {};
  return Error{ErrorCode::unsupported, "radius_rate", no_body,
               std::string(call) + ": radius_rate must be 0 for a body that is not a ball, but is " +
                   text_of(body.radius_rate)};
}

Result<void> check_spin(const Vec3& angular_velocity, const RigidRecord* turning, BodyId body,
                        const WorldDefinition& world, std::string_view call) {
  if (turning == nullptr)
    return Error{ErrorCode::unsupported, "body", body,
                 std::string(call) + ": body must be rigid, but " + text_of(body) + " is not"};
  InputCheck check(call);
  check.within({"angular_velocity", body}, angular_velocity, limits::largest_speed)
      .require(!(norm(angular_velocity) > turning->largest_angular_speed), ErrorCode::out_of_range,
               {"angular_velocity", body}, "must not exceed largest_angular_speed", angular_velocity);
  if (world.dimensions == 2)
    check.require(angular_velocity.x == 0.0 && angular_velocity.y == 0.0, ErrorCode::out_of_range,
                  {"angular_velocity", body}, "must be about z alone in two dimensions", angular_velocity);
  return check.result();
}

}  // namespace kinesphere
