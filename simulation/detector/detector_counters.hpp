// What a detector has done so far.
#pragma once

#include <cstdint>

#include "kinesphere/counters.hpp"

namespace kinesphere {

/// What a world counts, and what only its rivals do. For detectors without certificates these are pair tests.
struct DetectorCounters : Counters {
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
  /// Times at which all space-time bounds were built anew (Hubbard's algorithm).
  std::uint64_t rebuilds = 0;
};

}  // namespace kinesphere
