#include "engine/world_editor.hpp"

#include <algorithm>

#include "bodies/shaped_body.hpp"

namespace kinesphere {

void World::WorldEditor::reserve(std::size_t bodies) {
  state_.bodies.reserve(bodies);
  state_.contacts.reserve(bodies);
  main_.dirty().reserve(bodies);
}

/// Adds a body. `give_form(number)` makes it other than a ball.
BodyId World::WorldEditor::insert(const BodyDefinition& definition, auto give_form) {
  const std::uint32_t number = state_.bodies.add(definition, time());
  give_form(number);
  // Its extent in the core depends on what all sense, with itself.
  note_common_reach(sensor_reach(bodies(), number));
  insert_at(number, bound_now(definition, time()));
  state_.contacts.add(number, bodies().largest_acceleration(number));
  if (bodies()[number].has_shape()) state_.contacts.set_shape(number, bodies()[number].is_static());
  return bodies().id_of(number);
}

/// A body senses up to this distance (length).
void World::WorldEditor::note_common_reach(double reach) {
  const bool is_only_one = bodies().table().live_count() == 1;
  set_common_reach(is_only_one ? reach : std::min(reach, bodies().common_reach));
}

/// All bodies sense at least up to this distance (length), which their extents in the core depend on.
void World::WorldEditor::set_common_reach(double reach) {
  if (reach == bodies().common_reach) return;
  state_.bodies.common_reach = reach;
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
    if (bodies()[number].present()) register_with_new_extent(number);
}

BodyId World::WorldEditor::add(const BodyDefinition& definition) {
  return insert(definition, [](std::uint32_t) {});
}

BodyId World::WorldEditor::add_static(const StaticDefinition& definition) {
  return insert(body_of(definition),
                [&](std::uint32_t number) { state_.bodies.give_shape(number, definition.shape, false); });
}

BodyId World::WorldEditor::add_moving_shape(const MovingShape& definition) {
  return insert(body_of(definition, bodies().definition()),
                [&](std::uint32_t number) { state_.bodies.give_shape(number, definition.shape, true); });
}

BodyId World::WorldEditor::add_rigid_body(const RigidBody& definition) {
  return insert(body_of(definition), [&](std::uint32_t number) {
    state_.bodies.make_rigid(number, record_of(definition, time()));
  });
}

void World::WorldEditor::set_angular_velocity(BodyId id, const Vec3& angular_velocity) {
  main_.set_angular_velocity(id.index, angular_velocity);
}

void World::WorldEditor::set_rotation(BodyId id, const Rotation& rotation) {
  const std::uint32_t number = id.index;
  sleeping().wake(number);
  Body& body = state_.bodies[number];
  RigidRecord changed = bodies().rigid[body];
  changed.change({after(rotation.orientation, Quaternion{}), rotation.angular_velocity}, time(),
                 body.fresh(time()));
  if (body.fresh(time())) {
    end_contacts_outside(number, {body.bound, false, nullptr, body.radius, &changed});
  } else {
    state_.bodies.change_of(number);
  }
  state_.bodies.rigid[body] = std::move(changed);
  state_.contacts.set_largest_acceleration(number, bodies().largest_acceleration(number));
  state_.contacts.turn_reported(number);
  insert_at(number, body.bound);
}

/// Sets the bound of the body and marks it as relocated.
void World::WorldEditor::insert_at(std::uint32_t number, const Bound& bound) {
  Body& body = state_.bodies[number];
  body.bound = bound;
  body.relocated = true;
  if (bound.is_exact() && !body.is_static()) state_.spot_checks.note_arrival(time());
  register_anew(number);
}

/// Others find the body where it is now, also bodies that are added before the next advance.
void World::WorldEditor::register_anew(std::uint32_t number) {
  if (state_.core.contains(number)) state_.core.leave(number);
  main_.invalidate(number);
  if (!bodies().definition().allow_overlap) main_.show_in_core(number);
}

void World::WorldEditor::end_contacts(std::uint32_t number, const std::function<bool(const Event&)>& ends) {
  main_.events().end_contacts(
      state_.contacts, number, time(),
      [this](std::uint32_t other) { return sphere_at(bodies(), time(), other); }, bodies().walls(), ends);
}

void World::WorldEditor::remove(BodyId id) {
  const std::uint32_t number = id.index;
  if (bodies()[number].is_sleeping()) sleeping().resume(number);
  sleeping().wake(number);
  main_.detach(number);
  state_.contacts.pairs().forget(number);
  state_.bodies.remove(number);
}

/// Replaces the bound of the body. Contacts that this certainly ends are ended with the states before the
/// change.
void World::WorldEditor::replace(std::uint32_t number, const Bound& bound) {
  if (const Body& body = bodies()[number]; body.is_rigid) {
    RigidRecord turned = bodies().rigid[body];
    if (bound.time == time()) turned.change(turned.at(time()), time(), true);
    const CollisionShape ball{bound};
    end_contacts_outside(number,
                         body.is_round ? ball : CollisionShape{bound, false, nullptr, body.radius, &turned});
    state_.bodies.rigid[body] = std::move(turned);
  } else {
    end_contacts_outside(number, {bound});
  }
  insert_at(number, bound);
}

/// Ends the contacts and overlaps that the body certainly does not have with another collision shape.
void World::WorldEditor::end_contacts_outside(std::uint32_t number, const CollisionShape& replacement) {
  const double apart = state_.contacts.rule().separation_distance();
  const auto ends = [&](const Event& end) {
    if (main_.events().pending().contains(end)) return true;
    const std::uint32_t partner = end.first.index == number ? end.second.index : end.first.index;
    const GapLimits gap = end.wall == Wall::none
                              ? gap_at(bodies(), time(), replacement, collision_shape_of(bodies(), partner))
                              : gap_to_wall(replacement, half_space(*bodies().walls(), end.wall), time());
    return gap.lower >= end.distance + apart;
  };
  end_contacts(number, ends);
}

void World::WorldEditor::teleport(BodyId id, const State& state) {
  sleeping().wake(id.index);
  state_.contacts.turn_reported(id.index);
  state_.bodies.count_images_anew(id.index);
  BodyDefinition moved = bodies().definition_of(id.index);
  moved.radius = bodies().radius_at(id.index, time());
  replace(id.index, bound_of(moved, state, time()));
  state_.bodies.update_radius(id.index, time());
  state_.bodies.forget_change(id.index);
}

void World::WorldEditor::set_radius(BodyId id, double radius) {
  if (bodies()[id.index].enabled) sleeping().wake(id.index);
  BodyDefinition changed = bodies().definition_of(id.index);
  changed.radius = radius;
  if (bodies()[id.index].enabled) replace(id.index, bound_with(bodies(), id.index, changed, time()));
  state_.bodies[id.index].radius = radius;
  state_.bodies.set_radius_law(id.index, radius, changed.radius_rate, time());
}

void World::WorldEditor::set_radius_rate(BodyId id, double rate) {
  const std::uint32_t number = id.index;
  const Body& body = bodies()[number];
  if (body.is_sleeping()) sleeping().wake(number);
  state_.bodies.set_radius_law(number, bodies().radius_at(number, time()), rate, time());
  if (body.enabled) state_.contacts.turn_reported(number);
  if (body.enabled && body.fresh(time()))
    return replace(number, bound_with(bodies(), number, bodies().definition_of(number), time()));
  state_.bodies.change_of(number);
  if (body.enabled) main_.invalidate(number);
}

void World::WorldEditor::set_shape(BodyId id, const Shape& shape) {
  const std::uint32_t number = id.index;
  const bool enabled = bodies()[number].enabled;
  const bool carried = bodies()[number].carries_shape;
  const BodyDefinition changed = carried
                                     ? body_of({bodies().definition_of(number), shape}, bodies().definition())
                                     : body_of(StaticDefinition{.shape = shape});
  const Bound bound = carried ? bound_with(bodies(), number, changed, time()) : bound_now(changed, time());
  if (enabled) {
    sleeping().wake(number);
    state_.contacts.turn_reported(number);
    end_contacts_outside(
        number, carried ? carried_shape_of(bound, shape, changed.radius) : collision_shape_of(bound, shape));
  }
  state_.bodies[number].radius = changed.radius;
  state_.bodies[number].bound = bound;
  state_.bodies.reshape(number, shape);
  if (enabled) insert_at(number, bound);
}

void World::WorldEditor::set_motion_limits(BodyId id, const MotionLimits& limits) {
  Body& body = state_.bodies[id.index];
  if (body.is_sleeping()) sleeping().wake(id.index);
  const BodyDefinition changed = with_motion_limits(bodies().definition_of(id.index), limits);
  if (body.enabled) replace(id.index, bound_with(bodies(), id.index, changed, time()));
  body.position_error = limits.position_error;
  ChangingRadius* const changing = state_.bodies.radii.find(id.index);
  if (changing && body.enabled && body.fresh(time())) changing->velocity_error = limits.velocity_error;
  if (!body.enabled || !body.fresh(time())) state_.bodies.change_of(id.index).limits = limits;
  state_.contacts.set_largest_acceleration(id.index, bodies().largest_acceleration(id.index));
}

void World::WorldEditor::disable(BodyId id) {
  Body& body = state_.bodies[id.index];
  // An enabled body is awake.
  if (body.is_sleeping()) sleeping().resume(id.index);
  sleeping().wake(id.index);
  main_.detach(id.index);
  body.enabled = false;
}

void World::WorldEditor::enable(BodyId id, const State& state) {
  Body& body = state_.bodies[id.index];
  body.enabled = true;
  if (body.is_static()) return insert_at(id.index, body.bound);
  state_.bodies.count_images_anew(id.index);
  state_.bodies.update_radius(id.index, time());
  const BodyDefinition definition = bodies().definition_of(id.index);
  state_.bodies.forget_change(id.index);
  if (body.is_rigid) {
    RigidRecord& record = state_.bodies.rigid[body];
    record.change(record.at(time()), time(), true);
  }
  insert_at(id.index, bound_of(definition, state, time()));
}

void World::WorldEditor::set_filter(BodyId id, const Filter& filter) {
  state_.bodies.filters.keep(id.index, filter);
  refresh_filter(id);
}

void World::WorldEditor::set_pair_filter(PairFilter filter) {
  state_.bodies.filters.keep_pair_filter(std::move(filter));
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number)
    refresh_filter(bodies().id_of(number));
}

