// Distances at which two bodies sense each other, by sensor class and category.
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

/// Largest distance of the sensor (length), or 0 if it has none. Nothing farther away is sensed.
double reach_of(const Sensor& sensor);

/// Properties of a body that sensing depends on.
struct Sensing {
  SensorClass sensor_class;
  std::uint64_t category;  ///< from the body's filter
};

class SensorTable {
 public:
  void set(SensorClass sensor_class, const Sensor& sensor);
  /// Returns the sensor of a class. A class that was never set has no distances.
  const Sensor& of(SensorClass sensor_class) const;
  /// False if no class has ever had a distance.
  bool any() const { return any_; }
  /// Returns the number of distances of all classes together. A pair crosses no more.
  std::size_t distance_count() const { return distance_count_; }
  double reach(SensorClass sensor_class) const {
    const Distances all = distances_of(sensor_class);
    return all.empty() ? 0.0 : all.front();
  }
  /// Returns the largest distance at which either body senses the other and that is not among `crossed`: some
  /// of those distances, from large to small. Cost: O(1) if only one of the two senses or both have the same
  /// sensor, and the outermost distances are the crossed ones (always so unless a sensor was just changed);
  /// otherwise O(number of distances).
  std::optional<double> next_inward(const Sensing& a, const Sensing& b, OverlapRecords::List crossed) const;
  /// True if `watcher` senses `watched` at exactly this distance. Cost: O(log of the number of distances).
  bool senses_one_way(const Sensing& watcher, const Sensing& watched, double distance) const;
  /// True if at least one of the two senses the other at this distance. Cost: O(log of the number of
  /// distances).
  bool senses(const Sensing& a, const Sensing& b, double distance) const;

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [sensors, sorted, any, distance_count] = self;
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
  /// Returns the distances at which `watcher` senses `watched`; empty if its mask excludes the category.
  Distances distances_at(const Sensing& watcher, const Sensing& watched) const {
    const bool sees = (of(watcher.sensor_class).mask & watched.category) != 0;
    return sees ? distances_of(watcher.sensor_class) : Distances();
  }
  void sort();

  std::vector<Sensor> sensors_;  ///< by sensor class
  /// By sensor class: distances from large to small, without duplicates.
  std::vector<std::vector<double>> sorted_;
  bool any_ = false;
  std::size_t distance_count_ = 0;
};

}  // namespace kinesphere
