// Functions that give the volume of a body, and the margin around it in which it touches and senses others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <variant>

#include "bodies/bodies.hpp"
#include "bodies/collision_shape.hpp"
#include "bound/quick_reject.hpp"

namespace kinesphere {

// Collision shapes.
inline CollisionShape collision_shape_of(const Bound& bound, const Shape& shape) {
  return {bound, true, std::holds_alternative<Ball>(shape) ? nullptr : &shape};
}
/// Returns the collision shape of a body that carries a shape. `radius` is that of the ball around the shape.
inline CollisionShape carried_shape_of(const Bound& bound, const Shape& shape, double radius) {
  return {bound, false, &shape, radius};
}
/// Returns the bound of a body with this definition that is at its defined position at time `now`.
Bound bound_now(const BodyDefinition& body, double now);
/// Returns the bound that the body would have with the radius and the errors of `changed`.
Bound bound_with(const Bodies& bodies, std::uint32_t number, const BodyDefinition& changed, double now);
/// Returns the collision shape of the body with this bound in place of its own. That of a rigid body which
/// has been turned since its last report is the ball around it.
inline CollisionShape collision_shape_of(const Bodies& bodies, std::uint32_t number, const Bound& bound) {
  const Body& body = bodies[number];
  if (!body.is_shaped()) return {bound};
  if (body.has_parts() && bodies.rigid[body].is_changed) return {bound};
  if (body.has_parts()) return {bound, false, nullptr, body.radius, &bodies.rigid[body]};
  const Shape& shape = bodies.shapes.of(body);
  return body.carries_shape ? carried_shape_of(bound, shape, body.radius) : collision_shape_of(bound, shape);
}
inline CollisionShape collision_shape_of(const Bodies& bodies, std::uint32_t number) {
  return collision_shape_of(bodies, number, bodies[number].bound);
}
/// Returns the shift that moves body b to the image in which body a may meet it, from now on, while both are
/// in their safe regions. Requires periodic space.
inline Vec3 shift_to_meet(const Bodies& bodies, std::uint32_t a, std::uint32_t b, double now) {
  return bodies.space().shift_between_images(bodies.images[b].middle, bodies.images[a].middle, now);
}
/// Moves a bound, from now on, by a shift to another image.
inline void move_to_image(const Space& space, const Vec3& shift, BoundAt& bound) {
  bound.centre += shift;
  if (space.slides()) bound.velocity += space.velocity_of(shift);
}
/// Calls visit_shapes() for two bodies, in the image in which they may meet from now on.
/// Worlds without shapes and without periodic space take the shortest path.
template <class Visit>
auto visit_pair(const Bodies& bodies, std::uint32_t a, std::uint32_t b, double now, Visit visit) {
  if (bodies.space().repeats()) {
    Bound seen = bodies[b].bound;
    bodies.space().move(seen, shift_to_meet(bodies, a, b, now), now);
    if (!bodies.rigid.with_parts()) return visit(bodies[a].bound, seen);
    return visit_shapes(collision_shape_of(bodies, a), collision_shape_of(bodies, b, seen), visit);
  }
  if (bodies.are_balls()) return visit(bodies[a].bound, bodies[b].bound);
  return visit_shapes(collision_shape_of(bodies, a), collision_shape_of(bodies, b), visit);
}
/// Calls visit(bound, partner) for a body and the inside of a wall; the partner of a rigid body is their
/// RigidPair.
template <class Visit>
auto visit_wall(const CollisionShape& body, const HalfSpace& inside, Visit visit) {
  if (body.rigid == nullptr) return visit(body.bound, inside);
  const RigidExtent extent = body.extent();
  return visit(body.bound, RigidPair<HalfSpace>{extent, inside});
}
/// Returns the limits of the gap (length) between the two now, in the image in which they are nearest.
GapLimits gap_at(const Bodies& bodies, double now, const CollisionShape& a, const CollisionShape& b);
inline GapLimits gap_to_wall(const CollisionShape& body, const HalfSpace& inside, double now) {
  return visit_wall(body, inside, [now](const Bound& bound, const auto& partner) {
    return gap_limits(bound, partner, now);
  });
}
/// Returns the body in the form that events contain.
Sphere sphere_at(const Bodies& bodies, double now, std::uint32_t number);
/// Returns how the body moves in this form, in its image at this place.
BodyMotion motion_at(const Bodies& bodies, double now, std::uint32_t number, const Vec3& place);
/// Returns a box around the shape now, limited to existing space and cut off where no body can be.
Box box_now(const Bodies& bodies, const CollisionShape& extent, double now);
/// Returns the box of a static body, enlarged by its sensor reach.
Box box_of_static(const Bodies& bodies, std::uint32_t number);

// Sensors.
inline Sensing sensing_of(const Bodies& bodies, std::uint32_t number) {
  return {bodies[number].sensor_class, bodies.filters.of(number).category};
}
inline double sensor_reach(const Bodies& bodies, std::uint32_t number) {
  return bodies.sensors.any() ? bodies.sensors.reach(bodies[number].sensor_class) : 0.0;
}
/// Returns half of the distance (length) at which all bodies sense others. Extents of bodies leave it out:
/// two bodies sense each other up to the larger of their reaches, a and b, which are at least the common one,
/// c, so (a - c/2) + (b - c/2) >= max(a, b).
inline double left_out_of_extents(const Bodies& bodies) {
  return bodies.common_reach < infinity ? 0.5 * bodies.common_reach : 0.0;
}
/// Returns the largest sensor distance of the two bodies (length): the largest threshold of their gap.
inline double reach_of_pair(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  return bodies.sensors.any() ? std::max(sensor_reach(bodies, a), sensor_reach(bodies, b)) : 0.0;
}

/// Returns the ball around a static body now, with the margin (length) in which others touch or sense it.
Bound ball_around_static(const Bodies& bodies, std::uint32_t number, double now);
/// Returns a margin (length) that exceeds the rounding errors of positions and paths, which are at most 2^45
/// contact tolerances. It is so much smaller than a tolerance that a certificate for two bodies that are not
/// near covers most of the tolerance.
inline double rounding_margin(const WorldDefinition& world) { return world.contact_tolerance / 16.0; }

}  // namespace kinesphere
