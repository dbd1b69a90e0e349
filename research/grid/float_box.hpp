// A box in single precision that contains the double box it was made from.
#pragma once

#include <algorithm>
#include <array>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// A box in single precision, which contains the box that it was made from.
struct FloatBox {
  std::array<float, 3> lower;
  std::array<float, 3> upper;

  FloatBox() = default;
  FloatBox(const std::array<float, 3>& low, const std::array<float, 3>& high) : lower(low), upper(high) {}
  /// Rounds the corners outward.
  explicit FloatBox(const Box& box);

  bool overlaps(const FloatBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
  float extent() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }

  friend bool operator==(const FloatBox&, const FloatBox&) = default;
};

}  // namespace kinesphere
