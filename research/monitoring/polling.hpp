// How many reports it takes to keep every pair of a recording decided.
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
  std::uint64_t reports = 0;    ///< those with which tracks begin too
  double undecided_time = 0.0;  ///< the sum over pairs
};

/// A monitor asks when it has to.
Polling poll_when_needed(const RecordedSky& sky, const PollingSettings& settings);
/// Everybody is asked at the multiples of a time.
Polling poll_everybody(const RecordedSky& sky, const PollingSettings& settings, double interval);
/// No method that rests upon the same promises can do with less: each track is asked only when, with the true
/// places of all others known, its own bound leaves a pair undecided. Looks at multiples of `step`, and so
/// asks late by up to that. Cost: some seconds for a thousand tracks.
std::uint64_t polling_floor(const RecordedSky& sky, const PollingSettings& settings, double step);

}  // namespace kinesphere
