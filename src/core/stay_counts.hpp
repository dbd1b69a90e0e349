// StayCounts counts balls by how long they stay in their safe regions. Counts of parts of a world add up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere::core {

class StayCounts {
 public:
  /// Counts a ball that stays in its safe region for so long from now on.
  void add(double stay) {
    ++counts_[static_cast<std::size_t>(std::clamp(exponent_of(stay), least, 0) - least)];
  }
  /// Returns the numbers of balls, to be added to those of other parts.
  auto& counts() { return counts_; }
  /// Returns the largest power of two that is not above the median, but at most 1; infinity if there is none.
  double median() const {
    std::uint64_t all = 0, before = 0;
    for (const std::uint64_t count : counts_) all += count;
    for (std::size_t k = 0; k < counts_.size(); ++k) {
      before += counts_[k];
      if (before > all / 2) return power_of_two(static_cast<int>(k) + least);
    }
    return infinity;
  }

 private:
  static constexpr int least = -127;
  std::array<std::uint64_t, 1 - least> counts_{};  ///< by exponent, from `least` on
};

}  // namespace kinesphere::core
