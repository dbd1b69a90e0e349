// The subspace tree: all non-empty cells of all grids in one balanced search tree (paper, section 3.1).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "research/rivals/event_driven/cell.hpp"
#include "research/rivals/event_driven/grids.hpp"

namespace kinesphere {

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

  const std::map<Cell, Bodies>& cells() const { return tree_; }

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
