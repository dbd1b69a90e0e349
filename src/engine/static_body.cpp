// Conversion of a static body to a body definition and to a shape.
#include "engine/static_body.hpp"

#include <cmath>

#include "engine/validation.hpp"
#include "number/infinity.hpp"
#include "space/space.hpp"

namespace kinesphere {
namespace {

/// Returns a point of the shape, which events and views show as the position.
Vec3 anchor_of(const Ball& ball) { return ball.centre; }
Vec3 anchor_of(const HalfSpace& solid) { return solid.normal * solid.offset; }
Vec3 anchor_of(const Box& box) { return 0.5 * box.lower + 0.5 * box.upper; }
Vec3 anchor_of(const Triangle& t) { return (t.a + t.b + t.c) / 3.0; }

}  // namespace

BodyDefinition body_of(const StaticDefinition& definition) {
  const Ball* ball = std::get_if<Ball>(&definition.shape);
  return {.radius = ball ? ball->radius : 0.0,
          .position = std::visit([](const auto& solid) { return anchor_of(solid); }, definition.shape),
          .filter = definition.filter,
          .solid = definition.solid,
          .sensor_class = definition.sensor_class,
          .user_data = definition.user_data,
          .mass = infinity};
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
    ball->centre = space.wrapped(ball->centre).position;
  if (auto* box = std::get_if<Box>(&shape); box && space.is_flat()) {
    box->upper.z = coordinate_limit(world);
    box->lower.z = -box->upper.z;
  }
  return shape;
}

}  // namespace kinesphere
