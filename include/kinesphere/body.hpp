// Definition of a body: its state, its shape and its motion limits.
#pragma once

#include <cstdint>
#include <optional>

#include "kinesphere/body_id.hpp"
#include "kinesphere/contact_events.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Position (length) and velocity (length / time) at one instant, as a probe reports them.
struct State {
  Vec3 position{};
  Vec3 velocity{};

  friend constexpr bool operator==(const State&, const State&) = default;
};

/// A sphere and its motion limits. Between the changes that the caller declares (World::set_velocity(),
/// teleport() and so on) its acceleration differs from `planned_acceleration` by at most
/// `acceleration_limit`. Lengths and times may be in any consistent units.
struct BodyDefinition {
  /// Radius r >= 0 (length).
  double radius = 1.0;
  /// A >= 0 (length / time^2): the largest deviation from the planned acceleration; 0 for a ballistic body. A
  /// body with limit 0 that accelerates breaks its promise. It is seldom probed, and contacts are missed
  /// until spot checks report it as bound_violation (docs/guarantee.md). From then on the limit is what was
  /// observed (WorldDefinition::adopt_observed_limits).
  double acceleration_limit = 0.0;
  /// g (length / time^2): known acceleration, such as gravity or a flight plan; zero if unknown.
  Vec3 planned_acceleration{};
  /// e0 >= 0 (length): every reported position is within e0 of the true one. The body is treated as a
  /// sphere of radius r + e0 around its reported position, so contacts are reported early, never late.
  double position_error = 0.0;
  /// e1 >= 0 (length / time): every reported velocity is within e1 of the true one.
  double velocity_error = 0.0;
  /// State at the world's current time.
  Vec3 position{};
  Vec3 velocity{};
  /// Selects the bodies that it may touch, sense and be sensed by.
  Filter filter{};
  /// False for a trigger zone: it has no contacts with other bodies and only senses and is sensed. Walls
  /// stop it.
  bool solid = true;
  /// Which contact events it asks for; if not given, WorldDefinition::contacts.
  std::optional<ContactEvents> contacts{};
  /// Class whose sensor distances apply to this body: World::set_sensor().
  SensorClass sensor_class = 0;
  /// Stored for the caller; the world does not interpret it.
  std::uint64_t user_data = 0;
  /// m >= 0 (mass): every event of the body has it (Event::first_mass), and bounce() and settle() use it.
  /// Infinity for a body that moves but that no contact turns; 0 is the limit of small masses. The world does
  /// not interpret it.
  double mass = 1.0;
  /// k (length / time): the radius at a later time t is max(radius + k (t - now), 0), in events, queries and
  /// bounds; negative for a ball that shrinks, which stays a point once it is one. Events have the speed at
  /// which the surfaces approach. Not 0 only for a ball; it cannot sleep then.
  double radius_rate = 0.0;

  friend constexpr bool operator==(const BodyDefinition&, const BodyDefinition&) = default;
};

/// Limits of a body's motion and of its report errors, without radius and state. Fields: see
/// BodyDefinition.
struct MotionLimits {
  double acceleration_limit = 0.0;
  Vec3 planned_acceleration{};
  double position_error = 0.0;
  double velocity_error = 0.0;

  friend constexpr bool operator==(const MotionLimits&, const MotionLimits&) = default;
};

/// Returns the motion limits of `body`.
inline MotionLimits motion_limits_of(const BodyDefinition& body) {
  return {body.acceleration_limit, body.planned_acceleration, body.position_error, body.velocity_error};
}

/// Returns `body` with its motion limits replaced.
inline BodyDefinition with_motion_limits(BodyDefinition body, const MotionLimits& limits) {
  body.acceleration_limit = limits.acceleration_limit;
  body.planned_acceleration = limits.planned_acceleration;
  body.position_error = limits.position_error;
  body.velocity_error = limits.velocity_error;
  return body;
}

}  // namespace kinesphere
