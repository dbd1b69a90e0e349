#include "monitor/straight_pass.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

StraightPass straight_pass(const State& first, const State& second, const Components& separation,
                           double now) {
  StraightPass pass{.begin = now};
  const Component& nearest = *separation.begin();
  for (const Component& component : separation) {
    const Vec3 offset = component.part(first.position - second.position);
    const Vec3 velocity = component.part(first.velocity - second.velocity);
    const double v2 = norm_squared(velocity), xv = dot(offset, velocity);
    if (&component == &nearest) {
      const double nearest_after = v2 > 0.0 ? std::max(0.0, -xv / v2) : 0.0;
      pass.closest_time = now + nearest_after;
      pass.closest_distance = norm(offset + velocity * nearest_after);
    }
    const double c = norm_squared(offset) - component.limit * component.limit;
    const double discriminant = xv * xv - v2 * c;
    if (c > 0.0 && !(xv < 0.0 && discriminant >= 0.0)) {
      pass.begin = infinity;
      continue;
    }
    const double root = std::sqrt(std::max(0.0, discriminant));
    if (c > 0.0) pass.begin = std::max(pass.begin, now + c / (root - xv));
    if (v2 > 0.0) pass.end = std::min(pass.end, now + (root - xv) / v2);
  }
  if (pass.begin > pass.end) pass.begin = infinity;
  if (pass.begin == infinity) pass.end = infinity;
  return pass;
}

}  // namespace kinesphere
