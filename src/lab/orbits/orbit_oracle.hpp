// The truth about approaches of satellites: all pairs, at all times, by brute force. It rests upon the paths'
// positions and velocities, and upon how much they accelerate at most; nothing of the monitor's is in it.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/orbits/orbit.hpp"
#include "lab/orbits/orbit_approach.hpp"

namespace kinesphere {

/// All that certainly is closer than `distance` from time `begin` to `end`, by pair and begin. What is left
/// out is farther apart, or closer by less than 3e-5 km, for certain. Cost: some seconds for 10^9 times a
/// pair of satellites whose distances from the earth overlap and two minutes.
std::vector<OrbitApproach> true_approaches(const std::vector<Orbit>& orbits, double begin, double end,
                                           double distance);

/// Whether the two are within the distance all the time. They are not, or by less than 3e-5 km, if it is
/// false.
bool are_within(const Orbit& a, const Orbit& b, double begin, double end, double distance);

}  // namespace kinesphere
