// The surroundings of a world: the calls about fixed bodies.
#include "world/changing.hpp"
#include "world/check.hpp"

namespace kinesphere {

Result<BodyId> World::add_fixed(const FixedDefinition& body) {
  const Check check(*this, "add_fixed");
  if (auto idle = check.idle(); !idle) return idle.error();
  const auto kept = check.new_fixed(body, engine_->bodies().table().next_id());
  if (!kept) return kept.error();
  return changing(step::AddFixed{*kept}).add_fixed(*kept);
}

Result<BodyId> World::add_zone(const Shape& shape, std::uint64_t user_data) {
  const Check check(*this, "add_zone");
  if (auto idle = check.idle(); !idle) return idle.error();
  const auto kept =
      check.new_fixed({.shape = shape, .solid = false, .sensor_class = zone_class, .user_data = user_data},
                      engine_->bodies().table().next_id());
  if (!kept) return kept.error();
  if (engine_->bodies().sensors.of(zone_class).distances.empty()) {
    Sensor touch = engine_->bodies().sensors.of(zone_class);
    touch.distances = {0.0};
    changing(step::SetSensor{zone_class, touch}).set_sensor(zone_class, touch);
  }
  return changing(step::AddFixed{*kept}).add_fixed(*kept);
}

Result<std::vector<BodyId>> World::add_fixed_all(std::span<const FixedDefinition> bodies) {
  if (auto idle = Check(*this, "add_fixed_all").idle(); !idle) return idle.error();
  std::vector<FixedDefinition> kept;
  kept.reserve(bodies.size());
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const std::string call = "add_fixed_all: bodies[" + std::to_string(number) + "]";
    auto valid = Check(*this, call).new_fixed(bodies[number], engine_->bodies().table().next_id(number));
    if (!valid) return valid.error();
    kept.push_back(*valid);
  }
  std::vector<BodyId> ids;
  ids.reserve(kept.size());
  for (const FixedDefinition& body : kept) ids.push_back(changing(step::AddFixed{body}).add_fixed(body));
  return ids;
}

Result<Shape> World::shape_of(BodyId body) const {
  if (auto valid = Check(*this, "shape_of").known(body); !valid) return valid.error();
  const Body& kept = engine_->bodies()[body.index];
  if (kept.is_fixed()) return engine_->bodies().shapes.of(kept);
  return Shape(Ball{kept.bound.position, kept.radius});
}

}  // namespace kinesphere
