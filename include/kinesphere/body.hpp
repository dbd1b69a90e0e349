// What a body is to the library: an id, a state, and what it promises about its motion.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Names a body for as long as it lives. When a body is removed its index may be used again, with
/// another generation, so an old id is recognised as stale and never mistaken for a newer body.
struct BodyId {
  std::uint32_t index = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t generation = 0;

  friend constexpr auto operator<=>(const BodyId&, const BodyId&) = default;
};

/// The id that names no body: the second body of a wall event, for one.
inline constexpr BodyId no_body{};

/// Position and velocity at one instant, as a probe reports them.
struct State {
  Vec3 position{};
  Vec3 velocity{};

  friend constexpr bool operator==(const State&, const State&) = default;
};

/// A sphere and its promise: between kicks its acceleration differs from `planned_acceleration`
/// by at most `acceleration_limit`. Lengths, times and so on may be in any consistent units.
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
};

}  // namespace kinesphere
