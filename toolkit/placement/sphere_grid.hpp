// A grid that finds the spheres near a sphere, whatever their sizes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "placement/sphere_room.hpp"

namespace kinesphere {

/// Cells with the spheres that have been put in. Each sphere has a range (length): two are near each other if
/// the sum of their ranges may be as large as their distance. Spheres with ranges in one power of two share a
/// level with cells of its own. Precondition: spheres enter by falling level, so that those of a range find
/// all that are in.
class SphereGrid {
 public:
  /// Refers to both arguments.
  SphereGrid(const SphereRoom& room, const std::vector<double>& ranges);

  /// Returns numbers that rise with falling level and, in a level, with the cell: spheres sorted by it may
  /// enter in that order, and lie close to their neighbours.
  std::uint64_t order(std::uint32_t sphere, const Vec3& centre) const {
    return std::uint64_t{level_of_[sphere]} << 40 | cell(levels_[level_of_[sphere]], centre);
  }
  void clear();
  /// Precondition: the centre is in the box.
  void enter(std::uint32_t sphere, const Vec3& centre) {
    std::uint32_t& first = levels_[level_of_[sphere]].first[cell(levels_[level_of_[sphere]], centre)];
    next_[sphere] = first;
    first = sphere;
  }

  /// Calls visit(other) for all spheres that may be near this one at `centre`, until it returns false, and
  /// returns whether it never did.
  template <class Visit>
  bool all_near(std::uint32_t sphere, const Vec3& centre, Visit visit) const {
    for (std::uint32_t k = 0; k <= level_of_[sphere]; ++k)
      if (!all_near(levels_[k], centre, ranges_[sphere] + levels_[k].range, visit)) return false;
    return true;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Level {
    double range = 0.0;  ///< the largest
    std::uint32_t spheres = 0;
    int cells[3] = {1, 1, 1};
    Vec3 cells_per_length{};
    std::vector<std::uint32_t> first;  ///< of each cell, the sphere that entered last
  };

  void divide(Level& level) const;
  /// Returns the cell of this index on a periodic axis. Precondition: -count <= index < 2 count.
  static std::uint32_t in_turn(int index, int count) {
    return static_cast<std::uint32_t>(index < 0 ? index + count : index >= count ? index - count : index);
  }
  int index(const Level& level, int axis, double coordinate) const {
    return static_cast<int>(std::floor((coordinate - room_.box.lower[axis]) * level.cells_per_length[axis]));
  }
  std::size_t cell(const Level& level, const Vec3& centre) const {
    std::size_t cell = 0;
    for (int axis = 0; axis < 3; ++axis)
      cell = cell * static_cast<std::size_t>(level.cells[axis]) +
             static_cast<std::size_t>(std::clamp(index(level, axis, centre[axis]), 0, level.cells[axis] - 1));
    return cell;
  }
  template <class Visit>
  bool all_near(const Level& level, const Vec3& centre, double distance, Visit visit) const {
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const int last = level.cells[axis] - 1;
      low[axis] = index(level, axis, centre[axis] - distance);
      high[axis] = index(level, axis, centre[axis] + distance);
      if (!room_.periodic[axis]) {
        low[axis] = std::clamp(low[axis], 0, last);
        high[axis] = std::clamp(high[axis], 0, last);
      } else if (high[axis] - low[axis] > last) {
        low[axis] = 0;
        high[axis] = last;
      }
    }
    const auto& [columns, rows, cells] = level.cells;
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        const std::uint32_t* const row =
            &level.first[(std::size_t{in_turn(x, columns)} * static_cast<std::size_t>(rows) +
                          in_turn(y, rows)) *
                         static_cast<std::size_t>(cells)];
        for (int z = low[2]; z <= high[2]; ++z)
          for (std::uint32_t other = row[in_turn(z, cells)]; other != none; other = next_[other])
            if (!visit(other)) return false;
      }
    }
    return true;
  }

  const SphereRoom& room_;
  const std::vector<double>& ranges_;
  std::vector<Level> levels_;            ///< by falling range
  std::vector<std::uint32_t> level_of_;  ///< of each sphere
  std::vector<std::uint32_t> next_;      ///< of each sphere, the one that entered its cell before
};

}  // namespace kinesphere
