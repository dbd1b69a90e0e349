#include "contact/sensor_table.hpp"

#include <algorithm>
#include <utility>

namespace kinesphere {

void SensorTable::set(SensorClass sensor_class, const Sensor& sensor) {
  if (sensor_class >= sensors_.size()) sensors_.resize(sensor_class + std::size_t{1});
  sensors_[sensor_class] = sensor;
  sort();
  any_ = any_ || !sensor.distances.empty();
}

const Sensor& SensorTable::of(SensorClass sensor_class) const {
  static const Sensor nothing;
  return sensor_class < sensors_.size() ? sensors_[sensor_class] : nothing;
}

std::optional<double> SensorTable::next_inward(const Sensing& a, const Sensing& b,
                                               OverlapRecords::List crossed) const {
  Distances first = distances_at(a, b);
  Distances second = distances_at(b, a);
  if (first.empty()) std::swap(first, second);
  if (first.data() == second.data()) second = {};
  const std::size_t count = crossed.size();
  // Fast path: exactly the outer `count` distances have been crossed, so the next one is at index `count`.
  if (second.empty() && count <= first.size() && (count == 0 || first[count - 1] == crossed.back().distance))
    return count < first.size() ? std::optional(first[count]) : std::nullopt;
  std::optional<double> largest;
  for (const Distances all : {first, second}) {
    std::size_t next = 0;
    for (const double distance : all) {
      if (largest && distance <= *largest) break;
      while (next < count && crossed[next].distance > distance) ++next;
      if (next < count && crossed[next].distance == distance) continue;
      largest = distance;
      break;
    }
  }
  return largest;
}

bool SensorTable::senses_one_way(const Sensing& watcher, const Sensing& watched, double distance) const {
  const Distances all = distances_at(watcher, watched);
  return std::binary_search(all.begin(), all.end(), distance, is_farther);
}

bool SensorTable::senses(const Sensing& a, const Sensing& b, double distance) const {
  return senses_one_way(a, b, distance) || senses_one_way(b, a, distance);
}

void SensorTable::sort() {
  sorted_.resize(sensors_.size());
  distance_count_ = 0;
  for (std::size_t k = 0; k < sensors_.size(); ++k) {
    sorted_[k] = sensors_[k].distances;
    std::sort(sorted_[k].begin(), sorted_[k].end(), is_farther);
    sorted_[k].erase(std::unique(sorted_[k].begin(), sorted_[k].end()), sorted_[k].end());
    distance_count_ += sorted_[k].size();
  }
}

double reach_of(const Sensor& sensor) {
  double largest = 0.0;
  for (const double distance : sensor.distances) largest = std::max(largest, distance);
  return largest;
}

}  // namespace kinesphere
