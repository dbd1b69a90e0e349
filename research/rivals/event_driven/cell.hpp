// Cells of a hierarchy of grids: containment and order.
#pragma once

#include <array>
#include <cstdint>

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

}  // namespace kinesphere
