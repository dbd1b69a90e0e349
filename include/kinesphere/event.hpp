// Events: what a world reports to its caller.
#pragma once

#include <cstdint>
#include <string_view>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// Kinds of events. The order of the enumerators is the order of delivery within one instant.
enum class EventKind : std::uint8_t {
  /// A probed state contradicts the motion limits of its body: its limit is too small, gravity or a change of
  /// velocity was not declared, or the velocity is not that of the position. The world continues from the new
  /// report; certificates since the previous report may have been wrong.
  bound_violation,
  /// Two bodies begin to touch: their gap has shrunk to at most the contact tolerance. Or two bodies that
  /// have not separated since approach again (Event::already_touching): an approach is reported once, and
  /// anew after the velocities of the two have parted them. A response that parts the two at each begin
  /// therefore never lets them pass through each other.
  contact_begin,
  /// Two touching bodies separate: their gap has grown to the separation distance.
  contact_end,
  /// A body begins to touch a wall of the box, or approaches it again, as for contact_begin.
  wall_begin,
  /// A body that touched a wall separates from it.
  wall_end,
  /// The Zeno guard advances time by its least step, because time would otherwise stop at a contact deep
  /// within its tolerance. From now on the two may overlap by more than the contact tolerance. Reported once
  /// for each contact, and once more if the two are let through (Event::jammed).
  zeno_guard,
  /// The gap of two bodies has shrunk to a sensor distance (to at most that distance plus the contact
  /// tolerance).
  sensor_enter,
  /// The gap of two bodies within a sensor distance has grown to that distance plus the separation
  /// distance.
  sensor_leave,
  /// A sleeping body (World::sleep) is awake again, at its place; it is probed from now on. These events
  /// precede the remaining events of their instant.
  woke,
  /// A timer of the caller's own (World::schedule). It names no body, and Event::first_user_data is that of
  /// the timer.
  timer,
};
/// Number of event kinds.
inline constexpr int event_kind_count = 10;

/// Returns true for events at a sensor distance (Event::distance).
constexpr bool is_of_sensor(EventKind kind) {
  return kind == EventKind::sensor_enter || kind == EventKind::sensor_leave;
}

/// The walls of the box, by axis and side.
enum class Wall : std::uint8_t { none, x_lower, x_upper, y_lower, y_upper, z_lower, z_upper };
/// Number of enumerators of Wall that are walls.
inline constexpr int wall_count = 6;

/// Which of the two bodies of a sensor event senses the other one at the event's distance.
enum class Senses : std::uint8_t { neither, first, second, both };

/// Returns the name used in logs, summaries and messages, such as "contact_begin".
std::string_view name_of(EventKind kind);
/// Returns the name of a wall, such as "x_lower"; "none" for Wall::none.
std::string_view name_of(Wall wall);

/// Properties of one body of an event.
struct BodyTraits {
  /// The body never moves (World::add_static). World::set_velocity() refuses it with static_body.
  bool is_static = false;
  /// The body is not solid (BodyDefinition::solid): it touches no other body, and only senses and is sensed.
  bool is_zone = false;
  /// The body sleeps (World::sleep) and stays asleep. False at contact_begin and contact_end, which wake
  /// their bodies.
  bool is_sleeping = false;

  friend constexpr bool operator==(const BodyTraits&, const BodyTraits&) = default;
};

