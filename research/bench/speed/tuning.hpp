// Settings of hand-tuned detectors, chosen by trying, as their users do.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "research/bench/speed/step_recording.hpp"
#include "research/bench/speed/tuned_kernels.hpp"

namespace kinesphere::program {

/// Returns (volume of the bodies' bounding box / their number)^(1/3), without axes on which they do not
/// differ.
double mean_distance(const std::vector<State>& states);

StripSettings usual_strips(double mean_distance);

using KernelMaker = std::function<std::unique_ptr<StepKernel>()>;

/// Time and findings of a kernel on recorded steps.
struct StepTiming {
  double seconds = 0.0;     ///< CPU time
  std::uint64_t found = 0;  ///< pairs, and bodies at walls, summed over steps
  std::uint64_t hash = 0;   ///< hash of what was found and of the steps, in any order
  std::size_t bytes = 0;
};

/// Runs a kernel and the test of walls on the first `steps` steps of the recording.
StepTiming time_steps(const StepRecording& recording, StepKernel& kernel, std::size_t steps);

/// Returns the fastest of several grids and skins, each tried on the first steps of the recording.
KernelMaker tuned_kernel(const StepRecording& recording);
/// Returns Bullet's trees with the fastest of several margins; empty if there is no Bullet.
KernelMaker tuned_bullet_kernel(const StepRecording& recording);

}  // namespace kinesphere::program
