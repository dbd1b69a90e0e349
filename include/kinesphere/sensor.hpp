// Sensors: distances at which the world tells that another body comes near, or goes.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "kinesphere/body_id.hpp"

namespace kinesphere {

/// Two bodies that may meet (Filter) cross each distance that either of them senses the other at:
/// sensor_enter when the gap between their surfaces has come down to it, sensor_leave when it has grown to
/// the separation distance beyond it. Found with the same rigour as contacts, however fast the bodies are.
struct Sensor {
  /// Each >= 0 (length): for instance 50 to warn and 10 for an alarm. Any number of them, in any order.
  std::vector<double> distances{};
  /// It senses bodies whose category (Filter::category) has a bit in this mask.
  std::uint64_t mask = std::numeric_limits<std::uint64_t>::max();

  friend bool operator==(const Sensor&, const Sensor&) = default;
};

/// All bodies of a class have the same sensor: World::set_sensor.
using SensorClass = std::uint8_t;

/// The class of zones (World::add_zone). No other body should be in it.
inline constexpr SensorClass zone_class = 255;

/// Another body within a sensor distance.
struct SensorOverlap {
  BodyId body = no_body;
  double distance = 0.0;

  friend bool operator==(const SensorOverlap&, const SensorOverlap&) = default;
};

}  // namespace kinesphere
