#include "research/measures/room.hpp"

#include <algorithm>

namespace kinesphere {

// Bisection, as cube roots differ between machines in their last bits.
double edge_of_room(std::uint32_t balls, double radius, double packing) {
  const double volume_of_ball = 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
  const double volume = balls * volume_of_ball / packing;
  double low = 0.0;
  double high = std::max(volume, 1.0);
  while (high - low > 0x1p-20 * high) {
    const double middle = 0.5 * (low + high);
    (middle * middle * middle < volume ? low : high) = middle;
  }
  return high;
}

}  // namespace kinesphere
