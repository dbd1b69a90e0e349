// The true approaches of satellites: all pairs, at all times, by brute force. They follow from positions and
// velocities of the paths and from bounds on their acceleration, independently of the monitor.
#pragma once

#include <vector>

#include "research/satellites/satellite_approach.hpp"
#include "research/satellites/satellite_motion.hpp"

namespace kinesphere {

/// Returns all spans from 0 to `until` in which two satellites certainly are closer than `distance` (km),
/// sorted by pair and begin. At all other times a pair is farther apart, or closer by less than 3e-5 km.
/// Cost: for each arc, a nanosecond for each pair with overlapping ranges of distances from the earth.
std::vector<SatelliteApproach> true_approaches(SatelliteMotion motion, double until, double distance);

/// Returns those of `approaches` in which the two are not closer than `distance` (km) all the time, or closer
/// by less than 3e-5 km.
std::vector<SatelliteApproach> not_within(SatelliteMotion motion, std::vector<SatelliteApproach> approaches,
                                          double distance);

}  // namespace kinesphere
