// Lengths on the ground.
#pragma once

#include <cmath>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Returns the length of a vector without its height.
inline double flat_length(const Vec3& way) { return std::hypot(way.x, way.y); }

}  // namespace kinesphere::program
