// A hash grid and a plain list of boxes with the same content, and queries of the two.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "research/grid/hash_grid.hpp"

namespace kinesphere {

class MirroredGrid {
 public:
  void set(std::uint32_t body, const Box& box) {
    grid_.set(body, box);
    boxes_[body] = box;
  }
  void remove(std::uint32_t body) {
    grid_.remove(body);
    boxes_.erase(body);
  }

  /// Checks that each body with a box, in single precision, that overlaps is visited once, and no other
  /// except near misses by less than a step.
  testing::AssertionResult same_overlaps(const Box& query) const {
    std::vector<std::uint32_t> visited;
    grid_.for_each_overlap(query, [&](std::uint32_t body) { visited.push_back(body); });
    std::sort(visited.begin(), visited.end());
    std::vector<std::uint32_t> expected;
    for (const auto& [body, box] : boxes_) {
      const bool found = std::binary_search(visited.begin(), visited.end(), body);
      if (FloatBox(box).overlaps(FloatBox(query)) || (found && is_nearly_hit(box, query)))
        expected.push_back(body);
    }
    if (visited == expected) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "visited " << testing::PrintToString(visited) << " instead of "
                                       << testing::PrintToString(expected);
  }

  const HashGrid& grid() const { return grid_; }
  const std::map<std::uint32_t, Box>& boxes() const { return boxes_; }

 private:
  /// Cells are at most four times as large as their content, or the finest.
  bool is_nearly_hit(const Box& box, const Box& query) const {
    const double largest_cell = std::max(grid_.finest_edge(), 4.0 * FloatBox(box).extent());
    const Vec3 step = Vec3{1, 1, 1} * (1.001 * largest_cell / 4096.0);
    return FloatBox({box.lower - step, box.upper + step}).overlaps(FloatBox(query));
  }

  HashGrid grid_;
  std::map<std::uint32_t, Box> boxes_;
};

}  // namespace kinesphere
