#include "engine/changes.hpp"

#include "engine/fixed.hpp"

namespace kinesphere {

void World::Changes::reserve(std::size_t bodies) {
  tables_.bodies.reserve(bodies);
  tables_.book.reserve(bodies);
  tables_.windows.reserve(bodies);
  everybody_.unsettled().reserve(bodies);
}

BodyId World::Changes::add(const BodyDefinition& definition) {
  const std::uint32_t number = tables_.bodies.add(definition);
  appear(number, bound_now(definition, time()));
  tables_.book.add(number, bodies()[number].largest_acceleration());
  return bodies().id_of(number);
}

BodyId World::Changes::add_fixed(const FixedDefinition& definition) {
  const BodyDefinition at_rest = body_of(definition);
  const std::uint32_t number = tables_.bodies.add(at_rest);
  tables_.bodies.fix(number, definition.shape);
  tables_.book.add(number, 0.0);
  tables_.book.set_fixed(number);
  appear(number, bound_now(at_rest, time()));
  return bodies().id_of(number);
}

/// The body is where `bound` says. The next advance looks what it meets there.
void World::Changes::appear(std::uint32_t number, const Bound& bound) {
  Body& body = tables_.bodies[number];
  body.bound = bound;
  body.arrived = true;
  Windows& windows = tables_.windows;
  if (windows.contains(number)) windows.leave(number);
  everybody_.void_facts(number);
  if (bodies().definition().allow_overlap) return;
  // Others that are added before then have to find it.
  const Window window = body.is_fixed() ? Window::endless() : Window::at(time(), Window::shortest);
  if (bodies().space().repeats()) tables_.bodies.bring_home(number, time(), 0.0);
  windows.enter(number, roomy_bound(bodies(), number, time()), time(), window);
  windows.tidy();
}

/// The body's contacts end, and nobody finds it any more.
void World::Changes::withdraw(std::uint32_t number) {
  end_contacts(number, [](const Event&) { return true; });
  if (tables_.windows.contains(number)) tables_.windows.leave(number);
  Body& body = tables_.bodies[number];
  ++body.stamp;
  body.dirty = body.arrived = false;
}

void World::Changes::end_contacts(std::uint32_t number, const std::function<bool(const Event&)>& ends) {
  everybody_.instant().end_contacts(
      tables_.book, number, time(),
      [this](std::uint32_t other) { return sphere_at(bodies(), time(), other); }, bodies().walls(), ends);
}

void World::Changes::remove(BodyId id) {
  const std::uint32_t number = id.index;
  if (bodies()[number].is_resting()) resting().resume(number);
  resting().wake(number);
  withdraw(number);
  tables_.bodies.remove(number);
}

/// Another bound takes the place of the body's. Contacts that it certainly ends are over with the states
/// before.
void World::Changes::replace(std::uint32_t number, const Bound& bound) {
  const double apart = tables_.book.rule().separation_distance();
  const auto ends = [&](const Event& end) {
    if (everybody_.instant().pending().contains(end)) return true;
    const std::uint32_t partner = end.first.index == number ? end.second.index : end.first.index;
    const GapLimits gap =
        end.wall == Wall::none
            ? gap_at(bodies(), time(), extent_of(bodies(), number, bound), extent_of(bodies(), partner))
            : gap_limits(bound, half_space(*bodies().walls(), end.wall), time());
    return gap.lower >= end.distance + apart;
  };
  end_contacts(number, ends);
  appear(number, bound);
}

void World::Changes::teleport(BodyId id, const State& state) {
  resting().wake(id.index);
  if (bodies().definition().contacts == ContactMode::impacts) tables_.book.release_all(id.index);
  tables_.bodies.count_images_anew(id.index);
  replace(id.index, bound_of(bodies().definition_of(id.index), state, time()));
  tables_.bodies.forget_change(id.index);
}

void World::Changes::set_radius(BodyId id, double radius) {
  if (bodies()[id.index].enabled) resting().wake(id.index);
  BodyDefinition changed = bodies().definition_of(id.index);
  changed.radius = radius;
  if (bodies()[id.index].enabled) replace(id.index, bound_with(bodies(), id.index, changed, time()));
  tables_.bodies[id.index].radius = radius;
}

void World::Changes::set_motion_limits(BodyId id, const MotionLimits& promise) {
  Body& body = tables_.bodies[id.index];
  if (body.is_resting()) resting().wake(id.index);
  const BodyDefinition changed = with_motion_limits(bodies().definition_of(id.index), promise);
  if (body.enabled) replace(id.index, bound_with(bodies(), id.index, changed, time()));
  body.position_error = promise.position_error;
  if (!body.enabled || !body.fresh(time())) tables_.bodies.change_of(id.index).promise = promise;
  tables_.book.set_largest_acceleration(id.index,
                                        promise.acceleration_limit + norm(promise.planned_acceleration));
}

void World::Changes::disable(BodyId id) {
  Body& body = tables_.bodies[id.index];
  // It will come back awake.
  if (body.is_resting()) resting().resume(id.index);
  resting().wake(id.index);
  withdraw(id.index);
  body.enabled = false;
}

void World::Changes::enable(BodyId id, const State& state) {
  Body& body = tables_.bodies[id.index];
  body.enabled = true;
  if (body.is_fixed()) return appear(id.index, body.bound);
  tables_.bodies.count_images_anew(id.index);
  const BodyDefinition definition = bodies().definition_of(id.index);
  tables_.bodies.forget_change(id.index);
  appear(id.index, bound_of(definition, state, time()));
}

void World::Changes::set_filter(BodyId id, const Filter& filter) {
  tables_.bodies.filters.keep(id.index, filter);
  refilter(id);
}

void World::Changes::set_pair_filter(PairFilter filter) {
  tables_.bodies.filters.keep_pair_filter(std::move(filter));
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number) refilter(bodies().id_of(number));
}

void World::Changes::set_solid(BodyId id, bool solid) {
  tables_.bodies.set_solid(id.index, solid);
  refilter(id);
}

void World::Changes::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  tables_.bodies.sensors.set(sensor_class, sensor);
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
    if (bodies()[number].sensor_class == sensor_class) refilter(bodies().id_of(number));
}

void World::Changes::set_sensor_class(BodyId id, SensorClass sensor_class) {
  tables_.bodies[id.index].sensor_class = sensor_class;
  refilter(id);
}

/// Nothing is known any more of who may touch or sense the body.
void World::Changes::refilter(BodyId id) {
  const std::uint32_t number = id.index;
  // Also of one that is disabled: it may be enabled again before they are delivered.
  everybody_.instant().drop_pending(number, [this](const Event& event) { return may_hold(event); });
  if (!bodies()[number].present()) return;
  end_contacts(number, [this](const Event& end) { return !may_hold(end); });
  tables_.bodies[number].arrived = true;
  everybody_.void_facts(number);
}

/// Whether the contact or crossing that an event is about is possible at all.
bool World::Changes::may_hold(const Event& event) const {
  if (event.second == no_body) return true;
  const std::uint32_t a = event.first.index;
  const std::uint32_t b = event.second.index;
  if (!is_of_sensor(event.kind)) return bodies().may_touch(a, b);
  return bodies().may_meet(a, b) &&
         bodies().sensors.senses(sensing_of(bodies(), a), sensing_of(bodies(), b), event.distance);
}

}  // namespace kinesphere
