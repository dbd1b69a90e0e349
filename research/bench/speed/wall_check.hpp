// Search for spheres that reach over a wall of the box.
#pragma once

#include <cstdint>
#include <vector>

#include "kinesphere/vec3.hpp"
#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {

/// Appends the bodies that reach over a wall, in order.
void find_at_walls(const Frame& now, const std::vector<float>& radii, const Box& box,
                   std::vector<std::uint32_t>& found);

}  // namespace kinesphere::program
