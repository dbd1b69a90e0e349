#include "research/rivals/event_driven/subspace_tree.hpp"

#include <algorithm>
#include <cassert>

namespace kinesphere {

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
