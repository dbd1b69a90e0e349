// The grid of a SweptSphereGrid: which cell a swept sphere belongs to, and which cells a search has to read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "broadphase/float_aabb.hpp"

namespace kinesphere {

/// Collects the range of the boxes' centres and the width of the widest box, leaving out values that are too
/// large for cell coordinates.
class SweptSphereSpread {
 public:
  SweptSphereSpread() : lower_{limit, limit, limit}, upper_{-limit, -limit, -limit} {}
  void add(const FloatAabb& aabb) {
    largest_ = std::max(largest_, aabb.widest());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float middle = aabb.middle(axis);
      if (!(std::abs(middle) < limit)) {
        exceeded_ = true;
        continue;
      }
      lower_[axis] = std::min(lower_[axis], middle);
      upper_[axis] = std::max(upper_[axis], middle);
      const float width = aabb.width(axis);
      if (width < limit) widest_ = std::max(widest_, width);
    }
  }
  void add(const SweptSphereSpread& more);

  const std::array<float, 3>& lower() const { return lower_; }
  const std::array<float, 3>& upper() const { return upper_; }
  float widest() const { return widest_; }
  /// Width of the widest box, including the boxes that are too large for cell coordinates.
  float largest() const { return largest_; }
  /// True if a centre was too large for cell coordinates; it may lie outside lower() and upper().
  bool is_exceeded() const { return exceeded_; }
  /// Returns the longest edge of the box around the centres, but no less than widest().
  float extent() const;

  static void serialize(auto& self, auto& archive) {
    auto& [lower, upper, widest, largest, exceeded] = self;
    archive(lower, upper, widest, largest, exceeded);
  }

 private:
  friend class Grid;
  /// Limit of the absolute values of cell coordinates, so that sums of several do not overflow.
  static constexpr float limit = 0x1p29f;

  std::array<float, 3> lower_;
  std::array<float, 3> upper_;
  float widest_ = 0.0f;
  float largest_ = 0.0f;
  bool exceeded_ = false;
};

/// Divides space into cells and gives them indices. Cell i of an axis holds the coordinates in [i, i + 1)
/// times the edge. On a folded axis, cell i shares its index, and so its swept spheres, with all cells i + k
/// count; on any other axis all swept spheres are in `count` cells from the first on. A cell is a cube cut
/// into slices along x: searches read rows of cells as a whole, so thin slices cost nothing, and less is read
/// of rows that are needed only in part. Lengths are in units of a frame.
class Grid {
 public:
  using Cell = std::array<std::int32_t, 3>;
  static constexpr std::size_t slices = 4;

  /// A range of cells: on each axis `count` > 0 cells from the index `begin` on. Past the last cell of an
  /// axis the range continues at the first one.
  struct CellRange {
    std::array<std::uint32_t, 3> begin;
    std::array<std::uint32_t, 3> count;
  };

  Grid() = default;
  /// Makes a grid for `spheres` swept spheres: cubes as wide as the widest one, times `coarseness`, over the
  /// box that holds all centres. An axis is folded where a centre may lie beyond that box, or where there
  /// would be far more cells than swept spheres. A few swept spheres (at most 32) get a single cell.
  Grid(const SweptSphereSpread& spread, std::size_t spheres, float coarseness);

  /// Edge of a cube.
  float edge() const { return edge_[1]; }
  std::size_t cells() const {
    return std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]);
  }
  std::size_t cells_in_a_row() const { return std::size_t(count_[0]); }
  /// Returns the cell that contains the box's centre.
  Cell cell_around(const FloatAabb& aabb) const;
  /// Returns the cell's index, less than cells(); cells along x have successive indices. Precondition: on an
  /// axis that is not folded, the cell is one of its `count` cells.
  std::uint32_t index_of(const Cell& cell) const;
  /// Returns, among the cells with this index, the one nearest to the cell `to`.
  Cell nearest_image(std::uint32_t index, const Cell& to) const;
  /// Returns the looseness: how far the box reaches out of the cell. The result is slightly enlarged,
  /// by 2^-20 of itself, because sums and differences with it are rounded.
  float looseness(const Cell& cell, const FloatAabb& aabb) const;
  Box box_of(const Cell& cell) const;

  /// Returns the cells that may hold a swept sphere whose box has a point in common with `aabb`, or nothing
  /// if there are none. Precondition: no swept sphere's box reaches farther than `reach` out of its cell.
  std::optional<CellRange> cells_near(const FloatAabb& aabb, float reach) const;
  /// True if the range continues at the first cell of an axis; for_each_row() then does not visit cells in
  /// ascending order of index.
  bool wraps(const CellRange& range) const {
    return end_of(range, 0) > along(0) || end_of(range, 1) > along(1) || end_of(range, 2) > along(2);
  }
  /// Calls visit(first, last) for each contiguous piece of a row: the cells with first <= index < last.
  template <class Visit>
  void for_each_row(const CellRange& range, Visit visit) const {
    const std::uint32_t begin = range.begin[0];
    const std::uint32_t within = std::min(range.count[0], along(0) - begin);
    const std::uint32_t beyond = range.count[0] - within;
    for (std::uint32_t k = range.begin[2]; k < end_of(range, 2); ++k) {
      const std::uint32_t z = k < along(2) ? k : k - along(2);
      for (std::uint32_t j = range.begin[1]; j < end_of(range, 1); ++j) {
        const std::uint32_t y = j < along(1) ? j : j - along(1);
        const std::uint32_t row = (z * along(1) + y) * along(0);
        visit(row + begin, row + begin + within);
        if (beyond > 0) visit(row, row + beyond);
      }
    }
  }

  /// True if the deserialized state is consistent.
  bool is_valid() const;
  static void serialize(auto& self, auto& archive) {
    auto& [edge, per_edge, first, count, folded] = self;
    archive(edge, per_edge, first, count, folded);
  }

 private:
  std::uint32_t along(std::size_t axis) const { return static_cast<std::uint32_t>(count_[axis]); }
  static std::uint32_t end_of(const CellRange& range, std::size_t axis) {
    return range.begin[axis] + range.count[axis];
  }
  std::int32_t cell_of(float coordinate, std::size_t axis) const;
  std::int32_t wrapped(std::int32_t cell, std::size_t axis) const;

  std::array<float, 3> edge_{1.0f, 1.0f, 1.0f};
  std::array<float, 3> per_edge_{1.0f, 1.0f, 1.0f};
  Cell first_{};
  Cell count_{1, 1, 1};
  std::array<bool, 3> folded_{};
};

}  // namespace kinesphere
