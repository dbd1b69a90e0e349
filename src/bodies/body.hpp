// Body is the engine's record of one body.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/event.hpp"

namespace kinesphere {

/// The state of the last report and the motion limits, except for position_error, are stored in the bound
/// only.
struct Body {
  /// Marks the absence of an index into a side table.
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  Bound bound{};  ///< bound of the position since the last report
  /// Incremented when what is known of the pairs of the body holds no longer (PairTimes).
  std::uint32_t revision = 0;

  bool alive = false;
  bool enabled = true;
  bool dirty = false;      ///< listed for recertification before time advances
  bool relocated = false;  ///< added, teleported, enabled or refiltered since it was recertified
  bool turned = false;     ///< nothing but its velocity has changed since it was recertified
  // Fields of BodyDefinition.
  bool solid = true;
  ContactEvents contact_events = ContactEvents::all;  ///< 0 for a static body, which asks for nothing
  SensorClass sensor_class = 0;
  bool carries_shape = false;  ///< its shape moves with it; a static body has one at rest
  bool is_rigid = false;       ///< it has parts that turn with it (RigidBodies)
  bool is_round = false;       ///< it is rigid, and a ball: how it turns changes nothing of its surface
  std::uint32_t shape_number = none;   ///< index of the shape or of the rigid body; none for a ball
  std::uint32_t change_number = none;  ///< index of the pending change
  std::uint32_t generation = 0;
  std::uint32_t sleep_number = none;  ///< index of the sleep record
  double radius = 0.0;
  double position_error = 0.0;
  std::uint64_t user_data = 0;

  bool present() const { return alive && enabled; }
  /// Returns true for a body that is not a ball.
  bool is_shaped() const { return shape_number != none && !is_round; }
  /// Returns true for a body whose surface is that of a Shape, at rest or carried.
  bool has_shape() const { return is_shaped() && !is_rigid; }
  /// Returns true for a rigid body whose parts are more than a ball around its position.
  bool has_parts() const { return is_rigid && !is_round; }
  bool is_static() const { return has_shape() && !carries_shape; }
  bool is_sleeping() const { return sleep_number != none; }
  /// Sleeping, and with a report since it fell asleep. The bound then stands still.
  bool is_at_rest() const { return is_sleeping() && change_number == none; }
  /// Returns true if the bound neither moves nor grows.
  bool stands_still() const {
    return bound.velocity == Vec3{} && bound.planned_acceleration == Vec3{} && bound.growth_speed == 0.0 &&
           bound.acceleration_limit == 0.0;
  }
  void stand_still() {
    bound.velocity = bound.planned_acceleration = {};
    bound.growth_speed = bound.acceleration_limit = 0.0;
  }
  void mark_recertified() { dirty = relocated = turned = false; }
  /// Returns true if the state at `time` is known without a probe: no change waits for a report.
  bool fresh(double time) const {
    return (bound.time == time || is_static() || is_sleeping()) && change_number == none;
  }
  double largest_acceleration() const { return bound.acceleration_limit + norm(bound.planned_acceleration); }

  static void serialize(auto& self, auto& archive) {
    auto& [bound, revision, alive, enabled, dirty, relocated, turned, solid, contact_events, sensor_class,
           carries_shape, is_rigid, is_round, shape_number, change_number, generation, sleep_number, radius,
           position_error, user_data] = self;
    archive(bound, revision, alive, enabled, dirty, relocated, turned, solid, contact_events, sensor_class,
            carries_shape, is_rigid, is_round, shape_number, change_number, generation, sleep_number, radius,
            position_error, user_data);
  }
};
static_assert(sizeof(Body) <= 168);

inline BodyTraits traits_of(const Body& body) {
  return {.is_static = body.is_static(), .is_zone = !body.solid, .is_sleeping = body.is_sleeping()};
}

/// Changes that the caller made since the body's last report. They take effect with the next report, or when
/// the body is enabled again.
struct Change {
  std::uint32_t body = 0;
  std::optional<Vec3> velocity{};  ///< new velocity, if it was set
  MotionLimits limits{};
};

/// Motion limits of a sleeping body that apply after it wakes.
struct SleepRecord {
  std::uint32_t body = 0;
  MotionLimits limits{};
};

}  // namespace kinesphere
