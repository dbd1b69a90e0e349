// Places and velocities as a moving body sees them.
#include "tracks/own_frame.hpp"

namespace kinesphere::program {

std::optional<OwnFrame> own_frame(const Vec3& velocity, const Vec3& vertical, double other_speed) {
  constexpr double at_rest = 1e-9;
  const double speed = norm(velocity);
  if (!(speed > at_rest * other_speed)) return std::nullopt;
  OwnFrame frame{.along = velocity / speed, .right = {}, .up = {}};
  const Vec3 level = cross(frame.along, vertical);
  const double slant = norm(level);
  if (!(slant > at_rest)) return frame;
  frame.right = level / slant;
  frame.up = cross(*frame.right, frame.along);
  return frame;
}

}  // namespace kinesphere::program
