// Approaches as fixed steps see them: where all satellites are at the multiples of a time, and who is close
// to whom then.
#pragma once

#include <vector>

#include "research/satellites/satellite_approach.hpp"
#include "research/satellites/satellite_motion.hpp"

namespace kinesphere {

/// By pair and begin: from the first to the last of successive steps at which the two are within the distance
/// (km). Steps are at times 0, step, ... up to `until`. Cost of a step: about 0.1 us for each satellite.
std::vector<SatelliteApproach> step_satellites(SatelliteMotion motion, double until, double distance,
                                               double step);

}  // namespace kinesphere
