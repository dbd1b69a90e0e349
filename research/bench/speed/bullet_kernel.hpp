// Bullet's broad phase as a fixed-step detector, if Bullet is installed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// Makes Bullet's btDbvtBroadphase. `margin` (length) widens the boxes in its trees; the default is Bullet's
/// own. Returns nullptr if this program was built without Bullet.
std::unique_ptr<StepKernel> make_bullet_kernel(std::vector<float> radii,
                                               std::optional<float> margin = std::nullopt);

}  // namespace kinesphere::program
