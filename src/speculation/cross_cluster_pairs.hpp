// CrossClusterPairs collects certificates between bodies of two clusters that are due after the batch.
#pragma once

#include <cstdint>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "speculation/clusters.hpp"

namespace kinesphere {

class CrossClusterPairs {
 public:
  void clear() { entries_.clear(); }
  /// Records a pair of updated bodies to be rechecked after the batch. It is valid only for the current runs
  /// of both clusters.
  void note(const Cluster& one, const Cluster& other, const PairCertificate& pair) {
    entries_.push_back({one.index, one.runs, other.index, other.runs, pair});
  }
  /// Calls visit(pair) for each pair of which neither cluster has been rolled back or merged since note().
  template <class Visit>
  void for_each_standing(const Clusters& clusters, Visit visit) const {
    const auto stands = [&](std::uint32_t index, std::uint32_t run) {
      const Cluster& cluster = clusters[index];
      return !cluster.is_merged() && cluster.executed && cluster.runs == run;
    };
    for (const Entry& late : entries_)
      if (stands(late.one, late.run_of_one) && stands(late.other, late.run_of_other)) visit(late.pair);
  }

 private:
  struct Entry {
    std::uint32_t one;
    std::uint32_t run_of_one;
    std::uint32_t other;
    std::uint32_t run_of_other;
    PairCertificate pair;
  };
  std::vector<Entry> entries_;
};

}  // namespace kinesphere
