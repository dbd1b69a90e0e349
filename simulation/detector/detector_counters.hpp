// Counts of the work that a detector has done so far.
#pragma once

#include <cstdint>

#include "kinesphere/counters.hpp"

namespace kinesphere {

/// DetectorCounters adds to the counters of a world what only its rivals count. In detectors without
/// certificates, `certificates` counts pair tests.
struct DetectorCounters : Counters {
  /// Events of the paper's algorithm: a bound touched a cell (entering), left one (leaving), outgrew its
  /// cells (resetting), met another bound or a wall (colliding).
  std::uint64_t entering = 0;
  std::uint64_t leaving = 0;
  std::uint64_t resetting = 0;
  std::uint64_t colliding = 0;
  /// Event tree of the paper's algorithm: candidates inserted, candidates removed before they were due, and
  /// the largest number it ever held.
  std::uint64_t event_insertions = 0;
  std::uint64_t event_removals = 0;
  std::uint64_t largest_queue = 0;
  /// Times at which Hubbard's algorithm rebuilt all space-time bounds.
  std::uint64_t rebuilds = 0;
};

}  // namespace kinesphere
