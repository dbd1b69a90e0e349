// Validity checks for bodies that were read from a snapshot: whether some sequence of calls can have produced
// them.
#include <cmath>
#include <optional>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "bodies/bodies.hpp"
#include "bodies/shaped_body.hpp"
#include "bodies/validation.hpp"
#include "kinesphere/limits.hpp"

namespace kinesphere {
namespace {

/// Returns the position in the form in which a report can give it, or nullopt if it is too large. In periodic
/// space a bound is in the image that the centre of its safe region selects; at times too coarse for small
/// regions that image is any number of periods away.
std::optional<Vec3> reported_place(const Vec3& position, const Space& space, double time) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(position[axis]) <= limits::largest_size)) return std::nullopt;
  return space.wrapped(position, time).position;
}

bool is_valid(const Bound& bound, const Vec3& place, double now, const WorldDefinition& world) {
  BodyDefinition as_body;
  as_body.radius = 0.5 * bound.radius;  // bound.radius is the sum of a radius and an error
  as_body.acceleration_limit = bound.acceleration_limit;
  as_body.planned_acceleration = bound.planned_acceleration;
  as_body.velocity_error = 0.5 * bound.growth_speed;  // likewise
  as_body.position = place;
  as_body.velocity = bound.velocity;
  return bound.time >= -limits::largest_time && bound.time <= now && check_body(as_body, world, "restore");
}

/// Compares bit by bit.
template <class T>
bool same(const T& a, const T& b) {
  ByteWriter bytes_of_a, bytes_of_b;
  bytes_of_a(a);
  bytes_of_b(b);
  return bytes_of_a.take() == bytes_of_b.take();
}

}  // namespace

bool BodyTable::is_valid() const {
  std::vector<bool> is_free(bodies_.size(), false);
  for (const std::uint32_t number : free_) {
    if (number >= numbers() || is_free[number]) return false;
    is_free[number] = true;
  }
  for (std::uint32_t number = 0; number < numbers(); ++number)
    if (bodies_[number].alive == is_free[number]) return false;
  return live_count_ + free_.size() == bodies_.size();
}

const char* Bodies::first_invalid_part(double now, const std::vector<std::uint32_t>& dirty) const {
  if (!shapes.is_valid(table_) || (shapes.any() && !filters.any()) || !rigid.is_valid(table_))
    return "shapes";
  if (!bodies_are_valid(now, dirty)) return "bodies";
  for (int number = 0; number <= std::numeric_limits<SensorClass>::max(); ++number)
    if (!check_sensor(sensors.of(static_cast<SensorClass>(number)), definition_)) return "sensors";
  if (!(common_reach >= 0.0)) return "sensors";
  for (std::uint32_t number = 0; number < numbers(); ++number)
    if (table_[number].alive && sensors.reach(table_[number].sensor_class) < common_reach &&
        common_reach < infinity)
      return "sensors";
  return nullptr;
}

bool Bodies::bodies_are_valid(double now, const std::vector<std::uint32_t>& dirty) const {
  const std::size_t where_space_repeats = space_.repeats() ? numbers() : 0;
  if (!table_.is_valid() || !changes.is_valid(table_) || !sleep_records.is_valid(table_) ||
      !filters.is_valid(numbers()) || !masses.is_valid(numbers()) || !radii.is_valid(numbers()) ||
      images.size() != where_space_repeats || rows.size() != (space_.slides() ? numbers() : 0))
    return false;
  std::vector<bool> is_listed(numbers(), false);
  for (const std::uint32_t number : dirty) {
    if (number >= numbers()) return false;
    is_listed[number] = true;
  }
  for (std::uint32_t number = 0; number < numbers(); ++number)
    if ((table_[number].dirty && !is_listed[number]) || !is_valid(number, now)) return false;
  return true;
}

bool Bodies::is_valid(std::uint32_t number, double now) const {
  const Body& body = table_[number];
  if (body.is_static()) return is_valid_static(number, now);
  if (!sleep_is_valid(body) || (body.turned && (!body.dirty || body.relocated))) return false;
  // A free number has the state that its next body starts with.
  if (!body.alive) return !body.dirty && body.change_number == Body::none;
  WorldDefinition unbounded = definition_;
  unbounded.box.reset();
  BodyDefinition definition = definition_of(number);
  const auto place = reported_place(body.bound.position, space_, body.bound.time);
  if (!place) return false;
  definition.position = *place;
  if (!check_body(definition, unbounded, "restore") ||
      !check_radius(definition, no_body, definition_, "restore") ||
      !kinesphere::is_valid(body.bound, *place, now, unbounded) ||
      (space_.repeats() && !images[number].is_valid(space_)) ||
      (space_.slides() &&
       !(std::abs(rows[number]) <= PeriodicImage::most_images && std::floor(rows[number]) == rows[number])))
    return false;
  if (!limits_are_valid(body, definition) || !carried_shape_is_valid(body, definition) ||
      !rigid_body_is_valid(number, now) || !radius_is_valid(number, now))
    return false;
  if (!body.enabled) return !body.dirty;
  // The bound's radius includes an error. Only the bound of a disabled body can be out of date.
  if (body.bound.radius < body.radius) return false;
  // A pending change requires a report before time advances.
  return body.change_number == Body::none || body.dirty;
}

