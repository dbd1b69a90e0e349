// Turns any bytes into a sky: tracks that keep their limits, reports of them, and a monitor that is never
// wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace kinesphere::watched_sky {

struct WatchedSky {
  std::optional<std::string> failure;  ///< forbidden behaviour of the monitor
  std::size_t reports = 0;
  std::size_t events = 0;
  std::size_t certain = 0;     ///< checked verdicts that were not `undecided`
  std::size_t promised = 0;    ///< verdicts that an earlier answer had certified
  std::size_t inevitable = 0;  ///< answers by when the two certainly are within
  std::size_t plans = 0;       ///< plans beyond the limits of the class
  std::size_t wrong = 0;       ///< reports that were wrong
  std::size_t removed = 0;     ///< tracks that were removed; most of them report again
  std::size_t reclassified = 0;
};

/// The bytes choose a definition, the true motion of up to six tracks, and a course: reports that are noisy,
/// late, early, repeated, without velocities or wrong, with plans, with inexact timestamps and of other
/// classes than before; times to advance to, with and without a poll; tracks that are removed or become too
/// old, and report again; snapshots taken and restored. Cost: about a millisecond for a thousand bytes.
WatchedSky watch_sky(std::span<const std::uint8_t> bytes);

}  // namespace kinesphere::watched_sky
