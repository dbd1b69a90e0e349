// What a detector has done so far: the figures behind every summary.
#pragma once

#include <array>
#include <cstdint>

#include "kinesphere/event.hpp"

namespace kinesphere {

struct Counters {
  /// Events delivered, by EventKind.
  std::array<std::uint64_t, event_kind_count> events{};
  /// States asked for, one per body and call.
  std::uint64_t probes = 0;
  /// Scheduled times that came due, and those of them that found nothing left to do.
  std::uint64_t wakes = 0;
  std::uint64_t stale_wakes = 0;
  /// Why a body woke: its box ran out, a certificate of a pair did, a wall came within reach.
  std::uint64_t box_ends = 0;
  std::uint64_t pair_checks = 0;
  std::uint64_t wall_checks = 0;
  /// Searches of the grid, and candidate pairs they gave.
  std::uint64_t searches = 0;
  std::uint64_t candidates = 0;
  /// Pair certificates computed (for other detectors: pair tests).
  std::uint64_t certificates = 0;
  /// Looks at a contact that the Zeno guard put off to the smallest step.
  std::uint64_t zeno_steps = 0;
  /// Contacts that came within the Zeno interval of an earlier one of the same body.
  std::uint64_t repeated_contacts = 0;
  /// What came to pass in the paper's algorithm: a bound touched a cell, parted from one, outgrew its cells,
  /// met another bound or a wall.
  std::uint64_t entering = 0;
  std::uint64_t leaving = 0;
  std::uint64_t resetting = 0;
  std::uint64_t colliding = 0;
  /// Its event tree: candidates inserted, candidates removed before they came to pass, and the most it ever
  /// held.
  std::uint64_t event_insertions = 0;
  std::uint64_t event_removals = 0;
  std::uint64_t largest_queue = 0;
  /// Times at which all space-time bounds were built anew (Hubbard's algorithm), and crossings of their faces
  /// that its sweeps came to.
  std::uint64_t rebuilds = 0;
  std::uint64_t crossings = 0;

  std::uint64_t count(EventKind kind) const { return events[static_cast<std::size_t>(kind)]; }
};

}  // namespace kinesphere
