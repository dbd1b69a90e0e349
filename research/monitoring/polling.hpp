// The number of reports it takes to keep every pair of a recording decided.
#pragma once

#include <cstdint>

#include "research/monitoring/recorded_sky.hpp"

namespace kinesphere {

struct PollingSettings {
  double distance = 1.0;
  double tolerance = 0.5;
  double window = 1.0;
};

struct Polling {
  std::uint64_t reports = 0;    ///< includes the first report of each track
  double undecided_time = 0.0;  ///< sum over pairs
};

/// Polls the tracks that a monitor asks for.
Polling poll_when_needed(const RecordedSky& sky, const PollingSettings& settings);
/// Polls all tracks at the multiples of `interval`.
Polling poll_everybody(const RecordedSky& sky, const PollingSettings& settings, double interval);
/// Returns a lower bound on the reports of any method that relies on the same classes of tracks. Each track
/// is polled only when its own bound leaves a pair undecided, with the true places of all others known. Times
/// are multiples of `step`, so a poll may be late by up to `step`. Cost: some seconds for a thousand tracks.
std::uint64_t polling_floor(const RecordedSky& sky, const PollingSettings& settings, double step);

}  // namespace kinesphere
