// Static bodies, zones and moving shapes of a world: the public calls.
#include "world/changing.hpp"
#include "world/preconditions.hpp"

namespace kinesphere {

Result<BodyId> World::add_static(const StaticDefinition& body) {
  const Preconditions check(*this, "add_static");
  if (auto idle = check.idle(); !idle) return idle.error();
  const auto accepted = check.new_static(body, engine_->bodies().table().next_id());
  if (!accepted) return accepted.error();
  return changing(step::AddStatic{*accepted}).add_static(*accepted);
}

Result<BodyId> World::add_mesh(std::span<const Vec3> vertices,
                               std::span<const std::array<std::uint32_t, 3>> corners, const Filter& filter) {
  const auto mesh = Mesh::create(vertices, corners);
  if (!mesh) return mesh.error();
  return add_static({.shape = mesh.value(), .filter = filter});
}

Result<BodyId> World::add_zone(const Shape& shape, std::uint64_t user_data) {
  const Preconditions check(*this, "add_zone");
  if (auto idle = check.idle(); !idle) return idle.error();
  const auto accepted =
      check.new_static({.shape = shape, .solid = false, .sensor_class = zone_class, .user_data = user_data},
                       engine_->bodies().table().next_id());
  if (!accepted) return accepted.error();
  if (engine_->bodies().sensors.of(zone_class).distances.empty()) {
    Sensor touch = engine_->bodies().sensors.of(zone_class);
    touch.distances = {0.0};
    changing(step::SetSensor{zone_class, touch}).set_sensor(zone_class, touch);
  }
  return changing(step::AddStatic{*accepted}).add_static(*accepted);
}

Result<BodyId> World::add_moving_shape(const MovingShape& body) {
  const Preconditions check(*this, "add_moving_shape");
  if (auto idle = check.idle(); !idle) return idle.error();
  const auto accepted = check.new_moving_shape(body, engine_->bodies().table().next_id());
  if (!accepted) return accepted.error();
  return changing(step::AddMovingShape{*accepted}).add_moving_shape(*accepted);
}

Result<std::vector<BodyId>> World::add_static_all(std::span<const StaticDefinition> bodies) {
  if (auto idle = Preconditions(*this, "add_static_all").idle(); !idle) return idle.error();
  std::vector<StaticDefinition> accepted;
  accepted.reserve(bodies.size());
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const std::string call = "add_static_all: bodies[" + std::to_string(number) + "]";
    auto valid =
        Preconditions(*this, call).new_static(bodies[number], engine_->bodies().table().next_id(number));
    if (!valid) return valid.error();
    accepted.push_back(*valid);
  }
  std::vector<BodyId> ids;
  ids.reserve(accepted.size());
  for (const StaticDefinition& body : accepted)
    ids.push_back(changing(step::AddStatic{body}).add_static(body));
  return ids;
}

Result<void> World::set_shape(BodyId body, const Shape& shape) {
  const auto accepted = Preconditions(*this, "set_shape").reshaped(body, shape);
  if (!accepted) return accepted.error();
  changing(step::SetShape{body, *accepted}).set_shape(body, *accepted);
  return {};
}

}  // namespace kinesphere
