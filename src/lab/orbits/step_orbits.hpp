// Approaches as fixed steps see them: where all satellites are at the multiples of a time, and who is close
// to whom then.
#pragma once

#include <vector>

#include "lab/orbits/orbit.hpp"
#include "lab/orbits/orbit_approach.hpp"

namespace kinesphere {

/// By pair and begin: from the first to the last of successive steps at which the two are within the
/// distance. At times 0, step, ... up to `until`. Cost of a step: about 0.1 us for each satellite, and a
/// sort.
std::vector<OrbitApproach> step_orbits(const std::vector<Orbit>& orbits, double until, double distance,
                                       double step);

}  // namespace kinesphere
