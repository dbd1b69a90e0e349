// The truth about approaches of satellites: all pairs, at all times, by brute force. It rests upon the paths'
// positions and velocities, and upon how much they accelerate at most; nothing of the monitor's is in it.
#pragma once

#include <vector>

#include "research/satellites/satellite_approach.hpp"
#include "research/satellites/satellite_motion.hpp"

namespace kinesphere {

/// All times from 0 to `until` at which two certainly are closer than `distance` (km), by pair and begin: at
/// all others they are farther apart, or closer by less than 3e-5 km. Cost: for each arc, a nanosecond for
/// each pair whose distances from the earth overlap.
std::vector<SatelliteApproach> true_approaches(SatelliteMotion motion, double until, double distance);

/// Those of `approaches` in which the two are not closer than `distance` all the time, or closer by less than
/// 3e-5 km.
std::vector<SatelliteApproach> not_within(SatelliteMotion motion, std::vector<SatelliteApproach> approaches,
                                          double distance);

}  // namespace kinesphere
