// Kicked bodies of islands that have run side by side, held against each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/speculation_log.hpp"
#include "engine/world_state.hpp"
#include "number/infinity.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

/// A kick, and whose it is: of the group at this place, or another process's (BatchState::unassigned).
struct ClusterUpdate {
  std::uint32_t cluster;
  const SweptSphereUpdate* update;
};

/// Two kicks, by their places.
struct Conflict {
  /// In place of a time: it would take to run both islands as one to know it.
  static constexpr double unknown = -infinity;

  std::uint32_t first;
  std::uint32_t second;
  /// When the two may first meet: what Facts::apart_until() finds at the later kick.
  double until;
  /// The earlier one was void when the later one came.
  bool is_stale;
};

/// Pairs of kicks of different groups whose bodies may meet while both windows last; at least one of each
/// pair is among the first `fresh` kicks. Kicks are searched for as if each had been there from `begin` on.
/// Cost: as of a window's start for the fresh ones, and a search for each of the others.
std::vector<Conflict> find_conflicts(const WorldState& tables, std::span<const ClusterUpdate> updates,
                                     std::size_t fresh, double begin, PoolLease& shift);

}  // namespace kinesphere
