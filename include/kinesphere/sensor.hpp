// Sensors: distances at which the world reports that another body approaches or leaves.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "kinesphere/body_id.hpp"

namespace kinesphere {

/// Sensor distances of a class of bodies. For two bodies whose filters let them meet, each distance at
/// which either senses the other causes sensor_enter when the gap between their surfaces has shrunk to it,
/// and sensor_leave when the gap has grown to it plus the separation distance. Crossings are found with the
/// guarantee of contacts, at any speed.
struct Sensor {
  /// Each >= 0 (length), for instance 50 to warn and 10 for an alarm. Any number of them, in any order.
  std::vector<double> distances{};
  /// The sensor senses bodies with a category bit (Filter::category) in this mask.
  std::uint64_t mask = std::numeric_limits<std::uint64_t>::max();

  friend bool operator==(const Sensor&, const Sensor&) = default;
};

/// Class of bodies that share a sensor: World::set_sensor().
using SensorClass = std::uint8_t;

/// The class of zones (World::add_zone). No other body should belong to it.
inline constexpr SensorClass zone_class = 255;

/// Another body within a sensor distance (length), as World::sensor_overlaps() returns it.
struct SensorOverlap {
  BodyId body = no_body;
  double distance = 0.0;

  friend bool operator==(const SensorOverlap&, const SensorOverlap&) = default;
};

}  // namespace kinesphere
