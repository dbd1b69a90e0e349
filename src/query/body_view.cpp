#include "engine/engine.hpp"

#include <algorithm>

#include "bodies/shaped_body.hpp"

namespace kinesphere {

BodyView World::Engine::view(std::uint32_t number) const {
  const Bodies& bodies = this->bodies();
  const double now = time();
  const Body& body = bodies[number];
  const Space& space = bodies.space();
  const double radius = bodies.radius_at(number, now);
  BodyView view{bodies.definition_of(number),
                body.bound,
                {},
                now,
                {},
                body.enabled,
                body.is_static(),
                body.is_sleeping(),
                body.has_shape() ? bodies.shapes.of(body) : Ball{body.bound.position, radius}};
  view.definition.radius = radius;
  if (body.is_rigid) view.rigid = rigid_body(bodies, number);
  if (is_registered(number)) {
    view.box = box(number);
    view.box_end = box_end(number);
  }
  if (!space.repeats()) return view;
  const auto [position, images] = space.wrapped(body.bound.position, body.bound.time);
  const Vec3 shift = space.shift_of(images, now);
  view.definition.position = view.bound.position = position;
  if (space.slides())
    for (Vec3* const velocity : {&view.bound.velocity, &view.definition.velocity})
      *velocity -= space.velocity_of(shift);
  if (!body.has_shape()) view.shape = Ball{position, radius};
  if (view.rigid) view.rigid->body.position = position;
  view.box = {view.box.lower - shift, view.box.upper - shift};
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double limit = 0x1p62;
    view.image[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(
        std::clamp(bodies.images[number].image[axis] + images[axis], -limit, limit));
  }
  return view;
}

}  // namespace kinesphere
