#include "research/measures/box_grid.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace kinesphere {
namespace {

double longest_side(const Box& box) {
  const Vec3 size = box.upper - box.lower;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

void BoxGrid::build(const std::vector<Entry>& entries) {
  // Sides in a range of 1 to 4 share a grid.
  std::map<int, Level, std::greater<>> levels;
  for (const Entry& entry : entries) {
    const double side = longest_side(entry.box);
    Level& level = levels[side > 0.0 ? std::ilogb(side) / 2 : -1000];
    level.entries.push_back(entry);
    level.width = std::max(level.width, side);
  }
  levels_.clear();
  for (auto& [size, level] : levels) {
    level.sort();
    levels_.push_back(std::move(level));
  }
}

/// Makes cells as wide as the longest side, but no more than two for each box, and sorts the boxes by cell.
void BoxGrid::Level::sort() {
  lower = entries.front().box.lower;
  Vec3 upper = lower;
  for (const Entry& entry : entries)
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], entry.box.lower[axis]);
      upper[axis] = std::max(upper[axis], entry.box.lower[axis]);
    }
  const Vec3 size = upper - lower;
  double edge = std::max(width, 0x1p-20 * std::max({size.x, size.y, size.z, 1e-300}));
  const double most_cells = 2.0 * static_cast<double>(entries.size()) + 64.0;
  const auto count = [&](int axis) { return std::floor(size[axis] / edge) + 1.0; };
  while (count(0) * count(1) * count(2) > most_cells) edge *= 1.25;
  cells_per_length = 1.0 / edge;
  for (std::size_t axis = 0; axis < 3; ++axis) cells[axis] = static_cast<int>(count(static_cast<int>(axis)));

  starts.assign(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]) + 1, 0);
  for (const Entry& entry : entries) ++starts[cell_of(entry.box)];
  std::uint32_t before = 0;
  for (std::uint32_t& start : starts) start = before += start;
  std::vector<Entry> sorted(entries.size());
  // Each cell's start moves from the end of the cell to its first box.
  for (std::size_t k = entries.size(); k-- > 0;) sorted[--starts[cell_of(entries[k].box)]] = entries[k];
  entries = std::move(sorted);
}

int BoxGrid::Level::cell_along(std::size_t axis, double coordinate) const {
  const double cell = (coordinate - lower[static_cast<int>(axis)]) * cells_per_length;
  return static_cast<int>(std::clamp(cell, 0.0, cells[axis] - 1.0));
}

std::size_t BoxGrid::Level::cell_of(const Box& box) const {
  const int row = cell_along(2, box.lower.z) * cells[1] + cell_along(1, box.lower.y);
  const int cell = row * cells[0] + cell_along(0, box.lower.x);
  return static_cast<std::size_t>(cell);
}

}  // namespace kinesphere
