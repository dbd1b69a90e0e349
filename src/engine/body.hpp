// A body as the engine keeps it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"

namespace kinesphere {

/// What the bound tells is not kept again: the state of the last report and, but for position_error, the
/// promise.
struct Body {
  /// In place of a number in a table.
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  Bound bound{};  ///< since the last report
  /// Changes when all that is known about the body becomes void (PairCertificate).
  std::uint32_t revision = 0;

  bool alive = false;
  bool enabled = true;
  bool dirty = false;    ///< in the list of those to settle before time moves on
  bool visited = false;  ///< in the present round
  /// It has come to where it is, or nothing is known of whom it may meet, since windows started: it may start
  /// together with all others.
  bool relocated = false;
  // As in BodyDefinition.
  bool solid = true;
  SensorClass sensor_class = 0;
  std::uint32_t shape_number = none;   ///< in the table of the shapes of fixed bodies
  std::uint32_t change_number = none;  ///< in the table of changes
  std::uint32_t generation = 0;
  std::uint32_t sleep_number = none;  ///< in the table of rests
  double radius = 0.0;
  double position_error = 0.0;
  std::uint64_t user_data = 0;

  bool present() const { return alive && enabled; }
  bool is_static() const { return shape_number != none; }
  bool is_sleeping() const { return sleep_number != none; }
  /// It rests, and the world has known where since it does. Then its bound stands still.
  bool is_at_rest() const { return is_sleeping() && change_number == none; }
  /// Its bound neither moves nor grows.
  bool stands_still() const {
    return bound.velocity == Vec3{} && bound.planned_acceleration == Vec3{} && bound.growth_speed == 0.0 &&
           bound.growth_acceleration == 0.0;
  }
  void stand_still() {
    bound.velocity = bound.planned_acceleration = {};
    bound.growth_speed = bound.growth_acceleration = 0.0;
  }
  void mark_visited() { dirty = visited = relocated = false; }
  /// The world knows its present state.
  bool fresh(double time) const { return bound.time == time || is_static() || is_at_rest(); }
  double largest_acceleration() const { return bound.growth_acceleration + norm(bound.planned_acceleration); }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [since_report, own_stamp, lives, takes_part, unsettled, is_settled, has_come, touches, senses_as,
           own_shape, own_change, own_generation, own_rest, size, error, data] = self;
    archive(since_report, own_stamp, lives, takes_part, unsettled, is_settled, has_come, touches, senses_as,
            own_shape, own_change, own_generation, own_rest, size, error, data);
  }
};
static_assert(sizeof(Body) <= 168);

/// What the caller has changed about a body since its last report; the next report, or its return after it
/// was disabled, puts it into force.
struct Change {
  std::uint32_t body = 0;
  std::optional<Vec3> velocity{};  ///< its velocity
  MotionLimits limits{};

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [whose, velocity, promised] = self;
    archive(whose, velocity, promised);
  }
};

/// What a body that rests promises once it is awake.
struct SleepRecord {
  std::uint32_t body = 0;
  MotionLimits limits{};

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [whose, awake] = self;
    archive(whose, awake);
  }
};

}  // namespace kinesphere
