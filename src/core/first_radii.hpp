// The radii of the first safe regions of balls that arrive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "kinesphere/vec3.hpp"

namespace kinesphere::core {

/// A ball that arrives.
struct Arrival {
  std::uint32_t ball;
  Vec3 position;
  double radius = 0.0;  ///< of its first safe region (length)
};

/// So many balls that arrive at once look each for itself how far others are.
inline constexpr std::size_t single_arrivals = 8;

/// Chooses the radii of balls that arrive together, in any order: in each part of space with about equally
/// many of them, they are as wide as these are apart there. Their order changes. Cost: O(n log n).
void choose_first_radii(std::span<Arrival> arrivals, double tolerance);

/// Returns about a third of the mean distance (length) of so many balls that fill a box.
double first_radius(const Box& extent, std::size_t balls, double tolerance);

/// The box around points, as far as there are any.
class BoundingBox {
 public:
  void add(const Vec3& point);
  const Box& box() const { return box_; }

 private:
  static constexpr double largest = std::numeric_limits<double>::infinity();
  Box box_{{largest, largest, largest}, {-largest, -largest, -largest}};
};

}  // namespace kinesphere::core
