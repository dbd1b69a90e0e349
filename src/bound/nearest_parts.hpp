// Geometry of a contact of rigid bodies: their nearest parts, as events describe them.
#pragma once

#include <cstdint>
#include <span>

#include "bound/rigid_extent.hpp"
#include "kinesphere/rigid_body.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// A rigid body at one time.
struct RigidPose {
  Vec3 position;
  Quaternion orientation;
  std::span<const RigidPart> parts;
  std::span<const PartBall> balls;  ///< around the parts
};

/// The pair of parts with the least gap; of equally near ones the first.
struct NearestParts {
  double gap;   ///< between their surfaces (length); not less than minus the sum of their radii
  Vec3 normal;  ///< unit vector from the first body towards the second
  Vec3 point;   ///< midpoint of the gap
  double arm;   ///< distance between the nearest points of their axes (length)
  std::uint32_t first_part = 0;
  std::uint32_t second_part = 0;  ///< of a mesh, the triangle
};

NearestParts nearest_parts(const RigidPose& first, const RigidPose& second);
/// Returns the part that is nearest to a shape at rest. The gap to a half-space, and that of a ball to
/// a box, may be less than minus the radius of the part.
template <class Solid>
NearestParts nearest_parts(const RigidPose& first, const Solid& second);
NearestParts nearest_parts(const RigidPose& first, const Mesh& second);

}  // namespace kinesphere
