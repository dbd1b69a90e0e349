// What a body is to the library: an id, a state, and what it promises about its motion.
#pragma once

#include <cstdint>

#include "kinesphere/body_id.hpp"
#include "kinesphere/filter.hpp"
#include "kinesphere/sensor.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Position and velocity at one instant, as a probe reports them.
struct State {
  Vec3 position{};
  Vec3 velocity{};

  friend constexpr bool operator==(const State&, const State&) = default;
};

/// A sphere, and what it promises about its motion: between the changes of which the world is told
/// (World::set_velocity, teleport and so on) its acceleration differs from `planned_acceleration` by at most
/// `acceleration_limit`. Lengths, times and so on may be in any consistent units.
struct BodyDefinition {
  /// Radius r >= 0 (length).
  double radius = 1.0;
  /// A >= 0 (length / time^2): the largest deviation from the planned acceleration. 0 is ballistic.
  double acceleration_limit = 0.0;
  /// g (length / time^2): gravity, a flight plan; zero when nothing is known.
  Vec3 planned_acceleration{};
  /// e0 >= 0 (length): every reported position is within e0 of the true one. The body counts as a
  /// sphere of radius r + e0 around its reported position, so contacts come early, never late.
  double position_error = 0.0;
  /// e1 >= 0 (length / time): every reported velocity is within e1 of the true one.
  double velocity_error = 0.0;
  /// State at the world's current time.
  Vec3 position{};
  Vec3 velocity{};
  /// Which other bodies it may touch, sense and be sensed by.
  Filter filter{};
  /// A body that is not solid touches no other, it is only sensed and senses: a trigger zone. Walls stop it.
  bool solid = true;
  /// At which distances it senses others: World::set_sensor.
  SensorClass sensor_class = 0;
  /// For the caller: the world only keeps it.
  std::uint64_t user_data = 0;
};

/// What a body promises about its motion and its reports, apart from its shape and place: see BodyDefinition.
struct MotionLimits {
  double acceleration_limit = 0.0;
  Vec3 planned_acceleration{};
  double position_error = 0.0;
  double velocity_error = 0.0;
};

inline MotionLimits motion_limits_of(const BodyDefinition& body) {
  return {body.acceleration_limit, body.planned_acceleration, body.position_error, body.velocity_error};
}

/// The same body with another promise.
inline BodyDefinition with_motion_limits(BodyDefinition body, const MotionLimits& promise) {
  body.acceleration_limit = promise.acceleration_limit;
  body.planned_acceleration = promise.planned_acceleration;
  body.position_error = promise.position_error;
  body.velocity_error = promise.velocity_error;
  return body;
}

}  // namespace kinesphere
