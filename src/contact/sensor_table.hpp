// Which distances two bodies sense each other at, by their classes and categories.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "contact/overlap_records.hpp"
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
  /// False in a world that never had sensors.
  bool any() const { return any_; }
  double reach(SensorClass sensor_class) const {
    const Distances all = distances_of(sensor_class);
    return all.empty() ? 0.0 : all.front();
  }
  /// The largest distance at which either of the two senses the other and that they have not `crossed`, a
  /// list from the outermost inward of some at which one of them does. Cost: O(1) where only one of two
  /// sensors senses, or both are the same, and the outermost distances are crossed, which they are unless a
  /// sensor has just been changed; otherwise O(number of distances).
  std::optional<double> next_inward(const Sensing& a, const Sensing& b, OverlapRecords::List crossed) const;
  /// Whether the watcher senses the other at this distance. Cost: O(log of the number of distances).
  bool senses_one_way(const Sensing& watcher, const Sensing& watched, double distance) const;
  /// Whether one of the two senses the other at this distance. Cost: O(log of the number of distances).
  bool senses(const Sensing& a, const Sensing& b, double distance) const;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [sensors, sorted, any] = self;
    archive(sensors, any);
    if constexpr (std::same_as<Archive, HeapCounter>)
      archive(sorted);
    else if constexpr (!std::is_const_v<Self>)
      self.sort();
  }

 private:
  using Distances = std::span<const double>;

  Distances distances_of(SensorClass sensor_class) const {
    return sensor_class < sorted_.size() ? Distances(sorted_[sensor_class]) : Distances();
  }
  /// At which one body senses another.
  Distances distances_at(const Sensing& watcher, const Sensing& watched) const {
    const bool sees = (of(watcher.sensor_class).mask & watched.category) != 0;
    return sees ? distances_of(watcher.sensor_class) : Distances();
  }
  void sort();

  std::vector<Sensor> sensors_;              ///< by class
  std::vector<std::vector<double>> sorted_;  ///< their distances from the largest on, each once
  bool any_ = false;
};

}  // namespace kinesphere
