// Places and velocities as a moving body sees them.
#pragma once

#include <optional>

#include "kinesphere/vec3.hpp"

namespace kinesphere::program {

/// Three directions at a right angle to each other, of length 1.
struct LocalAxes {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  /// Returns the components of a vector.
  Vec3 components(const Vec3& vector) const { return {dot(vector, x), dot(vector, y), dot(vector, z)}; }
};

/// The frame of a moving body: along its velocity (x), to the right of that and level (y), and upward at a
/// right angle to both (z), so in the vertical plane of the velocity.
struct OwnFrame {
  Vec3 along;
  std::optional<Vec3> right, up;  ///< empty if the body moves vertically
};

/// Returns the frame of a body with this velocity where `vertical` (of length 1) is upward; nothing for a
/// body at rest: one with at most a billionth of `other_speed`.
std::optional<OwnFrame> own_frame(const Vec3& velocity, const Vec3& vertical, double other_speed);

}  // namespace kinesphere::program
