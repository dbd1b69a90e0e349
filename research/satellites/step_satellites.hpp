// Approaches as fixed steps see them: pairs of satellites that are close at the multiples of a time.
#pragma once

#include <vector>

#include "research/satellites/satellite_approach.hpp"
#include "research/satellites/satellite_motion.hpp"

namespace kinesphere {

/// Returns approaches sorted by pair and begin: each from the first to the last of successive steps at which
/// the two are within the distance (km). Steps are at times 0, step, ... up to `until` (s). Cost of a step:
/// about 0.1 us for each satellite.
std::vector<SatelliteApproach> step_satellites(SatelliteMotion motion, double until, double distance,
                                               double step);

}  // namespace kinesphere
