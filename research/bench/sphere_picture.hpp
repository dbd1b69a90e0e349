// A picture of shaded spheres in a box, as SVG.
#pragma once

#include <string>
#include <vector>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

struct DrawnSphere {
  Vec3 centre;
  double radius;
};

enum class SphereStyle {
  bodies,  ///< blue
  bounds,  ///< red
};

/// Seen in perspective from the front, a little from the right and from above, z upwards; far spheres are
/// paler and are painted first. About 40 bytes a sphere.
std::string sphere_picture(std::vector<DrawnSphere> spheres, const Box& box, SphereStyle style,
                           const std::string& caption);

}  // namespace kinesphere::program
