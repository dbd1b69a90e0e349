// The grid of a layer: which cell a capsule belongs to, and which cells a search has to read.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "broadphase/float_aabb.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// Where the middles of some capsules are, and how wide the widest is; but for those that are too large for
/// whole numbers of cells.
class SweptSphereSpread {
 public:
  SweptSphereSpread();
  void add(const FloatAabb& aabb);
  void add(const SweptSphereSpread& more);

  const std::array<float, 3>& lower() const { return lower_; }
  const std::array<float, 3>& upper() const { return upper_; }
  float widest() const { return widest_; }
  /// The widest of all, however large.
  float largest() const { return largest_; }
  /// A middle that is too large for whole numbers of cells may lie beyond lower() and upper().
  bool is_exceeded() const { return exceeded_; }
  /// The longest edge of the box around the middles, but no less than the widest.
  float extent() const;

 private:
  std::array<float, 3> lower_;
  std::array<float, 3> upper_;
  float widest_ = 0.0f;
  float largest_ = 0.0f;
  bool exceeded_ = false;
};

/// Divides space into cells, which have indices. Those with coordinates in [i, i + 1) times the edge are cell
/// i of an axis. Where the axis is folded, cell i shares its index, and so its capsules, with all cells
/// i + k count; else all capsules are in `count` cells from the first on. Cells are cubes cut into slices
/// along x: rows of cells are read as a whole, so that thin slices cost nothing, and less is read of rows
/// that are not needed as a whole. Lengths are in units of a frame.
class Grid {
 public:
  using Cell = std::array<std::int32_t, 3>;
  static constexpr std::size_t slices = 4;

  /// On each axis `count` > 0 cells from the index `begin` on; those beyond the last one of the axis are the
  /// first ones.
  struct CellRange {
    std::array<std::uint32_t, 3> begin;
    std::array<std::uint32_t, 3> count;
  };

  Grid() = default;
  /// For so many capsules: cubes as wide as the widest, times `coarseness`, over the box that holds all
  /// middles; folded where a middle may lie beyond that, or where there would be far more cells than
  /// capsules. Few capsules get one cell.
  Grid(const SweptSphereSpread& error, std::size_t spheres, float coarseness);

  /// Of a cube.
  float edge() const { return edge_[1]; }
  std::size_t cells() const {
    return std::size_t(count_[0]) * std::size_t(count_[1]) * std::size_t(count_[2]);
  }
  std::size_t cells_in_a_row() const { return std::size_t(count_[0]); }
  /// In which the middle is.
  Cell cell_around(const FloatAabb& aabb) const;
  /// Less than cells(); those along x follow each other. Where an axis is not folded, of one of its `count`
  /// cells.
  std::uint32_t index_of(const Cell& cell) const;
  /// Of the cells with this index the one that is nearest to another.
  Cell nearest_image(std::uint32_t index, const Cell& to) const;
  /// How far corners reach out of a cell; a little more, as what is added to it or taken from it may be lost
  /// in rounding.
  float looseness(const Cell& cell, const FloatAabb& aabb) const;
  Box box_of(const Cell& cell) const;

  /// The cells that may hold a capsule that has a point in common with the corners, if none reaches farther
  /// than `reach` out of its cell.
  std::optional<CellRange> cells_near(const FloatAabb& aabb, float reach) const;
  /// Some of the cells are beyond the last ones of an axis: for_each_row() does not visit them in the order
  /// of their indices.
  bool wraps(const CellRange& range) const {
    return end_of(range, 0) > along(0) || end_of(range, 1) > along(1) || end_of(range, 2) > along(2);
  }
  /// Calls visit(first, last) for each piece of a row, cells with first <= index < last.
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

  /// For one that was read.
  bool is_valid() const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
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
