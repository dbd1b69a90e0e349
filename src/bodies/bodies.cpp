#include "bodies/bodies.hpp"

#include "bodies/body_bounds.hpp"

namespace kinesphere {

Bodies::Bodies(const WorldDefinition& definition)
    : definition_(definition), space_(definition), walls_(walls_of(definition)) {}

void Bodies::reserve(std::size_t bodies) {
  table_.reserve(bodies);
  if (space_.repeats()) images.reserve(bodies);
  if (space_.slides()) rows.reserve(bodies);
}

std::uint32_t Bodies::add(const BodyDefinition& definition, double now) {
  return describe(table_.take(), definition, now);
}

std::uint32_t Bodies::add_named(const BodyDefinition& definition, double now, std::uint32_t name) {
  return describe(table_.take(name), definition, now);
}

std::uint32_t Bodies::describe(std::uint32_t number, const BodyDefinition& definition, double now) {
  if (space_.repeats()) images.resize(numbers());
  if (space_.slides()) rows.resize(numbers());
  Body& body = table_[number];
  body.radius = definition.radius;
  body.position_error = definition.position_error;
  body.contact_events = definition.contacts.value_or(definition_.contacts);
  body.sensor_class = definition.sensor_class;
  body.user_data = definition.user_data;
  filters.keep(number, definition.filter);
  masses.keep(number, definition.mass);
  if (definition.radius_rate != 0.0)
    radii.keep(number, {definition.radius_rate, definition.radius, now, definition.velocity_error, true});
  set_solid(number, definition.solid);
  return number;
}

void Bodies::give_shape(std::uint32_t number, const Shape& shape, bool carried) {
  shapes.add(table_[number], shape, carried);
  filters.set_any();
}

void Bodies::remove(std::uint32_t number) {
  shapes.remove(table_[number]);
  rigid.remove(table_[number]);
  forget_change(number);
  filters.keep(number, {});
  masses.keep(number, BodyDefinition{}.mass);
  radii.keep(number, {});
  count_images_anew(number);
  table_.give_back(number);
}

BodyDefinition Bodies::definition_of(std::uint32_t number) const {
  const Body& body = table_[number];
  const Change* const change = changes.find(body);
  const bool turns = change && change->velocity;
  BodyDefinition definition{
      .radius = body.radius,
      .position = body.bound.position,
      .velocity = turns ? velocity_in_image(number, *change->velocity) : body.bound.velocity,
      .filter = filters.of(number),
      .solid = body.solid,
      .contacts = body.contact_events,
      .sensor_class = body.sensor_class,
      .user_data = body.user_data,
      .mass = masses.of(number),
      .radius_rate = radius_rate(number)};
  return with_motion_limits(definition, limits_of(number));
}

MotionLimits Bodies::limits_of(std::uint32_t number) const {
  const Body& body = table_[number];
  if (const SleepRecord* record = sleep_records.find(body)) return record->limits;
  if (const Change* change = changes.find(body)) return change->limits;
  return bound_limits_of(number);
}

Bound Bodies::changed_bound(std::uint32_t number, const State& state, double time) const {
  const BodyDefinition body{.radius = table_[number].radius, .radius_rate = radius_rate(number)};
  return bound_of(with_motion_limits(body, limits_of(number)), state, time);
}

void Bodies::forget_change(std::uint32_t number) {
  take_velocity_error(number);
  changes.remove(table_, number);
}

/// A radius that changes has the velocity error beside the bound, which holds both.
void Bodies::take_velocity_error(std::uint32_t number) {
  if (ChangingRadius* const changing = radii.find(number))
    if (const Change* const change = changes.find(table_[number]))
      changing->velocity_error = change->limits.velocity_error;
}

void Bodies::set_radius_law(std::uint32_t number, double radius, double rate, double now) {
  if (rate != 0.0 || radii.find(number))
    radii.keep(number, {rate, radius, now, velocity_error(number), true});
}

void Bodies::set_solid(std::uint32_t number, bool solid) {
  table_[number].solid = solid;
  if (!solid) filters.set_any();
}

/// Evaluates may_meet() in a world with filters.
bool Bodies::filters_allow(std::uint32_t a, std::uint32_t b) const {
  return !(table_[a].is_static() && table_[b].is_static()) &&
         filters.may_meet(id_of(a), filters.of(a), id_of(b), filters.of(b));
}

void Bodies::wrap_to_primary(std::uint32_t number, double now) {
  Body& body = table_[number];
  // The centre of a static ball was wrapped when the ball was added.
  if (body.is_static()) {
    images[number] = {.middle = body.bound.position};
    return;
  }
  const Vec3 shift = -images[number].wrap(space_, body.bound.centre_at(now), now);
  body.bound.position += shift;
  if (space_.slides()) slide_to_image(number, shift, now);
}

/// Completes a shift of a body to another image, where images slide: its position has been moved.
void Bodies::slide_to_image(std::uint32_t number, const Vec3& shift, double now) {
  Bound& bound = table_[number].bound;
  const Vec3 velocity = space_.velocity_of(shift);
  bound.position -= velocity * (now - bound.time);
  bound.velocity += velocity;
  rows[number] += space_.rows_of(shift);
}

Vec3 Bodies::sliding_velocity(std::uint32_t number, const Vec3& velocity) const {
  return velocity + Vec3{rows[number] * space_.slide_speed(), 0.0, 0.0};
}

}  // namespace kinesphere
