// The hierarchy of regular grids: cells, their order, the cells that a box meets, and one search tree of all
// cells that are not empty (paper, section 3.1).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere {

/// One cubical subspace. Level 0 is the finest grid; each level has cells twice as large as the level below,
/// so cell i of an axis holds the cells 2 i and 2 i + 1 of the next finer level.
struct Cell {
  int level = 0;
  std::array<std::int64_t, 3> index{};

  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Orders cells by level, then in Z-order: by the numbers made by interleaving the bits of the three indices.
/// In that order all subcells of a cell on one finer level are contiguous. Nothing is interleaved: the axis
/// with the most significant differing bit decides, as it would in the interleaved number.
inline bool operator<(const Cell& a, const Cell& b) {
  if (a.level != b.level) return a.level < b.level;
  const auto difference = [&](std::size_t axis) {
    return static_cast<std::uint64_t>(a.index[axis]) ^ static_cast<std::uint64_t>(b.index[axis]);
  };
  std::size_t deciding = 0;
  std::uint64_t greatest = difference(0);
  for (std::size_t axis = 1; axis < 3; ++axis) {
    const std::uint64_t other = difference(axis);
    // The condition is true if the highest bit of `other` is above that of `greatest`.
    if (greatest < other && greatest < (greatest ^ other)) {
      deciding = axis;
      greatest = other;
    }
  }
  // Signed comparison equals unsigned comparison with flipped sign bits.
  return a.index[deciding] < b.index[deciding];
}

/// All cells of one level with first <= index <= last on every axis.
struct CellRange {
  int level = 0;
  std::array<std::int64_t, 3> first{};
  std::array<std::int64_t, 3> last{};

  friend bool operator==(const CellRange&, const CellRange&) = default;

  bool contains(const Cell& cell) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (cell.index[axis] < first[axis] || cell.index[axis] > last[axis]) return false;
    return cell.level == level;
  }

  /// Returns the cells of level `coarser` (at least the present level) that hold these.
  CellRange on_level(int coarser) const {
    CellRange range{coarser, first, last};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.first[axis] >>= coarser - level;
      range.last[axis] >>= coarser - level;
    }
    return range;
  }

  template <class Visit>
  void for_each_cell(Visit visit) const {
    for (std::int64_t x = first[0]; x <= last[0]; ++x)
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
        for (std::int64_t z = first[2]; z <= last[2]; ++z) visit(Cell{level, {x, y, z}});
  }
};

/// Returns true if a cell of one range and a cell of the other intersect, on whatever levels they are.
inline bool intersect(const CellRange& a, const CellRange& b) {
  if (a.level > b.level) return intersect(b, a);
  const int shift = b.level - a.level;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if ((a.first[axis] >> shift) > b.last[axis] || (a.last[axis] >> shift) < b.first[axis]) return false;
  return true;
}

/// Grids divides all of space on each level. Cell i of an axis holds the coordinates plane(i) <= x < plane(i
/// + 1). The outermost cells of a level reach to infinity, and those of a finer level lie in those of a
/// coarser one. On the coarsest level each axis has just two cells.
class Grids {
 public:
  static constexpr int coarsest_level = 43;

  /// `finest_edge` > 0 (length) is rounded up to 10 significant bits, so that every plane is an exact
  /// product.
  explicit Grids(double finest_edge);

  double edge(int level) const;
  /// Returns the finest level with cells at least twice as large as a sphere of this diameter (length).
  int level_for(double diameter) const;
  /// Returns the coordinate at which the cell begins; infinite beyond the outermost planes.
  double plane(int level, std::int64_t index) const;
  /// Returns the cell that holds a coordinate, consistent with plane() to the last bit.
  std::int64_t index_of(int level, double coordinate) const;
  CellRange cells_of(int level, const Box& box) const;

 private:
  double finest_edge_;
};

/// SubspaceTree holds the bodies of each cell. An empty cell is not in the tree.
class SubspaceTree {
 public:
  using Bodies = std::vector<std::uint32_t>;

  /// Adds the body to the cell. Precondition: it is not in the cell. Cost: O(log n).
  void insert(const Cell& cell, std::uint32_t body);
  /// Removes the body from the cell. Precondition: it is in the cell. Cost: O(log n), and the length of the
  /// cell's list.
  void erase(const Cell& cell, std::uint32_t body);

  /// Calls visit(body) for every body in every cell, of any level, that intersects one of these cells: once
  /// for each such cell that holds the body. `visit` may not change the tree. Cost: O(log n) per cell and
  /// level in use, and the visits.
  template <class Visit>
  void for_each_neighbour(const CellRange& cells, Visit visit) const;

 private:
  using Tree = std::map<Cell, Bodies>;

  static constexpr Cell subcell(const Cell& cell, int finer, bool last);

  Tree tree_;
  std::array<std::size_t, Grids::coarsest_level + 1> cells_on_level_{};
  std::vector<Tree::node_type> spare_;  ///< nodes kept for their memory
};

/// Returns the first or the last of the subcells on a finer level, in the order of cells.
constexpr Cell SubspaceTree::subcell(const Cell& cell, int finer, bool last) {
  const int shift = cell.level - finer;
  Cell sub{finer, cell.index};
  for (std::int64_t& index : sub.index)
    index = index * (std::int64_t{1} << shift) + (last ? (std::int64_t{1} << shift) - 1 : 0);
  return sub;
}

template <class Visit>
void SubspaceTree::for_each_neighbour(const CellRange& cells, Visit visit) const {
  const auto visit_all = [&](const Bodies& bodies) {
    for (const std::uint32_t body : bodies) visit(body);
  };
  for (int level = 0; level <= Grids::coarsest_level; ++level) {
    if (cells_on_level_[static_cast<std::size_t>(level)] == 0) continue;
    if (level >= cells.level) {
      cells.on_level(level).for_each_cell([&](const Cell& cell) {
        if (const auto found = tree_.find(cell); found != tree_.end()) visit_all(found->second);
      });
      continue;
    }
    cells.for_each_cell([&](const Cell& cell) {
      const Cell last = subcell(cell, level, true);
      auto sub = tree_.lower_bound(subcell(cell, level, false));
      for (; sub != tree_.end() && !(last < sub->first); ++sub) visit_all(sub->second);
    });
  }
}

}  // namespace kinesphere
