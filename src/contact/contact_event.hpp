// What a contact event says, from the spheres as they are at that instant.
#pragma once

#include "bound/bound_violation.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/shape.hpp"
#include "space/space.hpp"

namespace kinesphere {

inline bool begins(EventKind kind) {
  return kind == EventKind::contact_begin || kind == EventKind::wall_begin || kind == EventKind::sensor_enter;
}

/// A body at an instant.
struct Sphere {
  BodyId id;
  double radius;
  State state;
  const Shape* shape = nullptr;  ///< of a fixed body that is no ball: then that counts, not the radius
  std::uint64_t user_data = 0;
};

/// Event::first is the one with the smaller id, whichever comes first here.
Event contact_event(EventKind kind, double time, const Sphere& a, const Sphere& b);
/// Event::second is seen in its image nearest to the first.
Event contact_event(EventKind kind, double time, const Sphere& a, const Sphere& b, const Space& space);
Event wall_event(EventKind kind, double time, const Sphere& sphere, const Box& box, Wall wall);
/// Brings what an event of a contact or a wall says up to date with the spheres as they are now.
void describe(Event& event, const Sphere& first, const Sphere& second, const Space& space);
void describe(Event& event, const Sphere& sphere, const Box& box);
/// How much rounding may have done to the approach speed of an event that one of these has described. `arm`
/// is the length of the vector along the normal, from centre to centre or from a centre to the nearest point
/// of a shape; +infinity where the normal is that of a wall or a half-space. Covers what the caller's own
/// roundings do to positions and velocities: a few units in the last place each.
double approach_error(const Event& event, double arm);
double approach_error(const Event& event, const Sphere& first, const Sphere& second);
/// A bound_violation of the sphere, whose state is the report.
Event violation_event(double time, const Sphere& sphere, const BoundViolation& broken);

/// The walls of a world as a box, from -infinity to +infinity on axes that have none; nothing where no axis
/// has any.
std::optional<Box> walls_of(const WorldDefinition& definition);
/// Whether a box of this kind has the wall.
bool stands(const Box& box, Wall wall);

/// The half-space inside a wall of the box, one that stands.
HalfSpace half_space(const Box& box, Wall wall);

/// The bit of a wall in a set of walls.
inline constexpr std::uint8_t wall_bit(Wall wall) {
  return static_cast<std::uint8_t>(1u << (static_cast<unsigned>(wall) - 1u));
}

/// All walls, for loops.
inline constexpr Wall walls[] = {Wall::x_lower, Wall::x_upper, Wall::y_lower,
                                 Wall::y_upper, Wall::z_lower, Wall::z_upper};

/// The order in which events of one instant are delivered: kind, first, second, wall, distance.
bool delivered_before(const Event& a, const Event& b);
/// For sets of events of one instant, which hold each event once.
struct DeliveredBefore {
  bool operator()(const Event& a, const Event& b) const { return delivered_before(a, b); }
};

}  // namespace kinesphere
