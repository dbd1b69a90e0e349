// Which distances two bodies sense each other at, by their classes and categories.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/sensor.hpp"

namespace kinesphere {

/// Nothing farther away than this is sensed (length): the largest distance, or 0.
double reach_of(const Sensor& sensor);

/// What sensors need to know of a body.
struct Sensing {
  SensorClass sensor_class;
  std::uint64_t category;  ///< of its filter
};

class SensorTable {
 public:
  void set(SensorClass sensor_class, const Sensor& sensor);
  /// That of a class which was never set senses nothing.
  const Sensor& of(SensorClass sensor_class) const;
  /// False in a world that never had sensors: facts made while there were some go by rules of their own
  /// (World::Engine::facts_end_with_boxes), and outlive them.
  bool any() const { return any_; }
  double reach(SensorClass sensor_class) const { return reach_of(of(sensor_class)); }
  /// No class senses farther, nor did one before.
  double largest_reach() const { return largest_reach_; }

  /// The largest distance at which either of the two senses the other and that is not `known`(distance).
  template <class Known>
  std::optional<double> largest(const Sensing& a, const Sensing& b, Known known) const {
    std::optional<double> found;
    const auto consider = [&](const Sensing& watcher, const Sensing& watched) {
      const Sensor& sensor = of(watcher.sensor_class);
      if ((sensor.mask & watched.category) == 0) return;
      for (const double distance : sensor.distances)
        if ((!found || distance > *found) && !known(distance)) found = distance;
    };
    consider(a, b);
    consider(b, a);
    return found;
  }
  /// Whether one of the two senses the other at this distance.
  bool senses(const Sensing& a, const Sensing& b, double distance) const {
    return largest(a, b, [=](double other) { return other != distance; }).has_value();
  }

  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [sensors, any, farthest] = self;
    archive(sensors, any, farthest);
  }

 private:
  std::vector<Sensor> sensors_;  ///< by class
  bool any_ = false;
  double largest_reach_ = 0.0;
};

}  // namespace kinesphere
