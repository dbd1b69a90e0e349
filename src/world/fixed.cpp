// Bodies that never move: how they come, and where they are.
#include "world/fixed.hpp"

#include <cmath>
#include "number/infinity.hpp"
#include "world/engine.hpp"
#include "world/validation.hpp"

namespace kinesphere {
namespace {

/// A place for events and views to tell; a point of the shape.
Vec3 place_of(const Ball& ball) { return ball.centre; }
Vec3 place_of(const HalfSpace& solid) { return solid.normal * solid.offset; }
Vec3 place_of(const Box& box) { return 0.5 * box.lower + 0.5 * box.upper; }
Vec3 place_of(const Triangle& t) { return (t.a + t.b + t.c) / 3.0; }

}  // namespace

BodyDefinition body_of(const FixedDefinition& fixed) {
  const Ball* ball = std::get_if<Ball>(&fixed.shape);
  return {.radius = ball ? ball->radius : 0.0,
          .position = std::visit([](const auto& solid) { return place_of(solid); }, fixed.shape),
          .filter = fixed.filter,
          .solid = fixed.solid,
          .sensor_class = fixed.sensor_class,
          .user_data = fixed.user_data};
}

/// Bodies and their bounds, with all that they sense, reach less far than eight times the limit of their
/// coordinates.
Box World::Engine::box_of(const Shape& shape) const {
  return bounding_box(shape, 8.0 * coordinate_limit(definition_));
}

Shape World::Engine::as_kept(Shape shape) const {
  if (auto* solid = std::get_if<HalfSpace>(&shape); solid && std::abs(norm(solid->normal) - 1.0) > 0x1p-51)
    solid->normal = solid->normal / norm(solid->normal);
  if (auto* ball = std::get_if<Ball>(&shape); ball && space_.repeats())
    ball->centre = space_.wrapped(ball->centre).position;
  if (auto* box = std::get_if<Box>(&shape); box && space_.is_flat()) {
    box->upper.z = coordinate_limit(definition_);
    box->lower.z = -box->upper.z;
  }
  return shape;
}

BodyId World::Engine::add_fixed(const FixedDefinition& definition) {
  const std::uint32_t number = take_number();
  Body& body = bodies_[number];
  const BodyDefinition at_rest = body_of(definition);
  keep(number, at_rest);
  if (free_shapes_.empty()) {
    body.shape_number = static_cast<std::uint32_t>(shapes_.size());
    shapes_.push_back(definition.shape);
  } else {
    body.shape_number = free_shapes_.back();
    free_shapes_.pop_back();
    shapes_[body.shape_number] = definition.shape;
  }
  filtering_ = true;
  book_.add(number, 0.0);
  book_.set_fixed(number);
  appear(number, bound_now(at_rest));
  return id_of(number);
}

/// Of a fixed body, with room for all that it senses around it.
Box World::Engine::box_of_fixed(std::uint32_t number) const {
  const Vec3 room = Vec3{1.0, 1.0, 1.0} * sensors_.reach(bodies_[number].sensor_class);
  const Box box = box_of(shape(number));
  return space_.within({box.lower - room, box.upper + room});
}

}  // namespace kinesphere
