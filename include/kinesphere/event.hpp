// What the world tells its caller.
#pragma once

#include <cstdint>
#include <string_view>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// In the order in which events of one instant are delivered.
enum class EventKind : std::uint8_t {
  /// A probe answered with a state that contradicts the body's own promise. The world goes on from
  /// the new report; what it certified since the last one may have been wrong.
  bound_violation,
  /// Two bodies touch: their gap has come down to at most the contact tolerance.
  contact_begin,
  /// Two bodies that touched are apart: their gap has grown to the separation distance.
  contact_end,
  /// A body touches a wall of the box.
  wall_begin,
  /// A body that touched a wall is clear of it.
  wall_end,
  /// Time would have stood still at a contact that is deep in its tolerance already. The Zeno guard moved it
  /// on by its least step, in which this pair may come to overlap by more than the contact tolerance.
  zeno_guard,
  /// The gap of two bodies has come down to a sensor distance (to at most that and the contact tolerance).
  sensor_enter,
  /// The gap of two bodies that were within a sensor distance has grown to the separation distance beyond it.
  sensor_leave,
  /// A body that rested (World::sleep) is awake again, where it was: it is probed from now on. These come
  /// before
  /// the other events that are still to come of their instant.
  woke,
};
inline constexpr int event_kind_count = 9;

/// Whether an event of this kind is about a sensor distance (Event::distance).
constexpr bool is_of_sensor(EventKind kind) {
  return kind == EventKind::sensor_enter || kind == EventKind::sensor_leave;
}

/// The walls of the box, by the axis and side on which they stand.
enum class Wall : std::uint8_t { none, x_lower, x_upper, y_lower, y_upper, z_lower, z_upper };
inline constexpr int wall_count = 6;

/// Which of the two bodies of a sensor event senses the other at its distance.
enum class Senses : std::uint8_t { neither, first, second, both };

/// "contact_begin" and so on: the names used in logs, summaries and messages.
std::string_view name_of(EventKind kind);
/// "x_lower" and so on; "none" for Wall::none.
std::string_view name_of(Wall wall);

struct Event {
  EventKind kind = EventKind::contact_begin;
  double time = 0.0;
  /// The body, or the one of the two with the smaller id.
  BodyId first = no_body;
  /// The other body; no_body for wall events, bound violations and bodies that are woken.
  BodyId second = no_body;
  /// The wall of a wall event, else Wall::none.
  Wall wall = Wall::none;
  /// True when one of the two bodies touched something less than its Zeno interval ago
  /// (WorldDefinition::zeno_interval): a response that loses energy should lose none here.
  bool repeated = false;
  /// True when each of the two bodies has had 64 contacts at this very instant already, as one that is stuck
  /// between walls has: an answer that gives back any speed would go on for ever. After 256 the Zeno guard
  /// moves time on by its least step.
  bool jammed = false;
  /// sensor_enter: whose sensor it is. A sensor_leave says the same as the sensor_enter before it, whatever
  /// sensors and classes have become since.
  Senses senses = Senses::neither;
  /// States at `time`. Those of a wall or of no_body are zero; that of a fixed body is one point of its
  /// shape, at rest. Where space repeats, the first is in the box, and the second in the image that is
  /// nearest to it, inside the box or not: the vector from one to the other is the one that a virial needs.
  /// BodyView::image tells how far each has come.
  State first_state{};
  State second_state{};
  /// The middle of the gap between the two surfaces (for a wall: the point of it that is nearest). Of a fixed
  /// body the nearest point counts and, inside a box, the nearest face.
  Vec3 point{};
  /// Unit vector from `first` towards `second`, or towards the wall.
  Vec3 normal{};
  /// Distance between the surfaces (length); negative when they overlap.
  double gap = 0.0;
  /// Speed at which the gap closes (length / time); negative when it opens.
  double approach_speed = 0.0;
  /// bound_violation: how far the reported position lies outside the bound (length), and by how much
  /// the velocity changed more than promised (length / time); each zero when it is within the promise.
  double position_excess = 0.0;
  double velocity_excess = 0.0;
  /// sensor_enter and sensor_leave: the sensor distance that has been crossed (length).
  double distance = 0.0;
  /// BodyDefinition::user_data of the two, of a body that has been removed as well; 0 for none.
  std::uint64_t first_user_data = 0;
  std::uint64_t second_user_data = 0;

  /// sensor_enter and sensor_leave: the body that senses, and the one that it senses. Where both sense each
  /// other, `first` counts as the sensor. no_body, with user data 0, for other events.
  constexpr BodyId sensor() const {
    if (senses == Senses::neither) return no_body;
    return senses == Senses::second ? second : first;
  }
  constexpr BodyId visitor() const {
    if (senses == Senses::neither) return no_body;
    return senses == Senses::second ? first : second;
  }
  constexpr std::uint64_t sensor_user_data() const {
    if (senses == Senses::neither) return 0;
    return senses == Senses::second ? second_user_data : first_user_data;
  }
  constexpr std::uint64_t visitor_user_data() const {
    if (senses == Senses::neither) return 0;
    return senses == Senses::second ? first_user_data : second_user_data;
  }
};

}  // namespace kinesphere
