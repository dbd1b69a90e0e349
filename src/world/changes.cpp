// Changes that the caller makes to bodies: their place, their shape, their promise, their filter.
#include "world/engine.hpp"

namespace kinesphere {

Bound World::Engine::bound_with(BodyId id, const BodyDefinition& changed) const {
  const Body& body = bodies_[id.index];
  if (body.fresh(time_)) return bound_of(changed, {body.bound.position, body.bound.velocity}, time_);
  // The old promise held until now, and the next report comes before time moves on.
  Bound bound = body.bound;
  bound.radius = changed.radius + (bound.radius - body.definition.radius);
  return bound;
}

std::optional<Wall> World::Engine::certain_overlap_of_wall(const Bound& bound) const {
  if (!walls_) return std::nullopt;
  for (const Wall wall : walls)
    if (stands(*walls_, wall) &&
        gap_limits(bound, half_space(*walls_, wall), time_).upper < -definition_.contact_tolerance)
      return wall;
  return std::nullopt;
}

/// Another bound takes the place of the body's. Contacts that it certainly ends are over with the states
/// before.
void World::Engine::replace(std::uint32_t number, const Bound& bound) {
  const double apart = book_.rule().separation_distance();
  const auto ends = [&](const Event& end) {
    if (book_.pending().contains(end)) return true;
    const std::uint32_t partner = end.first.index == number ? end.second.index : end.first.index;
    const GapLimits gap = end.wall == Wall::none ? gap_now(extent(number, bound), extent(partner))
                                                 : gap_limits(bound, half_space(*walls_, end.wall), time_);
    return gap.lower >= end.distance + apart;
  };
  book_.end_contacts(
      number, time_, [this](std::uint32_t other) { return sphere(other); }, walls_, ends);
  void_facts(number);
  appear(number, bound);
}

void World::Engine::teleport(BodyId id, const State& state) {
  Body& body = bodies_[id.index];
  if (definition_.contacts == ContactMode::impacts) book_.release_all(id.index);
  body.image = {};
  replace(id.index, bound_of(body.definition, state, time_));
  body.definition.position = state.position;
  body.definition.velocity = state.velocity;
  body.kicked_since_report = false;
}

void World::Engine::set_radius(BodyId id, double radius) {
  Body& body = bodies_[id.index];
  BodyDefinition changed = body.definition;
  changed.radius = radius;
  if (body.enabled) replace(id.index, bound_with(id, changed));
  body.definition = changed;
}

void World::Engine::set_promise(BodyId id, const MotionPromise& promise) {
  Body& body = bodies_[id.index];
  const BodyDefinition changed = with_promise(body.definition, promise);
  if (body.enabled) replace(id.index, bound_with(id, changed));
  body.definition = changed;
  book_.set_largest_acceleration(id.index, body.largest_acceleration());
}

void World::Engine::disable(BodyId id) {
  Body& body = bodies_[id.index];
  withdraw(id.index);
  body.kicked_since_report = false;
  body.enabled = false;
}

void World::Engine::enable(BodyId id, const State& state) {
  Body& body = bodies_[id.index];
  body.enabled = true;
  if (body.is_fixed()) return appear_fixed(id.index);
  body.definition.position = state.position;
  body.definition.velocity = state.velocity;
  body.image = {};
  appear(id.index, bound_now(body.definition));
}

void World::Engine::set_filter(BodyId id, const Filter& filter) {
  BodyDefinition& definition = bodies_[id.index].definition;
  definition.filter = filter;
  learn_filter(definition);
  refilter(id);
}

void World::Engine::set_pair_filter(PairFilter filter) {
  pair_filter_ = std::move(filter);
  filtering_ = true;
  for (std::uint32_t number = 0; number < bodies_.size(); ++number) refilter(id_of(number));
}

void World::Engine::set_solid(BodyId id, bool solid) {
  BodyDefinition& definition = bodies_[id.index].definition;
  definition.solid = solid;
  learn_filter(definition);
  refilter(id);
}

void World::Engine::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  sensors_.set(sensor_class, sensor);
  for (std::uint32_t number = 0; number < bodies_.size(); ++number)
    if (bodies_[number].definition.sensor_class == sensor_class) refilter(id_of(number));
}

void World::Engine::set_sensor_class(BodyId id, SensorClass sensor_class) {
  bodies_[id.index].definition.sensor_class = sensor_class;
  refilter(id);
}

void World::Engine::learn_filter(const BodyDefinition& definition) {
  if (definition.filter != Filter{} || !definition.solid) filtering_ = true;
}

/// Nothing is known any more of who may touch or sense the body.
void World::Engine::refilter(BodyId id) {
  const std::uint32_t number = id.index;
  // Also of one that is disabled: it may be enabled again before they are delivered.
  book_.drop_pending(number, [this](const Event& event) { return may_hold(event); });
  if (!bodies_[number].present()) return;
  book_.end_contacts(
      number, time_, [this](std::uint32_t other) { return sphere(other); }, walls_,
      [this](const Event& end) { return !may_hold(end); });
  if (bodies_[number].is_fixed()) register_shape(number);
  void_facts(number);
}

/// Whether the contact or crossing that an event is about is possible at all.
bool World::Engine::may_hold(const Event& event) const {
  if (event.second == no_body) return true;
  const std::uint32_t a = event.first.index;
  const std::uint32_t b = event.second.index;
  if (!is_of_sensor(event.kind)) return may_touch(a, b);
  return may_meet(a, b) && sensors_.senses(bodies_[a].definition, bodies_[b].definition, event.distance);
}

}  // namespace kinesphere
