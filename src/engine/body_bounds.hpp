// What bodies take up, and the room around that in which they touch and sense others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <variant>

#include "bound/quick_reject.hpp"
#include "broadphase/inflated_bound.hpp"
#include "broadphase/window_policy.hpp"
#include "engine/bodies.hpp"
#include "engine/collision_shape.hpp"

namespace kinesphere {

// Extents.
inline CollisionShape collision_shape_of(const Bound& bound, const Shape& shape) {
  return {bound, true, std::holds_alternative<Ball>(shape) ? nullptr : &shape};
}
/// Of a body with this definition, which is where it says now.
Bound bound_now(const BodyDefinition& body, double now);
/// The body's bound, if its radius and errors were those of `changed`.
Bound bound_with(const Bodies& bodies, std::uint32_t number, const BodyDefinition& changed, double now);
/// What the body takes up, or would with another bound.
inline CollisionShape collision_shape_of(const Bodies& bodies, std::uint32_t number, const Bound& bound) {
  if (!bodies[number].is_static()) return {bound};
  return collision_shape_of(bound, bodies.shapes.of(bodies[number]));
}
inline CollisionShape collision_shape_of(const Bodies& bodies, std::uint32_t number) {
  return collision_shape_of(bodies, number, bodies[number].bound);
}
/// Where space repeats: what brings body b to the image in which body a may meet it while both are in their
/// windows.
inline Vec3 shift_to_meet(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  return bodies.space().shift_between_homes(bodies.images[b].middle, bodies.images[a].middle);
}
/// visit_extents() of two bodies as they are, in the image in which they may meet before the window of either
/// ends; in most worlds nothing is fixed and space does not repeat.
template <class Visit>
auto visit_pair(const Bodies& bodies, std::uint32_t a, std::uint32_t b, Visit visit) {
  if (bodies.space().repeats()) {
    Bound seen = bodies[b].bound;
    seen.position += shift_to_meet(bodies, a, b);
    return visit(bodies[a].bound, seen);
  }
  if (bodies.shapes.empty()) return visit(bodies[a].bound, bodies[b].bound);
  return visit_shapes(collision_shape_of(bodies, a), collision_shape_of(bodies, b), visit);
}
/// The limits of the gap of the two now, in the image in which they are nearest.
GapLimits gap_at(const Bodies& bodies, double now, const CollisionShape& a, const CollisionShape& b);
/// The body as events tell of it.
Sphere sphere_at(const Bodies& bodies, double now, std::uint32_t number);
/// Around the extent now, in the part of space that there is; cut off where no body comes.
Box box_now(const Bodies& bodies, const CollisionShape& extent, double now);
/// Of a fixed body, with room for all that it senses around it.
Box box_of_static(const Bodies& bodies, std::uint32_t number);

// What bodies sense.
inline Sensing sensing_of(const Bodies& bodies, std::uint32_t number) {
  return {bodies[number].sensor_class, bodies.filters.of(number).category};
}
inline double sensor_reach(const Bodies& bodies, std::uint32_t number) {
  return bodies.sensors.any() ? bodies.sensors.reach(bodies[number].sensor_class) : 0.0;
}
/// How far the gap of the two can be from one that means something: no sensor distance of either is larger.
inline double reach_of_pair(const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
  return bodies.sensors.any() ? std::max(sensor_reach(bodies, a), sensor_reach(bodies, b)) : 0.0;
}

// What windows have to know of bodies.
/// With room for all that the body can touch or sense.
InflatedBound inflated_bound(const Bodies& bodies, std::uint32_t number, double now);
/// The same for another bound of a body that can move.
inline InflatedBound margin_for(const Bodies& bodies, std::uint32_t number, const BoundAt& bound) {
  return {bound, sensor_reach(bodies, number) + bodies.definition().contact_tolerance};
}
inline SpeedBound speed_bound_of(const BoundAt& moved) {
  return {norm(moved.velocity) + moved.speed, moved.growth + norm(moved.acceleration)};
}
/// The place of a body that has gone farther since its last report could not be computed well (length).
inline double longest_way(const WorldDefinition& world) { return 0x1p40 * world.contact_tolerance; }
/// More than what rounding does to positions and ways, which are at most 2^45 contact tolerances; and so much
/// less than a tolerance that a certificate for two bodies that are not near spans most of it.
inline double rounding_margin(const WorldDefinition& world) { return world.contact_tolerance / 16.0; }

}  // namespace kinesphere
