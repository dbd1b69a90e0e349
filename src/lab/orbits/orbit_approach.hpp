// Approaches of satellites.
#pragma once

#include <cstdint>
#include <vector>

namespace kinesphere {

/// The two are within a distance at every time from begin to end.
struct OrbitApproach {
  std::uint32_t first = 0, second = 0;  ///< first < second
  double begin = 0.0, end = 0.0;

  friend bool operator==(const OrbitApproach&, const OrbitApproach&) = default;
};

void sort_by_pair(std::vector<OrbitApproach>& approaches);

/// Those of `approaches` that are at any time not inside one of `others`. Both are sorted by pair. With a
/// `step` > 0 only times that are multiples of it count.
std::vector<OrbitApproach> not_inside(const std::vector<OrbitApproach>& approaches,
                                      const std::vector<OrbitApproach>& others, double step = 0.0);
/// Those of `approaches` that have no time in common with any of `others`. Both are sorted by pair.
std::vector<OrbitApproach> not_met(const std::vector<OrbitApproach>& approaches,
                                   const std::vector<OrbitApproach>& others);

}  // namespace kinesphere