void World::WorldEditor::set_solid(BodyId id, bool solid) {
  state_.bodies.set_solid(id.index, solid);
  refresh_filter(id);
}

void World::WorldEditor::set_sensor(SensorClass sensor_class, const Sensor& sensor) {
  state_.bodies.sensors.set(sensor_class, sensor);
  double common = infinity;
  for (std::uint32_t number = 0; number < bodies().numbers(); ++number) {
    if (bodies()[number].sensor_class == sensor_class) refresh_filter(bodies().id_of(number));
    if (bodies()[number].alive) common = std::min(common, sensor_reach(bodies(), number));
  }
  set_common_reach(common);
}

void World::WorldEditor::set_sensor_class(BodyId id, SensorClass sensor_class) {
  state_.bodies[id.index].sensor_class = sensor_class;
  note_common_reach(sensor_reach(bodies(), id.index));
  refresh_filter(id);
}

/// Discards what is known about the bodies that this body may touch or sense.
void World::WorldEditor::refresh_filter(BodyId id) {
  const std::uint32_t number = id.index;
  // Events of a disabled body are dropped too, since it may be enabled again before they are delivered.
  main_.events().drop_pending(number, [this](const Event& event) { return may_hold(event); });
  if (!bodies()[number].present()) return;
  end_contacts(number, [this](const Event& end) { return !may_hold(end); });
  register_with_new_extent(number);
}

void World::WorldEditor::register_with_new_extent(std::uint32_t number) {
  state_.bodies[number].relocated = true;
  main_.invalidate(number);
}

/// Returns true if the filters and sensors permit the contact or overlap of the event.
bool World::WorldEditor::may_hold(const Event& event) const {
  const std::uint32_t a = event.first.index;
  if (event.second == no_body) return event.wall == Wall::none || bodies().meets_walls(a);
  const std::uint32_t b = event.second.index;
  if (!is_of_sensor(event.kind)) return bodies().may_touch(a, b);
  return bodies().may_meet(a, b) &&
         bodies().sensors.senses(sensing_of(bodies(), a), sensing_of(bodies(), b), event.distance);
}

}  // namespace kinesphere
