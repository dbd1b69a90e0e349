#include "research/rivals/event_driven/grids.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

constexpr int significant_bits = 10;

double edge_rounded_up(double edge) {
  int exponent = 0;
  const double fraction = std::frexp(edge, &exponent);
  return std::ldexp(std::ceil(std::ldexp(fraction, significant_bits)), exponent - significant_bits);
}

/// Returns half the number of cells of an axis: indices run from -cells_to_a_side to cells_to_a_side - 1.
std::int64_t cells_to_a_side(int level) { return std::int64_t{1} << (Grids::coarsest_level - level); }

}  // namespace

Grids::Grids(double finest_edge) : finest_edge_(edge_rounded_up(finest_edge)) {}

double Grids::edge(int level) const { return finest_edge_ * static_cast<double>(std::int64_t{1} << level); }

int Grids::level_for(double diameter) const {
  int level = 0;
  while (level < coarsest_level && edge(level) < 2.0 * diameter) ++level;
  return level;
}

double Grids::plane(int level, std::int64_t index) const {
  const std::int64_t limit = cells_to_a_side(level);
  if (index <= -limit) return -infinity;
  if (index >= limit) return infinity;
  return static_cast<double>(index) * edge(level);
}

std::int64_t Grids::index_of(int level, double coordinate) const {
  const double cells = std::floor(coordinate / edge(level));
  const auto lowest = static_cast<double>(-cells_to_a_side(level));
  // The comparisons are in this order so that NaN gets an index too.
  const auto index = static_cast<std::int64_t>(cells > lowest ? std::min(cells, -lowest - 1.0) : lowest);
  // The quotient may have been rounded up to a whole number, but not down below one.
  return plane(level, index) > coordinate ? index - 1 : index;
}

CellRange Grids::cells_of(int level, const Box& box) const {
  CellRange range{.level = level};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    range.first[i] = index_of(level, box.lower[axis]);
    range.last[i] = index_of(level, box.upper[axis]);
  }
  return range;
}

void SubspaceTree::insert(const Cell& cell, std::uint32_t body) {
  auto at = tree_.lower_bound(cell);
  if (at == tree_.end() || at->first != cell) {
    if (spare_.empty()) {
      at = tree_.emplace_hint(at, cell, Bodies());
    } else {
      Tree::node_type node = std::move(spare_.back());
      spare_.pop_back();
      node.key() = cell;
      at = tree_.insert(at, std::move(node));
    }
    ++cells_on_level_[static_cast<std::size_t>(cell.level)];
  }
  assert(std::find(at->second.begin(), at->second.end(), body) == at->second.end());
  at->second.push_back(body);
}

void SubspaceTree::erase(const Cell& cell, std::uint32_t body) {
  const auto at = tree_.find(cell);
  assert(at != tree_.end());
  Bodies& bodies = at->second;
  const auto place = std::find(bodies.begin(), bodies.end(), body);
  assert(place != bodies.end());
  *place = bodies.back();
  bodies.pop_back();
  if (!bodies.empty()) return;
  --cells_on_level_[static_cast<std::size_t>(cell.level)];
  spare_.push_back(tree_.extract(at));
}

}  // namespace kinesphere
