#include "contact/sensor_table.hpp"

#include <algorithm>

namespace kinesphere {

void SensorTable::set(SensorClass sensor_class, const Sensor& sensor) {
  if (sensor_class >= sensors_.size()) sensors_.resize(sensor_class + std::size_t{1});
  sensors_[sensor_class] = sensor;
  largest_reach_ = std::max(largest_reach_, reach_of(sensor));
  any_ = any_ || !sensor.distances.empty();
}

const Sensor& SensorTable::of(SensorClass sensor_class) const {
  static const Sensor nothing;
  return sensor_class < sensors_.size() ? sensors_[sensor_class] : nothing;
}

double reach_of(const Sensor& sensor) {
  double largest = 0.0;
  for (const double distance : sensor.distances) largest = std::max(largest, distance);
  return largest;
}

}  // namespace kinesphere
