#include "placement/sphere_grid.hpp"

#include <functional>
#include <map>

#include "number/powers.hpp"

namespace kinesphere {

SphereGrid::SphereGrid(const SphereRoom& room, const std::vector<double>& ranges)
    : room_(room), ranges_(ranges), next_(ranges.size()) {
  std::map<int, std::uint32_t, std::greater<>> levels;  // by the exponent of ranges
  for (const double range : ranges) levels.try_emplace(exponent_of(range), 0);
  for (auto& [exponent, level] : levels) {
    level = static_cast<std::uint32_t>(levels_.size());
    levels_.emplace_back();
  }
  for (const double range : ranges) {
    level_of_.push_back(levels[exponent_of(range)]);
    Level& level = levels_[level_of_.back()];
    level.range = std::max(level.range, range);
    ++level.spheres;
  }
  for (Level& level : levels_) divide(level);
}

/// Chooses cells as wide as the largest range and a half (one to three take about as long), but no more than
/// about two for each sphere.
void SphereGrid::divide(Level& level) const {
  const double longest =
      std::max({room_.size(0), room_.size(1), room_.dimensions == 2 ? 0.0 : room_.size(2)});
  double edge = std::max(1.5 * level.range, 0x1p-20 * longest);
  for (;; edge *= 1.25) {
    double cells = 1.0;
    for (int axis = 0; axis < room_.dimensions; ++axis) {
      level.cells[axis] = std::max(1, static_cast<int>(room_.size(axis) / edge));
      cells *= level.cells[axis];
    }
    if (cells <= 2.0 * level.spheres + 64.0) break;
  }
  for (int axis = 0; axis < room_.dimensions; ++axis)
    level.cells_per_length[axis] = level.cells[axis] / room_.size(axis);
  std::size_t cells = 1;
  for (const int along : level.cells) cells *= static_cast<std::size_t>(along);
  level.first.assign(cells, none);
}

void SphereGrid::clear() {
  for (Level& level : levels_) std::fill(level.first.begin(), level.first.end(), none);
}

}  // namespace kinesphere
