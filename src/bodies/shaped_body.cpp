// Conversion of a body with a shape to a body definition and to a shape.
#include "bodies/shaped_body.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "bodies/validation.hpp"
#include "bound/rigid_part.hpp"
#include "bound/rounding.hpp"
#include "number/infinity.hpp"
#include "space/space.hpp"

namespace kinesphere {
namespace {

/// Returns a point of the shape, which events and views show as the position.
Vec3 anchor_of(const Ball& ball) { return ball.centre; }
Vec3 anchor_of(const HalfSpace& solid) { return solid.normal * solid.offset; }
Vec3 anchor_of(const Box& box) { return 0.5 * box.lower + 0.5 * box.upper; }
Vec3 anchor_of(const Triangle& t) { return (t.a + t.b + t.c) / 3.0; }
Vec3 anchor_of(const Mesh& mesh) {
  if (mesh.size() == 0) return {};
  const Triangle first = mesh.triangle(0);
  // Of a chain, the middle of the first segment.
  return mesh.is_chain() ? 0.5 * (first.a + first.c) : anchor_of(first);
}

}  // namespace

BodyDefinition body_of(const StaticDefinition& definition) {
  const Ball* ball = std::get_if<Ball>(&definition.shape);
  return {.radius = ball ? ball->radius : 0.0,
          .position = std::visit([](const auto& solid) { return anchor_of(solid); }, definition.shape),
          .filter = definition.filter,
          .solid = definition.solid,
          .contacts = ContactEvents{},
          .sensor_class = definition.sensor_class,
          .user_data = definition.user_data,
          .mass = infinity};
}

BodyDefinition body_of(const MovingShape& definition, const WorldDefinition& world) {
  const auto farthest_of = [&world]<class Solid>(const Solid& solid) {
    double square = 0.0;
    if constexpr (std::is_same_v<Solid, Triangle>) {
      for (const Vec3& corner : {solid.a, solid.b, solid.c}) square = std::max(square, norm_squared(corner));
    } else if constexpr (std::is_same_v<Solid, Mesh>) {
      for (const auto& triple : solid.corners())
        for (const std::uint32_t corner : triple)
          square = std::max(square, norm_squared(solid.vertices()[corner]));
    } else if constexpr (std::is_same_v<Solid, Box>) {
      for (int axis = 0; axis < world.dimensions; ++axis)
        square += std::max(solid.lower[axis] * solid.lower[axis], solid.upper[axis] * solid.upper[axis]);
    }
    return std::sqrt(square) * (1.0 + rounding::margin);
  };
  BodyDefinition body = definition.body;
  body.radius = std::visit(farthest_of, definition.shape);
  return body;
}

BodyDefinition body_of(const RigidBody& definition) {
  BodyDefinition body = definition.body;
  body.radius = 0.0;
  if (is_round(definition.parts)) {
    body.radius = definition.parts[0].radius;
    return body;
  }
  for (const RigidPart& part : definition.parts)
    body.radius = std::max(body.radius, outer_radius(part) * (1.0 + rounding::margin));
  return body;
}

RigidRecord record_of(const RigidBody& definition, double time) {
  RigidRecord record{.parts = definition.parts,
                     .balls = balls_around(definition.parts),
                     .angular_acceleration_limit = definition.angular_acceleration_limit,
                     .largest_angular_speed = definition.largest_angular_speed,
                     .inertia = definition.inertia};
  const auto& [orientation, spin] = definition.rotation;
  record.change({after(orientation, Quaternion{}), spin}, time, true);
  return record;
}

RigidBody rigid_body(const Bodies& bodies, std::uint32_t number) {
  const RigidRecord& record = bodies.rigid[bodies[number]];
  return {.body = bodies.definition_of(number),
          .parts = record.parts,
          .rotation = record.is_changed ? record.origin : record.rotation,
          .angular_acceleration_limit = record.angular_acceleration_limit,
          .largest_angular_speed = record.largest_angular_speed,
          .inertia = record.inertia};
}

StaticDefinition static_definition(const Bodies& bodies, BodyId id) {
  const Body& body = bodies[id.index];
  return {bodies.shapes.of(body), bodies.filters.of(id.index), body.solid, body.sensor_class, body.user_data};
}

Shape normalized(Shape shape, const WorldDefinition& world) {
  const Space space(world);
  if (auto* solid = std::get_if<HalfSpace>(&shape); solid && std::abs(norm(solid->normal) - 1.0) > 0x1p-51)
    solid->normal = solid->normal / norm(solid->normal);
  if (auto* ball = std::get_if<Ball>(&shape); ball && space.repeats())
    ball->centre = space.wrapped(ball->centre, world.start_time).position;
  if (auto* box = std::get_if<Box>(&shape); box && space.is_flat()) {
    box->upper.z = coordinate_limit(world);
    box->lower.z = -box->upper.z;
  }
  return shape;
}

Shape normalized_carried(Shape shape, const WorldDefinition& world) {
  if (auto* box = std::get_if<Box>(&shape); box && world.dimensions == 2) {
    box->upper.z = 0.0;
    for (const double x : {box->lower.x, box->lower.y, box->upper.x, box->upper.y})
      box->upper.z = std::max(box->upper.z, std::abs(x));
    box->lower.z = -box->upper.z;
  }
  return shape;
}

}  // namespace kinesphere
