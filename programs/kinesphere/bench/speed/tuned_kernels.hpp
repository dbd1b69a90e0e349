// The fixed-step detectors that are to be beaten: structure of arrays, sorted strips, Verlet lists.
#pragma once

#include "bench/speed/step_kernel.hpp"
#include "bench/speed/strip_grid.hpp"

namespace kinesphere::program {

/// Sorts all spheres anew at each step.
std::unique_ptr<StepKernel> make_grid_kernel(std::vector<float> radii, const StripSettings& settings,
                                             SphereTest test);
/// Keeps a list of the pairs that are nearer than `skin` > 0 (length).
std::unique_ptr<StepKernel> make_verlet_kernel(std::vector<float> radii, const StripSettings& settings,
                                               float skin, SphereTest test);

}  // namespace kinesphere::program
