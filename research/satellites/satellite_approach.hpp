// Approaches of satellites.
#pragma once

#include <cstdint>
#include <vector>

namespace kinesphere {

/// A span of time in which two satellites are within a distance.
struct SatelliteApproach {
  std::uint32_t first = 0, second = 0;  ///< first < second
  double begin = 0.0, end = 0.0;

  friend bool operator==(const SatelliteApproach&, const SatelliteApproach&) = default;
};

/// Sorts approaches by pair and begin.
void sort_by_pair(std::vector<SatelliteApproach>& approaches);

/// Returns those of `approaches` that are at any time not inside one of `others`. Precondition: the two lists
/// are sorted by pair. With a `step` > 0 only times that are multiples of it count.
std::vector<SatelliteApproach> not_inside(const std::vector<SatelliteApproach>& approaches,
                                          const std::vector<SatelliteApproach>& others, double step = 0.0);
/// Returns those of `approaches` that have no time in common with any of `others`. Precondition: the two
/// lists are sorted by pair.
std::vector<SatelliteApproach> not_met(const std::vector<SatelliteApproach>& approaches,
                                       const std::vector<SatelliteApproach>& others);

}  // namespace kinesphere
