// Search for the boxes that overlap, whatever their sizes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// Boxes in grids of cells, a grid for each range of sizes. A box is in the cell of its lower corner.
class BoxGrid {
 public:
  struct Entry {
    Box box;
    std::uint32_t body;
  };

  /// Replaces all boxes, which must be finite. Cost: O(n).
  void build(const std::vector<Entry>& entries);

  /// Calls visit(a, b) once for each two boxes that overlap, touching included; a is the larger number. Cost:
  /// the cells that each box meets in its own grid and in those of larger boxes, and the boxes in them.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const std::vector<Entry>& entries = levels_[level].entries;
      for (std::uint32_t k = 0; k < entries.size(); ++k) {
        const std::uint32_t body = entries[k].body;
        const auto meet = [&](std::uint32_t other) { visit(std::max(body, other), std::min(body, other)); };
        // Boxes of one grid are found by those that come before, larger ones by the smaller.
        levels_[level].for_each_overlap(entries[k].box, meet, k + 1);
        for (std::size_t larger = 0; larger < level; ++larger)
          levels_[larger].for_each_overlap(entries[k].box, meet);
      }
    }
  }

 private:
  struct Level {
    std::vector<Entry> entries;  ///< by cell, once the grid is built
    double width = 0.0;          ///< the longest side of a box
    Vec3 lower{};                ///< least lower corner
    double cells_per_length = 0.0;
    std::array<int, 3> cells{};
    std::vector<std::uint32_t> starts;  ///< of each cell in `entries`, and the end of the last

    void sort();
    /// Returns the cell on an axis that has a coordinate; the first or the last one has all beyond it.
    int cell_along(std::size_t axis, double coordinate) const;
    std::size_t cell_of(const Box& box) const;
    /// Visits the entries from number `begin` on.
    template <class Visit>
    void for_each_overlap(const Box& box, const Visit& visit, std::uint32_t begin = 0) const;
  };

  std::vector<Level> levels_;  ///< by falling size
};

template <class Visit>
void BoxGrid::Level::for_each_overlap(const Box& box, const Visit& visit, std::uint32_t begin) const {
  std::array<int, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = cell_along(axis, box.lower[static_cast<int>(axis)] - width);
    last[axis] = cell_along(axis, box.upper[static_cast<int>(axis)]);
  }
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y) {
      const int first_cell = (z * cells[1] + y) * cells[0];
      const std::uint32_t* const row = starts.data() + first_cell;
      for (std::uint32_t k = std::max(row[first[0]], begin); k < row[last[0] + 1]; ++k) {
        const Box& own = entries[k].box;
        if (own.lower.x <= box.upper.x && box.lower.x <= own.upper.x && own.lower.y <= box.upper.y &&
            box.lower.y <= own.upper.y && own.lower.z <= box.upper.z && box.lower.z <= own.upper.z)
          visit(entries[k].body);
      }
    }
}

}  // namespace kinesphere
