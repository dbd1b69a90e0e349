#include "speculation/conflict_detector.hpp"

namespace kinesphere {

void ConflictDetector::clear() {
  checked_.clear();
  unchecked_.clear();
  foreign_.clear();
  checked_foreign_ = 0;
  conflicts_.clear();
}

std::size_t ConflictDetector::take(Clusters& clusters, const RunPool& pool,
                                   std::vector<ClusterUpdate>& updates) {
  const auto add = [&](const Cluster& cluster) {
    for (const SweptSphereUpdate& update : pool.updates_of(cluster))
      if (!update.is_departure()) updates.push_back({cluster.index, &update});
  };
  const auto add_foreign = [&](std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) updates.push_back({BatchState::unassigned, &foreign_[k]});
  };
  std::erase_if(checked_, [&](std::uint32_t index) {
    return clusters[index].is_merged() || !clusters[index].executed || !clusters[index].updates_are_checked;
  });
  const std::size_t before = checked_.size();
  for (const std::uint32_t index : std::exchange(unchecked_, {})) {
    Cluster& cluster = clusters[index];
    if (cluster.is_merged() || !cluster.executed || cluster.updates_are_checked) continue;
    cluster.updates_are_checked = true;
    checked_.push_back(index);
    add(cluster);
  }
  const std::size_t foreign_before = std::exchange(checked_foreign_, foreign_.size());
  add_foreign(foreign_before, foreign_.size());
  const std::size_t fresh = updates.size();
  if (fresh == 0) return 0;
  for (std::size_t k = 0; k < before; ++k) add(clusters[checked_[k]]);
  add_foreign(0, foreign_before);
  return fresh;
}

}  // namespace kinesphere