/// Checks the motion limits that take effect later; definition_of() returns only one set of them.
bool Bodies::limits_are_valid(const Body& body, BodyDefinition definition) const {
  const auto are_limits = [&](const MotionLimits& limits) {
    return static_cast<bool>(
        check_limits(with_motion_limits(definition, limits), no_body, definition_, "restore"));
  };
  const Change* change = changes.find(body);
  const SleepRecord* record = sleep_records.find(body);
  if (change && !(are_limits(change->limits) &&
                  (!change->velocity || check_velocity(*change->velocity, no_body, definition_, "restore"))))
    return false;
  if (record && !are_limits(record->limits)) return false;
  definition.position_error = body.position_error;
  return are_limits(motion_limits_of(definition));
}

/// A static body must equal the body that its shape defines.
bool Bodies::is_valid_static(std::uint32_t number, double now) const {
  const Body& body = table_[number];
  if (!check_shape(shapes.of(body), definition_, "restore")) return false;
  if (space_.repeats() && !(images[number].is_valid(space_) && images[number].image == Vec3{} &&
                            same(normalized(shapes.of(body), definition_), shapes.of(body))))
    return false;
  const BodyDefinition made = body_of(static_definition(*this, id_of(number)));
  return same(definition_of(number), made) &&
         same(body.bound, bound_of(made, {made.position, {}}, body.bound.time)) && body.bound.time <= now &&
         body.bound.time >= -limits::largest_time && body.change_number == Body::none &&
         !body.is_sleeping() && !(body.dirty && !body.enabled);
}

/// A body that carries a shape has the radius of the ball around it.
bool Bodies::carried_shape_is_valid(const Body& body, const BodyDefinition& definition) const {
  if (!body.carries_shape) return true;
  if (!body.has_shape()) return false;
  const Shape& shape = shapes.of(body);
  return check_carried_shape(shape, definition_, "restore") &&
         same(normalized_carried(shape, definition_), shape) &&
         body.radius == body_of({definition, shape}, definition_).radius;
}

/// A rigid body has the radius of the ball around its parts, and a rotation that a call or a report gave it.
bool Bodies::rigid_body_is_valid(std::uint32_t number, double now) const {
  const Body& body = table_[number];
  if (!body.is_rigid) return true;
  if (body.carries_shape || body.is_sleeping()) return false;
  const RigidRecord& record = rigid[body];
  if (body.is_round != record.is_round() || !(body.is_round || rigid.with_parts())) return false;
  RigidBody made = rigid_body(*this, number);
  // A report may have broken the promise of the largest angular speed.
  made.rotation = {};
  if (!check_rigid_body(made, definition_, "restore") ||
      !check_rotation(record.rotation, no_body, definition_, "restore") ||
      !check_rotation(record.origin, no_body, definition_, "restore"))
    return false;
  return record.origin_time >= -limits::largest_time && record.origin_time <= now &&
         (record.is_changed || record.origin_time <= body.bound.time) && body.radius == body_of(made).radius;
}

/// Only a ball that does not sleep changes its size with time.
bool Bodies::radius_is_valid(std::uint32_t number, double now) const {
  const ChangingRadius* const changing = radii.find(number);
  if (!changing) return true;
  const Body& body = table_[number];
  BodyDefinition grown = definition_of(number);
  grown.radius = changing->radius;
  grown.velocity_error = changing->velocity_error;
  // It may have grown too large for the box since the last report, as the next report will tell.
  WorldDefinition unbounded = definition_;
  unbounded.box.reset();
  return check_radius(grown, no_body, unbounded, "restore") &&
         check_limits(grown, no_body, unbounded, "restore") &&
         check_radius_rate(changing->rate, no_body, "restore") && !body.is_shaped() && !body.is_rigid &&
         !(body.is_sleeping() && changing->rate != 0.0) && changing->time >= -limits::largest_time &&
         changing->time <= now;
}

/// A sleeping body is present and not static; its bound stands still unless a change still waits for a
/// report.
bool Bodies::sleep_is_valid(const Body& body) const {
  const SleepRecord* record = sleep_records.find(body);
  if (!record) return true;
  Bound still = body.bound;
  still.velocity = still.planned_acceleration = {};
  still.growth_speed = still.acceleration_limit = 0.0;
  return body.present() && (!body.is_at_rest() || same(still, body.bound)) &&
         record->limits.position_error == body.position_error;
}

}  // namespace kinesphere
