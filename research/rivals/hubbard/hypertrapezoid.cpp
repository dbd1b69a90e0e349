// The faces of a hypertrapezoid, rounded outward.
#include "research/rivals/hubbard/hypertrapezoid.hpp"

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"

namespace kinesphere {
namespace {

/// A coordinate beyond this stands for all of space (length). Sums of several such do not overflow.
constexpr double everywhere = 0x1p1000;

/// Returns a line above p + radius + (v + growth) s + 1/2 (g + limit) s^2 for 0 <= s <= duration. Called for
/// the other side (with p, v and g negated), it returns a line that is at least as high and rises at least as
/// fast as the negated line of this side, because rounding is monotone: the two faces of a body never cross.
inline Line line_above(const Bound& bound, double p, double v, double g, double duration, double clearance) {
  const double curvature = g + bound.acceleration_limit;
  const double speed = (v + bound.growth_speed) + curvature * (0.5 * duration);
  const double bulge = (std::max(0.0, -curvature) * duration) * (0.125 * duration);
  const double way =
      (std::abs(v) + bound.growth_speed + (std::abs(g) + bound.acceleration_limit) * duration) * duration;
  const double size = std::abs(p) + bound.radius + way;
  const double start = (p + bound.radius) + (bulge + (clearance + rounding::margin * size));
  if (!(size + clearance < everywhere)) return {everywhere, 0.0};
  return {start, speed};
}

}  // namespace

Hypertrapezoid enclose(const Bound& bound, double duration, double clearance) {
  Hypertrapezoid result;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = bound.position[axis];
    const double v = bound.velocity[axis];
    const double g = bound.planned_acceleration[axis];
    const auto k = static_cast<std::size_t>(axis);
    const Line below = line_above(bound, -p, -v, -g, duration, clearance);
    result.upper[k] = line_above(bound, p, v, g, duration, clearance);
    result.lower[k] = {-below.start, -below.speed};
  }
  return result;
}

}  // namespace kinesphere
