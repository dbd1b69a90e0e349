// Comparison of the swept-sphere updates of clusters that were executed concurrently.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"
#include "processor/speculation_log.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// An update and the index of its cluster; BatchState::unassigned if another process made it.
struct ClusterUpdate {
  std::uint32_t cluster;
  const SweptSphereUpdate* update;
};

/// Two updates that may meet, by their indices.
struct Conflict {
  /// Replaces a time that only a joint execution of both clusters could find.
  static constexpr double unknown = -infinity;

  std::uint32_t first;
  std::uint32_t second;
  /// Earliest time at which the bodies may meet, from apart_until() at the later update.
  double until;
  /// True if the earlier update was invalidated before the later one was made.
  bool is_stale;
};

/// Returns the pairs of updates of different clusters whose bodies may meet while both windows last. At least
/// one of each pair is among the first `fresh` updates. Each update is searched for as if it existed from
/// `begin` on. Cost: a window start for the fresh updates, plus one search for each other update.
std::vector<Conflict> find_conflicts(const WorldState& state, std::span<const ClusterUpdate> updates,
                                     std::size_t fresh, double begin, PoolLease& lease);

}  // namespace kinesphere
