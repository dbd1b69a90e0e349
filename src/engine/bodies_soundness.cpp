// Whether bodies that were read from a snapshot can have come about.
#include <algorithm>
#include <cmath>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "engine/bodies.hpp"
#include "engine/fixed.hpp"
#include "engine/validation.hpp"

namespace kinesphere {
namespace {

bool is_sound(const Bound& bound, double now, const WorldDefinition& world) {
  BodyDefinition as_body;
  as_body.radius = 0.5 * bound.radius;  // the sum of a radius and an error
  as_body.acceleration_limit = bound.growth_acceleration;
  as_body.planned_acceleration = bound.planned_acceleration;
  as_body.velocity_error = bound.growth_speed;
  as_body.position = bound.position;
  as_body.velocity = bound.velocity;
  return std::isfinite(bound.time) && bound.time <= now && check_body(as_body, world, "restore");
}

/// To the bit.
template <class T>
bool same(const T& a, const T& b) {
  ByteWriter bytes_of_a, bytes_of_b;
  bytes_of_a(a);
  bytes_of_b(b);
  return bytes_of_a.bytes() == bytes_of_b.bytes();
}

}  // namespace

const char* Bodies::contradiction(double now, const std::vector<std::uint32_t>& dirty) const {
  if (!shapes_are_sound()) return "shapes";
  if (!changes_are_sound() || !rests_are_sound() || !bodies_are_sound(now, dirty)) return "bodies";
  for (int number = 0; number <= std::numeric_limits<SensorClass>::max(); ++number)
    if (!check_sensor(sensors_.of(static_cast<SensorClass>(number)), definition_)) return "sensors";
  return nullptr;
}

/// Each shape belongs to one body or is free.
bool Bodies::shapes_are_sound() const {
  std::vector<bool> is_taken(shapes_.size(), false);
  const auto take = [&is_taken](std::uint32_t number) {
    if (number >= is_taken.size() || is_taken[number]) return false;
    is_taken[number] = true;
    return true;
  };
  for (const std::uint32_t number : free_shapes_)
    if (!take(number)) return false;
  for (const Body& body : table_)
    if (body.is_fixed() && !(body.alive && filtering_ && take(body.shape_number))) return false;
  return std::find(is_taken.begin(), is_taken.end(), false) == is_taken.end();
}

/// It must equal what its shape makes of it.
bool Bodies::is_sound_fixed(std::uint32_t number, double now) const {
  const Body& body = table_[number];
  if (!check_shape(shape(number), definition_, "restore")) return false;
  const BodyDefinition made = body_of(fixed_definition(id_of(number)));
  return same(definition_of(number), made) &&
         same(body.bound, bound_of(made, {made.position, {}}, body.bound.time)) && body.bound.time <= now &&
         std::isfinite(body.bound.time) && !body.settled && body.change_number == Body::none &&
         !(body.dirty && !body.enabled);
}

/// Each change is that of one body, which lives.
bool Bodies::changes_are_sound() const {
  const auto has = [](const Body& body) { return body.change_number != Body::none; };
  for (std::uint32_t change = 0; change < changes_.size(); ++change) {
    const std::uint32_t number = changes_[change].body;
    if (number >= table_.size() || table_[number].change_number != change || !table_[number].alive)
      return false;
  }
  return std::count_if(table_.begin(), table_.end(), has) == std::ssize(changes_);
}

/// Each rest is that of one body, which can move and takes part, and whose bound stands still unless there is
/// no report yet.
bool Bodies::rests_are_sound() const {
  for (std::uint32_t rest = 0; rest < rests_.size(); ++rest) {
    const std::uint32_t number = rests_[rest].body;
    if (number >= table_.size()) return false;
    const Body& body = table_[number];
    if (body.rest_number != rest || !body.present() || body.is_fixed()) return false;
    Bound still = body.bound;
    still.velocity = still.planned_acceleration = {};
    still.growth_speed = still.growth_acceleration = 0.0;
    if (body.is_at_rest() && !same(still, body.bound)) return false;
    if (rests_[rest].limits.position_error != body.position_error) return false;
  }
  return std::count_if(table_.begin(), table_.end(), [](const Body& body) { return body.is_resting(); }) ==
         std::ssize(rests_);
}

bool Bodies::bodies_are_sound(double now, const std::vector<std::uint32_t>& dirty) const {
  const auto count = table_.size();
  const std::size_t where_space_repeats = space_.repeats() ? count : 0;
  if (filters_.size() > count) return false;
  if (homes_.size() != where_space_repeats) return false;
  std::vector<bool> is_free(count, false);
  std::vector<bool> is_listed(count, false);
  for (const std::uint32_t number : free_) {
    if (number >= count || is_free[number]) return false;
    is_free[number] = true;
  }
  for (const std::uint32_t number : dirty) {
    if (number >= count) return false;
    is_listed[number] = true;
  }
  for (std::size_t number = 0; number < count; ++number) {
    const Body& body = table_[number];
    if (body.alive == is_free[number] || (body.dirty && !is_listed[number]) ||
        !is_sound(static_cast<std::uint32_t>(number), now))
      return false;
  }
  return size_ + free_.size() == count;
}

bool Bodies::is_sound(std::uint32_t number, double now) const {
  const Body& body = table_[number];
  if (body.is_fixed()) return is_sound_fixed(number, now);
  if (body.settled) return false;
  // An index that is free is as its next body will find it.
  if (!body.alive) return !body.dirty;
  WorldDefinition unbounded = definition_;
  unbounded.box.reset();
  const BodyDefinition definition = definition_of(number);
  if (!check_body(definition, unbounded, "restore") ||
      !check_radius(definition, no_body, definition_, "restore") ||
      !kinesphere::is_sound(body.bound, now, unbounded) || !image_is_sound(number))
    return false;
  if (!body.enabled) return !body.dirty;
  // Before time moves on there is a report.
  if (body.change_number != Body::none && !body.dirty) return false;
  return true;
}

/// Whole numbers, and none on axes that do not repeat.
bool Bodies::image_is_sound(std::uint32_t number) const {
  if (!space_.repeats()) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const double images = homes_[number].image[axis];
    if (!(std::abs(images) <= 0x1p62) || std::floor(images) != images) return false;
    if (!space_.repeats(axis) && images != 0.0) return false;
  }
  return true;
}

bool Bodies::was_given_out(BodyId id) const {
  if (id.index >= table_.size()) return false;
  const Body& body = table_[id.index];
  return id.generation < body.generation || (id.generation == body.generation && body.alive);
}

}  // namespace kinesphere
