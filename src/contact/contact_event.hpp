// Contents of contact and wall events, computed from the spheres at the time of the event.
#pragma once

#include "bound/bound_violation.hpp"
#include "bound/rigid_record.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/shape.hpp"
#include "space/space.hpp"

namespace kinesphere {

inline bool begins(EventKind kind) {
  return kind == EventKind::contact_begin || kind == EventKind::wall_begin || kind == EventKind::sensor_enter;
}

/// State of one body at one time, as far as an event describes it.
struct Sphere {
  BodyId id;
  double radius;
  State state;
  /// Shape of a static body that is not a ball, or of a body that carries one (then `radius` is ignored),
  /// otherwise nullptr.
  const Shape* shape = nullptr;
  bool carries_shape = false;  ///< the origin of the shape is the position in `state`
  std::uint64_t user_data = 0;
  double mass = 1.0;
  BodyTraits traits{};
  ContactEvents wanted = ContactEvents::all;
  const RigidRecord* rigid = nullptr;  ///< of a rigid body; then `radius` is ignored
  double radius_rate = 0.0;            ///< at which the radius grows (length / time)
  double position_error = 0.0;         ///< of a body whose radius is ignored; gaps are smaller by it (length)
  Rotation rotation{};                 ///< of a rigid body
  Vec3 planned_acceleration{};         ///< from the bound (length / time^2)
  double other_acceleration = 0.0;     ///< largest one of a point beside the planned one (length / time^2)
};

/// How a body moves now, as far as a response can have changed it.
struct BodyMotion {
  Vec3 velocity;
  Vec3 spin;           ///< angular velocity of a rigid body
  double radius_rate;  ///< at which the radius grows (length / time)
  ContactEvents wanted;
};
inline BodyMotion motion_of(const Sphere& body) {
  return {body.state.velocity, body.rotation.angular_velocity, body.radius_rate, body.wanted};
}

/// Bounds the rounding error that radii that change at these rates add to the approach speed.
inline double rate_error(double rates) { return 0x1p-49 * rates; }

/// Event::first becomes the body with the smaller id, in whichever order the two are passed. In periodic
/// space the image of Event::second nearest to Event::first is described.
Event contact_event(EventKind kind, double time, const Sphere& a, const Sphere& b, const Space& space = {});
Event wall_event(EventKind kind, double time, const Sphere& sphere, const Box& box, Wall wall);
/// Recomputes all geometric fields of a contact or wall event from the present spheres.
void describe(Event& event, const Sphere& first, const Sphere& second, const Space& space);
void describe(Event& event, const Sphere& sphere, const Box& box);
/// Sets what an event says of velocities to those that its bodies have now, where they were described at this
/// time. `second` is ignored if the event is about a wall. Returns the sum of the rates at which the radii
/// change (length / time).
double turn(Event& event, const BodyMotion& first, const BodyMotion& second);
/// Bounds the rounding error in the approach speed of two bodies with these states (length / time).
/// `arm` is the length of the vector along the normal: from centre to centre, or from a centre to the nearest
/// point of a shape; +infinity where the normal is that of a wall or a half-space. The bound covers rounding
/// by the caller in positions and velocities: a few units in the last place each.
double approach_error(const State& first, const State& second, double arm);
/// Bounds the rounding error of Event::approach_speed after describe(). Rigid bodies count with their
/// velocities at the contact point. `rates`: sum of those at which the radii change (length / time).
double approach_error(const Event& event, double arm, double rates = 0.0);

/// What the contact rule has to know of the bodies of an event, beside what the event says.
struct ContactTerms {
  ContactEvents wanted;
  double arm;           ///< of the normal (approach_error())
  double rates;         ///< sum of those at which the radii change (length / time)
  double acceleration;  ///< largest one with which they can be pressed upon each other (length / time^2)
};
/// `second` is ignored if the event is about a wall.
ContactTerms terms_of(const Event& event, const Sphere& first, const Sphere& second);

/// An event, described as its bodies are now.
struct DescribedEvent {
  Event event;
  ContactTerms terms;
};
/// Returns a woke event. The body stands at the centre of the sphere.
Event woke_event(double time, const Sphere& sphere);
/// Returns a bound_violation event. The sphere's state is the violating report, and `acceleration_limit` that
/// of the body from now on.
Event violation_event(double time, const Sphere& sphere, const BoundViolation& broken,
                      double acceleration_limit);

/// Returns the walls of a world as a box with limits -infinity and +infinity on axes without walls. Returns
/// nullopt if no axis has walls.
std::optional<Box> walls_of(const WorldDefinition& definition);
/// True if a box from walls_of() has this wall. Precondition: wall != Wall::none.
bool stands(const Box& box, Wall wall);

/// Returns true if the walls, if there are any, meet a body with this filter.
inline bool meets_walls(const WorldDefinition& world, const Filter& filter) {
  return !world.wall_filter || passes(*world.wall_filter, filter);
}

/// Returns the half-space inside a wall of the box. Precondition: stands(box, wall).
HalfSpace half_space(const Box& box, Wall wall);

/// Bit of a wall in a set of walls. Precondition: wall != Wall::none.
inline constexpr std::uint8_t wall_bit(Wall wall) {
  return static_cast<std::uint8_t>(1u << (static_cast<unsigned>(wall) - 1u));
}

/// All six walls, to iterate over.
inline constexpr Wall walls[] = {Wall::x_lower, Wall::x_upper, Wall::y_lower,
                                 Wall::y_upper, Wall::z_lower, Wall::z_upper};

/// Delivery order of events at one time: by kind, first, second, wall, distance.
bool delivered_before(const Event& a, const Event& b);
/// Comparator for sets of events at one time. Two events that compare equivalent are the same event.
struct DeliveredBefore {
  bool operator()(const Event& a, const Event& b) const { return delivered_before(a, b); }
};

}  // namespace kinesphere
