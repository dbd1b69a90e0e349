// Approaches of satellites.
#pragma once

#include <cstdint>
#include <vector>

namespace kinesphere {

/// The two are within a distance at every time from begin to end.
struct SatelliteApproach {
  std::uint32_t first = 0, second = 0;  ///< first < second
  double begin = 0.0, end = 0.0;

  friend bool operator==(const SatelliteApproach&, const SatelliteApproach&) = default;
};

void sort_by_pair(std::vector<SatelliteApproach>& approaches);

/// Those of `approaches` that are at any time not inside one of `others`. Both are sorted by pair. With a
/// `step` > 0 only times that are multiples of it count.
std::vector<SatelliteApproach> not_inside(const std::vector<SatelliteApproach>& approaches,
                                          const std::vector<SatelliteApproach>& others, double step = 0.0);
/// Those of `approaches` that have no time in common with any of `others`. Both are sorted by pair.
std::vector<SatelliteApproach> not_met(const std::vector<SatelliteApproach>& approaches,
                                       const std::vector<SatelliteApproach>& others);

}  // namespace kinesphere
