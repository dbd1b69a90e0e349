// The order of points along Morton's curve: those that follow each other are mostly near each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// The low ten bits, each three places from the next.
constexpr std::uint32_t with_gaps(std::uint32_t bits) {
  bits &= 0x3ff;
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

/// Where on the curve the cell of this edge lies that holds the point. The curve repeats after 1024 cells.
inline std::uint32_t morton_key(const Vec3& point, double edge) {
  const auto cell = [edge](double coordinate) {
    constexpr double farthest = 0x1p62;
    constexpr double cells = 1024.0;
    const double number = std::floor(std::clamp(coordinate / edge, -farthest, farthest));
    return static_cast<std::uint32_t>(number - cells * std::floor(number / cells));
  };
  return with_gaps(cell(point.x)) | with_gaps(cell(point.y)) << 1 | with_gaps(cell(point.z)) << 2;
}

}  // namespace kinesphere
