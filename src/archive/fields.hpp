// Serialization of the public structs. A field that is added to one of them does not compile until it is
// added here too.
#pragma once

#include <concepts>
#include <type_traits>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Satisfied by T and const T.
template <class Self, class T>
concept Some = std::same_as<std::remove_const_t<Self>, T>;

void serialize(Some<Vec3> auto& self, auto& archive) {
  auto& [x, y, z] = self;
  archive(x, y, z);
}

void serialize(Some<Box> auto& self, auto& archive) {
  auto& [lower, upper] = self;
  archive(lower, upper);
}

void serialize(Some<BodyId> auto& self, auto& archive) {
  // The tag of the world is left out, because it would make equal histories differ.
  auto& [index, generation, world] = self;
  archive(index, generation);
}

void serialize(Some<State> auto& self, auto& archive) {
  auto& [position, velocity] = self;
  archive(position, velocity);
}

void serialize(Some<MotionOrigin> auto& self, auto& archive) {
  auto& [time, state] = self;
  archive(time, state);
}

void serialize(Some<Segment> auto& self, auto& archive) {
  auto& [begin, end, position, velocity, acceleration, jerk] = self;
  archive(begin, end, position, velocity, acceleration, jerk);
}

void serialize(Some<Filter> auto& self, auto& archive) {
  auto& [category, mask, group] = self;
  archive(category, mask, group);
}

void serialize(Some<Sensor> auto& self, auto& archive) {
  auto& [distances, mask] = self;
  archive(distances, mask);
}

void serialize(Some<BodyDefinition> auto& self, auto& archive) {
  auto& [radius, acceleration_limit, planned_acceleration, position_error, velocity_error, position, velocity,
         filter, solid, contacts, sensor_class, user_data, mass, radius_rate] = self;
  archive(radius, acceleration_limit, planned_acceleration, position_error, velocity_error, position,
          velocity, filter, solid, contacts, sensor_class, user_data, mass, radius_rate);
}

void serialize(Some<MotionLimits> auto& self, auto& archive) {
  auto& [acceleration_limit, planned_acceleration, position_error, velocity_error] = self;
  archive(acceleration_limit, planned_acceleration, position_error, velocity_error);
}

void serialize(Some<Bound> auto& self, auto& archive) {
  auto& [time, position, velocity, planned_acceleration, radius, growth_speed, acceleration_limit] = self;
  archive(time, position, velocity, planned_acceleration, radius, growth_speed, acceleration_limit);
}

void serialize(Some<HalfSpace> auto& self, auto& archive) {
  auto& [normal, offset] = self;
  archive(normal, offset);
}

void serialize(Some<Ball> auto& self, auto& archive) {
  auto& [centre, radius] = self;
  archive(centre, radius);
}

void serialize(Some<Triangle> auto& self, auto& archive) {
  auto& [a, b, c] = self;
  archive(a, b, c);
}

void serialize(Some<StaticDefinition> auto& self, auto& archive) {
  auto& [shape, filter, solid, sensor_class, user_data] = self;
  archive(shape, filter, solid, sensor_class, user_data);
}

void serialize(Some<MovingShape> auto& self, auto& archive) {
  auto& [body, shape] = self;
  archive(body, shape);
}

void serialize(Some<Quaternion> auto& self, auto& archive) {
  auto& [w, x, y, z] = self;
  archive(w, x, y, z);
}

void serialize(Some<Rotation> auto& self, auto& archive) {
  auto& [orientation, angular_velocity] = self;
  archive(orientation, angular_velocity);
}

void serialize(Some<RigidPart> auto& self, auto& archive) {
  auto& [a, b, radius, more] = self;
  archive(a, b, radius, more);
}

void serialize(Some<RigidBody> auto& self, auto& archive) {
  auto& [body, parts, rotation, angular_acceleration_limit, largest_angular_speed, inertia] = self;
  archive(body, parts, rotation, angular_acceleration_limit, largest_angular_speed, inertia);
}

void serialize(Some<BodyTraits> auto& self, auto& archive) {
  auto& [is_static, is_zone, is_sleeping] = self;
  archive(is_static, is_zone, is_sleeping);
}

void serialize(Some<Event> auto& self, auto& archive) {
  auto& [kind, time, first, second, wall, repeated, jammed, already_touching, senses, first_traits,
         second_traits, first_state, second_state, point, normal, gap, approach_speed, position_excess,
         velocity_excess, distance, first_user_data, second_user_data, first_mass, second_mass, first_part,
         second_part, first_angular_velocity, second_angular_velocity, first_spin_gain, second_spin_gain] =
      self;
  archive(kind, time, first, second, wall, repeated, jammed, already_touching, senses, first_traits,
          second_traits, first_state, second_state, point, normal, gap, approach_speed, position_excess,
          velocity_excess, distance, first_user_data, second_user_data, first_mass, second_mass, first_part,
          second_part, first_angular_velocity, second_angular_velocity, first_spin_gain, second_spin_gain);
}

void serialize(Some<Axes> auto& self, auto& archive) {
  auto& [x, y, z] = self;
  archive(x, y, z);
}

void serialize(Some<WorldDefinition> auto& self, auto& archive) {
  auto& [box, periodic, wall_filter, dimensions, contact_tolerance, separation_distance, contacts,
         allow_overlap, zeno_interval, start_time, spread_window_starts] = self;
  archive(box, periodic, wall_filter, dimensions, contact_tolerance, separation_distance, contacts,
          allow_overlap, zeno_interval, start_time, spread_window_starts);
}

void serialize(Some<Counters> auto& self, auto& archive) {
  auto& [events, probes, window_ends, starts, restarts, pair_checks, wall_checks, searches, candidates,
         hot_pairs, certificates, zeno_steps, repeated_contacts] = self;
  archive(events, probes, window_ends, starts, restarts, pair_checks, wall_checks, searches, candidates,
          hot_pairs, certificates, zeno_steps, repeated_contacts);
}

}  // namespace kinesphere
