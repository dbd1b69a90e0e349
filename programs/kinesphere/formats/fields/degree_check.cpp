// Finds lengths that may be degrees by their numbers.
#include "formats/fields/degree_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinesphere::program {

void DegreeCheck::add(double x, double y) {
  least_x_ = std::min(least_x_, x);
  largest_x_ = std::max(largest_x_, x);
  least_y_ = std::min(least_y_, y);
  largest_y_ = std::max(largest_y_, y);
  all_whole_ = all_whole_ && x == std::floor(x) && y == std::floor(y);
}

std::string DegreeCheck::suspicion() const {
  const double spread = std::max(largest_x_ - least_x_, largest_y_ - least_y_);
  const double offset = std::max(std::abs(least_x_ + largest_x_) / 2, std::abs(least_y_ + largest_y_) / 2);
  // A lower ratio would ask about rooms and roads near their origin; a higher one would miss wide regions.
  constexpr double least_ratio = 8.0, least_offset = 1.0;
  const bool in_range = std::abs(least_x_) <= 180.0 && std::abs(largest_x_) <= 180.0 &&
                        std::abs(least_y_) <= 90.0 && std::abs(largest_y_) <= 90.0;
  if (all_whole_ || !in_range || offset < std::max(least_ratio * spread, least_offset)) return {};
  return fmt::format(
      "x ({:.9g} to {:.9g}) and y ({:.9g} to {:.9g}) may be degrees: say --positions lonlat if x is the "
      "longitude and y the latitude (lon=... and lat=... with --columns where it is the other way round), or "
      "--positions plane if they are lengths",
      least_x_, largest_x_, least_y_, largest_y_);
}

}  // namespace kinesphere::program
