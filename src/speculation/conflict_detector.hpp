// ConflictDetector tracks which swept-sphere updates have been compared with the updates of all other
// clusters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "speculation/conflicts.hpp"
#include "speculation/run_pool.hpp"

namespace kinesphere {

class ConflictDetector {
 public:
  /// Resets the detector; call at the start of a batch.
  void clear();
  /// Records that these clusters have been executed.
  void note_runs(std::span<const std::uint32_t> clusters) {
    unchecked_.insert(unchecked_.end(), clusters.begin(), clusters.end());
  }
  /// Adds an update of a body that another process executes.
  void add_foreign(const SweptSphereUpdate& update) { foreign_.push_back(update); }
  bool has_new_foreign() const { return checked_foreign_ < foreign_.size(); }
  /// Collects the updates of all executed clusters and of other processes. The first ones, whose number is
  /// returned, have not been compared yet and count as compared afterwards. Leaves `updates` empty if there
  /// are none.
  std::size_t take(Clusters& clusters, const RunPool& pool, std::vector<ClusterUpdate>& updates);

  /// Records that a cluster may meet a body whose velocity another process changes.
  void note_conflict(std::uint32_t cluster, std::uint32_t number) {
    conflicts_.emplace_back(cluster, number);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> take_conflicts() {
    return std::exchange(conflicts_, {});
  }

 private:
  std::vector<std::uint32_t> checked_;  ///< indices of clusters, possibly executed again since
  std::vector<std::uint32_t> unchecked_;
  std::vector<SweptSphereUpdate> foreign_;
  std::size_t checked_foreign_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts_;
};

}  // namespace kinesphere
