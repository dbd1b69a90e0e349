// Events as objects of Python, and as rows of a table.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/event.hpp"

namespace kinesphere::python {

namespace py = pybind11;

/// A row of kinesphere.event_dtype. Its members are in the order of the columns, which numpy.save() requires.
/// Bytes that are not used are zero, as they go into files.
struct EventRecord {
  EventKind kind;
  std::array<std::uint8_t, 7> unused_after_kind;
  double time;
  std::int64_t first;
  std::int64_t second;
  Wall wall;
  bool repeated;
  bool jammed;
  bool already_touching;
  Senses senses;
  std::array<std::uint8_t, 3> unused_after_senses;
  State first_state;
  State second_state;
  Vec3 point;
  Vec3 normal;
  double gap;
  double approach_speed;
  double position_excess;
  double velocity_excess;
  double distance;
  std::uint64_t first_user_data;
  std::uint64_t second_user_data;
  double first_mass;
  double second_mass;
  std::uint32_t first_part;
  std::uint32_t second_part;
  Vec3 first_angular_velocity;
  Vec3 second_angular_velocity;
  Vec3 first_spin_gain;
  Vec3 second_spin_gain;
  double acceleration_limit;
  bool first_is_static;
  bool first_is_zone;
  bool first_is_sleeping;
  bool second_is_static;
  bool second_is_zone;
  bool second_is_sleeping;
  std::array<std::uint8_t, 2> unused_at_end;
};
EventRecord record_of(const Event& event);

/// Returns a kinesphere.Events.
py::object table_of(std::span<const EventRecord> records);

void bind_events(py::module_& module);

}  // namespace kinesphere::python
