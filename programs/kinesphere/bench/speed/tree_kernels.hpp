// Broad phases of others, followed by the same sphere test, where their libraries are installed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// Bullet's btDbvtBroadphase; `margin` (length) widens the boxes in its trees, the default is Bullet's own.
/// Nothing when this program was built without Bullet.
std::unique_ptr<StepKernel> make_bullet_kernel(std::vector<float> radii,
                                               std::optional<float> margin = std::nullopt);

/// FCL's DynamicAABBTreeCollisionManager. Nothing when this program was built without FCL.
std::unique_ptr<StepKernel> make_fcl_kernel(std::vector<float> radii);

}  // namespace kinesphere::program
