// Which kicks of islands have been held against all others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/conflicts.hpp"
#include "engine/run_pool.hpp"

namespace kinesphere {

class ConflictDetector {
 public:
  /// A part begins.
  void clear();
  /// These groups have run.
  void note_runs(std::span<const std::uint32_t> groups) {
    unchecked_.insert(unchecked_.end(), groups.begin(), groups.end());
  }
  /// A body that another process kicks.
  void add_foreign(const SweptSphereUpdate& update) { foreign_.push_back(update); }
  bool has_new_foreign() const { return checked_foreign_ < foreign_.size(); }
  /// All kicks of groups that stand, and of other processes: first those that have not been held against
  /// others, as is to be done now. Returns how many these are; if there are none, there are no others.
  std::size_t take(Clusters& groups, const RunPool& pool, std::vector<ClusterUpdate>& updates);

  /// A group may meet a body that another process kicks.
  void note_conflict(std::uint32_t group, std::uint32_t number) { conflicts_.emplace_back(group, number); }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_conflicts() {
    return std::exchange(conflicts_, {});
  }

 private:
  std::vector<std::uint32_t> checked_;  ///< groups, and those that have run since
  std::vector<std::uint32_t> unchecked_;
  std::vector<SweptSphereUpdate> foreign_;
  std::size_t checked_foreign_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts_;
};

}  // namespace kinesphere