/// What happened to a body or between two, at its exact time.
struct Event {
  EventKind kind = EventKind::contact_begin;
  double time = 0.0;
  /// The body of the event or, for a pair, the body with the smaller id; no_body for a timer.
  BodyId first = no_body;
  /// The other body of a pair; no_body for wall events, bound violations, bodies that woke and timers.
  BodyId second = no_body;
  /// The wall of a wall event; Wall::none for all other events.
  Wall wall = Wall::none;
  /// True if one of the two bodies had another contact less than its Zeno interval ago
  /// (WorldDefinition::zeno_interval), and this one is a hop of bodies that rest: something presses the two
  /// upon each other, and they approach at less than 4 sqrt(eps a), a its acceleration, or at the very
  /// instant of that other contact. Bodies that fall together press nothing. A dissipative response should
  /// lose no energy at this contact.
  bool repeated = false;
  /// True if each of the two bodies has already had 64 contacts at this very instant, for example a body
  /// stuck between walls. A response that returns any speed would continue for ever. After 256 contacts the
  /// Zeno guard advances time by its least step. A pair whose responses go on to return speed is let through
  /// until it has separated, after 8 such steps or if it is deep within the tolerance. So is a pair of a body
  /// that is crushed, as between a piston and a wall, after 64 such steps in a row. EventKind::zeno_guard
  /// reports it.
  bool jammed = false;
  /// contact_begin, wall_begin: true if the two have been in touch since an earlier begin, without an end in
  /// between (never with ContactEvents::impacts). To count contacts, count the begins for which it is
  /// false.
  bool already_touching = false;
  /// sensor_enter: the body or bodies that sense. A sensor_leave repeats the value of its sensor_enter,
  /// even if sensors and classes have changed since.
  Senses senses = Senses::neither;
  BodyTraits first_traits{};
  BodyTraits second_traits{};  ///< all false for a wall or no_body
  /// The state that the caller has given the two bodies of a pair (World::set_pair_state); 0 for all others,
  /// and where one of the two has been removed.
  std::int32_t pair_state = 0;
  /// States of the two bodies at `time`. The state is zero for a wall or no_body; for a static body it is
  /// one point of its shape, with zero velocity. On periodic axes the first body is in the primary image,
  /// and the second one in its nearest image, inside the box or not, so that the vector between them is the
  /// one that a virial needs. BodyView::image gives the number of boxes that each has travelled. Where images
  /// slide, each velocity is that of the image that is shown.
  State first_state{};
  State second_state{};
  /// Midpoint of the gap between the two surfaces; for a wall, the point of the wall nearest to the body.
  /// For a static body the gap is measured at its nearest point and, inside a box, at the nearest face.
  Vec3 point{};
  /// Unit vector from `first` towards `second`, or towards the wall.
  Vec3 normal{};
  /// Distance between the two surfaces (length); negative when they overlap.
  double gap = 0.0;
  /// Rate at which the gap shrinks (length / time), spin included; negative when it grows.
  double approach_speed = 0.0;
  /// bound_violation: the distance by which the reported position lies outside the bound (length), and the
  /// amount by which the velocity change exceeds the motion limits (length / time). Each is zero when
  /// within its limit.
  double position_excess = 0.0;
  double velocity_excess = 0.0;
  /// sensor_enter and sensor_leave: the sensor distance that the gap has crossed (length).
  double distance = 0.0;
  /// BodyDefinition::user_data of the two bodies, also of removed bodies; 0 for a wall or no_body. Of a
  /// timer, the first is Timer::user_data.
  std::uint64_t first_user_data = 0;
  std::uint64_t second_user_data = 0;
  /// BodyDefinition::mass of the two bodies; infinity for a static body and for a wall; 1 for no_body.
  double first_mass = 1.0;
  double second_mass = 1.0;
  /// Of rigid bodies (World::add_rigid_body), for events of two bodies and of walls: the part at the contact,
  /// as an index into RigidBody::parts, and the angular velocity (radians / time). Of a mesh, the triangle at
  /// the contact. 0 for all other bodies.
  std::uint32_t first_part = 0;
  std::uint32_t second_part = 0;
  Vec3 first_angular_velocity{};
  Vec3 second_angular_velocity{};
  /// Change of the angular velocity of a rigid body by a unit impulse along the normal at the point (radians
  /// / (mass length)), from RigidBody::inertia; zero for all other bodies.
  Vec3 first_spin_gain{};
  Vec3 second_spin_gain{};
  /// bound_violation: the acceleration limit that the body has from now on (length / time^2), which the world
  /// may just have raised (WorldDefinition::adopt_observed_limits). 0 for all other events.
  double acceleration_limit = 0.0;

  /// Returns true if the body can be given a velocity: there is one, and it is not static.
  constexpr bool first_can_move() const { return first != no_body && !first_traits.is_static; }
  constexpr bool second_can_move() const { return second != no_body && !second_traits.is_static; }

  /// Returns the other body of a pair; no_body if there is no other one, or `body` has no part in the event.
  constexpr BodyId partner_of(BodyId body) const {
    if (body == no_body) return no_body;
    return body == first ? second : body == second ? first : no_body;
  }

  /// Returns true if `body` senses the other body of this sensor_enter or sensor_leave. The events of one
  /// zone or sensor are those for which this is true, whether or not the other body senses it, too.
  constexpr bool is_sensed_by(BodyId body) const {
    if (body == no_body) return false;
    return (body == first && (senses == Senses::first || senses == Senses::both)) ||
           (body == second && (senses == Senses::second || senses == Senses::both));
  }

  /// For sensor_enter and sensor_leave, sensor() returns the sensing body and visitor() the sensed one. If
  /// each senses the other, `first` is the sensor: to select the events of one body, use is_sensed_by() and
  /// partner_of(). For all other events they return no_body, with user data 0.
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

  friend constexpr bool operator==(const Event&, const Event&) = default;
};

}  // namespace kinesphere
