// Changes that the caller makes to bodies: their place, their shape, their promise, their filter.
#include "world/engine.hpp"

namespace kinesphere {

Bound World::Engine::bound_with(BodyId id, const BodyDefinition& changed) const {
  const Body& body = bodies_[id.index];
  if (body.fresh(time_)) return bound_of(changed, {body.bound.position, body.bound.velocity}, time_);
  // The old promise held until now, and the next report comes before time moves on.
  Bound bound = body.bound;
  bound.radius = changed.radius + (bound.radius - body.radius);
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
  wake_island(id.index);
  if (definition_.contacts == ContactMode::impacts) book_.release_all(id.index);
  if (space_.repeats()) images_[id.index] = {};
  replace(id.index, bound_of(definition_of(id.index), state, time_));
  forget_change(id.index);
}

void World::Engine::set_radius(BodyId id, double radius) {
  if (bodies_[id.index].enabled) wake_island(id.index);
  BodyDefinition changed = definition_of(id.index);
  changed.radius = radius;
  if (bodies_[id.index].enabled) replace(id.index, bound_with(id, changed));
  bodies_[id.index].radius = radius;
}

void World::Engine::set_motion_limits(BodyId id, const MotionLimits& promise) {
  Body& body = bodies_[id.index];
  if (body.is_resting()) wake_island(id.index);
  const BodyDefinition changed = with_motion_limits(definition_of(id.index), promise);
  if (body.enabled) replace(id.index, bound_with(id, changed));
  body.position_error = promise.position_error;
  if (!body.enabled || !body.fresh(time_)) change_of(id.index).promise = promise;
  book_.set_largest_acceleration(id.index, promise.acceleration_limit + norm(promise.planned_acceleration));
}

/// The change of the body, to be made or added to.
Change& World::Engine::change_of(std::uint32_t number) {
  Body& body = bodies_[number];
  if (body.change_number == Body::none) {
    changes_.push_back({number, std::nullopt, motion_limits_of(definition_of(number))});
    body.change_number = static_cast<std::uint32_t>(changes_.size() - 1);
  }
  return changes_[body.change_number];
}

/// It is in force, or the body has gone. The last one takes its place.
void World::Engine::forget_change(std::uint32_t number) {
  const std::uint32_t change = bodies_[number].change_number;
  if (change == Body::none) return;
  bodies_[changes_.back().body].change_number = change;
  bodies_[number].change_number = Body::none;
  changes_[change] = changes_.back();
  changes_.pop_back();
}

void World::Engine::disable(BodyId id) {
  Body& body = bodies_[id.index];
  // It will come back awake.
  if (body.is_resting()) resume(id.index);
  wake_island(id.index);
  withdraw(id.index);
  body.enabled = false;
}

void World::Engine::enable(BodyId id, const State& state) {
  Body& body = bodies_[id.index];
  body.enabled = true;
  if (body.is_fixed()) return appear(id.index, body.bound);
  if (space_.repeats()) images_[id.index] = {};
  const BodyDefinition definition = definition_of(id.index);
  forget_change(id.index);
  appear(id.index, bound_of(definition, state, time_));
}

void World::Engine::set_filter(BodyId id, const Filter& filter) {
  keep_filter(id.index, filter);
  refilter(id);
}

void World::Engine::set_pair_filter(PairFilter filter) {
  pair_filter_ = std::move(filter);
  filtering_ = true;
  for (std::uint32_t number = 0; number < bodies_.size(); ++number) refilter(id_of(number));
}

void World::Engine::set_solid(BodyId id, bool solid) {
  bodies_[id.index].solid = solid;
  if (!solid) filtering_ = true;
  refilter(id);
}

void World::Engine::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  sensors_.set(sensor_class, sensor);
  for (std::uint32_t number = 0; number < bodies_.size(); ++number)
    if (bodies_[number].sensor_class == sensor_class) refilter(id_of(number));
}

void World::Engine::set_sensor_class(BodyId id, SensorClass sensor_class) {
  bodies_[id.index].sensor_class = sensor_class;
  refilter(id);
}

void World::Engine::keep_filter(std::uint32_t number, const Filter& filter) {
  if (filter != Filter{}) {
    filtering_ = true;
    if (number >= filters_.size()) filters_.resize(number + std::size_t{1});
  }
  if (number < filters_.size()) filters_[number] = filter;
}

/// What the caller's predicate says.
bool World::Engine::lets_meet(BodyId a, BodyId b) const {
  const FilterQuestion question(this);
  return pair_filter_(a, b);
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
  void_facts(number);
}

/// Whether the contact or crossing that an event is about is possible at all.
bool World::Engine::may_hold(const Event& event) const {
  if (event.second == no_body) return true;
  const std::uint32_t a = event.first.index;
  const std::uint32_t b = event.second.index;
  if (!is_of_sensor(event.kind)) return may_touch(a, b);
  return may_meet(a, b) && sensors_.senses(sensing_of(a), sensing_of(b), event.distance);
}

}  // namespace kinesphere
