// The fixed-step detectors to be beaten: structure of arrays, sorted strips, Verlet lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "research/bench/speed/step_kernel.hpp"
#include "research/bench/speed/strip_grid.hpp"

namespace kinesphere::program {

struct VerletSettings {
  StripSettings grid;
  /// Way that each sphere may move from its place in the list: `skin` (length) and `steps` steps as long as
  /// the last.
  float skin;
  float steps;
};

/// Makes a detector that sorts all spheres at each step.
std::unique_ptr<StepKernel> make_grid_kernel(std::vector<float> radii, const StripSettings& settings,
                                             SphereTest test);
/// Makes a detector that keeps a list of the pairs that are near.
std::unique_ptr<StepKernel> make_verlet_kernel(std::vector<float> radii, const VerletSettings& settings,
                                               SphereTest test);

}  // namespace kinesphere::program
