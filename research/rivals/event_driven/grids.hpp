// The hierarchy of regular grids: edges, planes, and the cells that a box meets (paper, section 3.1).
#pragma once

#include <cstdint>

#include "kinesphere/vec3.hpp"
#include "research/rivals/event_driven/cell.hpp"

namespace kinesphere {

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

}  // namespace kinesphere
