// The fixed-step detectors that are to be beaten: structure of arrays, sorted strips, Verlet lists.
#pragma once

#include "research/bench/speed/step_kernel.hpp"
#include "research/bench/speed/strip_grid.hpp"
#include "research/bench/speed/verlet_list.hpp"

namespace kinesphere::program {

/// Sorts all spheres anew at each step.
std::unique_ptr<StepKernel> make_grid_kernel(std::vector<float> radii, const StripSettings& settings,
                                             SphereTest test);
/// Keeps a list of the pairs that are near.
std::unique_ptr<StepKernel> make_verlet_kernel(std::vector<float> radii, const VerletSettings& settings,
                                               SphereTest test);

}  // namespace kinesphere::program
