#include "engine/conflict_detector.hpp"

#include <algorithm>

namespace kinesphere {

void ConflictDetector::clear() {
  checked_.clear();
  unchecked_.clear();
  foreign_.clear();
  checked_foreign_ = 0;
  conflicts_.clear();
}

std::size_t ConflictDetector::take(Clusters& groups, const RunPool& pool,
                                   std::vector<ClusterUpdate>& updates) {
  const auto add = [&](const Cluster& group) {
    for (const SweptSphereUpdate& update : pool.updates_of(group)) updates.push_back({group.index, &update});
  };
  const auto add_foreign = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) updates.push_back({BatchState::unassigned, &foreign_[k]});
  };
  std::erase_if(checked_, [&](std::uint32_t own) {
    return groups[own].is_merged() || !groups[own].executed || !groups[own].updates_are_checked;
  });
  const std::size_t before = checked_.size();
  for (const std::uint32_t own : std::exchange(unchecked_, {})) {
    Cluster& group = groups[own];
    if (group.is_merged() || !group.executed || group.updates_are_checked) continue;
    group.updates_are_checked = true;
    checked_.push_back(own);
    add(group);
  }
  const std::size_t foreign_before = std::exchange(checked_foreign_, foreign_.size());
  add_foreign(foreign_before, foreign_.size());
  const std::size_t fresh = updates.size();
  if (fresh == 0) return 0;
  for (std::size_t k = 0; k < before; ++k) add(groups[checked_[k]]);
  add_foreign(0, foreign_before);
  return fresh;
}

}  // namespace kinesphere
