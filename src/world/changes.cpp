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
  if (!definition_.box) return std::nullopt;
  for (const Wall wall : walls)
    if (gap_limits(bound, half_space(*definition_.box, wall), time_).upper < -definition_.contact_tolerance)
      return wall;
  return std::nullopt;
}

/// Another bound takes the place of the body's. Contacts that it certainly ends are over with the states
/// before.
void World::Engine::replace(std::uint32_t number, const Bound& bound) {
  const double apart = book_.rule().separation_distance();
  const auto ends_pair = [&](std::uint32_t partner) {
    return book_.pending().contains(contact(EventKind::contact_end, number, partner)) ||
           gap_limits(bound, bodies_[partner].bound, time_).lower >= apart;
  };
  const auto ends_wall = [&](Wall wall) {
    return book_.pending().contains(wall_contact(EventKind::wall_end, number, wall)) ||
           gap_limits(bound, half_space(*definition_.box, wall), time_).lower >= apart;
  };
  book_.end_contacts(
      number, time_, [this](std::uint32_t other) { return sphere(other); }, definition_.box, ends_pair,
      ends_wall);
  void_facts(number);
  appear(number, bound);
}

void World::Engine::teleport(BodyId id, const State& state) {
  Body& body = bodies_[id.index];
  if (definition_.contacts == ContactMode::impacts) book_.release_all(id.index);
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
  ++body.epoch;
  body.watches.clear();
  body.kicked_since_report = false;
  body.enabled = false;
}

void World::Engine::enable(BodyId id, const State& state) {
  Body& body = bodies_[id.index];
  body.enabled = true;
  body.definition.position = state.position;
  body.definition.velocity = state.velocity;
  appear(id.index, bound_now(body.definition));
}

void World::Engine::set_filter(BodyId id, const Filter& filter) {
  if (filter != Filter{}) filtering_ = true;
  bodies_[id.index].definition.filter = filter;
  refilter(id);
}

void World::Engine::set_pair_filter(PairFilter filter) {
  pair_filter_ = std::move(filter);
  filtering_ = true;
  for (std::uint32_t number = 0; number < bodies_.size(); ++number) refilter(id_of(number));
}

/// Nothing is known any more of who may touch the body.
void World::Engine::refilter(BodyId id) {
  const std::uint32_t number = id.index;
  if (!bodies_[number].present()) return;
  const auto filtered = [=, this](std::uint32_t partner) { return !may_touch(number, partner); };
  book_.end_contacts(
      number, time_, [this](std::uint32_t other) { return sphere(other); }, definition_.box, filtered,
      [](Wall) { return false; });
  book_.drop_filtered(number, [this](std::uint32_t a, std::uint32_t b) { return may_touch(a, b); });
  void_facts(number);
}

bool World::Engine::may_touch(BodyId a, const Filter& filter_of_a, BodyId b,
                              const Filter& filter_of_b) const {
  return passes(filter_of_a, filter_of_b) && (!pair_filter_ || pair_filter_(a, b));
}

}  // namespace kinesphere
