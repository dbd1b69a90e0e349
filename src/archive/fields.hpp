// Serialization of the public structs. A field that is added to one of them does not compile until it is
// added here too.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "kinesphere/body.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/counters.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/run.hpp"
#include "kinesphere/shape.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Satisfied by T and const T.
template <class Self, class T>
concept Some = std::same_as<std::remove_const_t<Self>, T>;

template <Some<Vec3> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [x, y, z] = self;
  archive(x, y, z);
}

template <Some<Box> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [lower, upper] = self;
  archive(lower, upper);
}

template <Some<BodyId> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  // The tag of the world is left out, because it would make equal histories differ.
  auto& [index, generation, world] = self;
  archive(index, generation);
}

template <Some<State> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [position, velocity] = self;
  archive(position, velocity);
}

template <Some<MotionOrigin> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [time, state] = self;
  archive(time, state);
}

template <Some<Segment> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [begin, end, position, velocity, acceleration, jerk] = self;
  archive(begin, end, position, velocity, acceleration, jerk);
}

template <Some<Filter> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [category, mask, group] = self;
  archive(category, mask, group);
}

template <Some<Sensor> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [distances, mask] = self;
  archive(distances, mask);
}

template <Some<BodyDefinition> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [radius, acceleration_limit, planned_acceleration, position_error, velocity_error, position, velocity,
         filter, solid, sensor_class, user_data] = self;
  archive(radius, acceleration_limit, planned_acceleration, position_error, velocity_error, position,
          velocity, filter, solid, sensor_class, user_data);
}

template <Some<MotionLimits> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [acceleration_limit, planned_acceleration, position_error, velocity_error] = self;
  archive(acceleration_limit, planned_acceleration, position_error, velocity_error);
}

template <Some<Bound> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [time, position, velocity, planned_acceleration, radius, growth_speed, growth_acceleration] = self;
  archive(time, position, velocity, planned_acceleration, radius, growth_speed, growth_acceleration);
}

template <Some<HalfSpace> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [normal, offset] = self;
  archive(normal, offset);
}

template <Some<Ball> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [centre, radius] = self;
  archive(centre, radius);
}

template <Some<Triangle> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [a, b, c] = self;
  archive(a, b, c);
}

template <Some<StaticDefinition> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [shape, filter, solid, sensor_class, user_data] = self;
  archive(shape, filter, solid, sensor_class, user_data);
}

template <Some<Event> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [kind, time, first, second, wall, repeated, jammed, senses, first_state, second_state, point, normal,
         gap, approach_speed, position_excess, velocity_excess, distance, first_user_data, second_user_data] =
      self;
  archive(kind, time, first, second, wall, repeated, jammed, senses, first_state, second_state, point, normal,
          gap, approach_speed, position_excess, velocity_excess, distance, first_user_data, second_user_data);
}

template <Some<Axes> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [x, y, z] = self;
  archive(x, y, z);
}

template <Some<WorldDefinition> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [box, periodic, dimensions, contact_tolerance, separation_distance, contacts, allow_overlap,
         zeno_interval, start_time] = self;
  archive(box, periodic, dimensions, contact_tolerance, separation_distance, contacts, allow_overlap,
          zeno_interval, start_time);
}

template <Some<Counters> Self, class Archive>
void serialize(Self& self, Archive& archive) {
  auto& [events, probes, window_ends, starts, restarts, pair_checks, wall_checks, searches, candidates,
         hot_pairs, certificates, zeno_steps, repeated_contacts] = self;
  archive(events, probes, window_ends, starts, restarts, pair_checks, wall_checks, searches, candidates,
          hot_pairs, certificates, zeno_steps, repeated_contacts);
}

}  // namespace kinesphere
