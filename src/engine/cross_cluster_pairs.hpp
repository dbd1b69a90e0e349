// Pairs of which two islands have one body each, and which are due when the part is over.
#pragma once

#include <cstdint>
#include <vector>

#include "broadphase/certificate_queue.hpp"
#include "engine/clusters.hpp"

namespace kinesphere {

class CrossClusterPairs {
 public:
  void clear() { entries_.clear(); }
  /// Two kicked bodies that have to be looked at then, if neither is kicked again in the part: as these
  /// attempts of the two groups have it.
  void note(const Cluster& one, const Cluster& other, const PairCertificate& pair) {
    entries_.push_back({one.index, one.runs, other.index, other.runs, pair});
  }
  /// Calls visit(pair) for each of which none of the two groups has been taken back since.
  template <class Visit>
  void for_each_standing(const Clusters& groups, Visit visit) const {
    const auto stands = [&](std::uint32_t own, std::uint32_t attempt) {
      const Cluster& group = groups[own];
      return !group.is_merged() && group.executed && group.runs == attempt;
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
