// Time-varying bounds of bodies, with their swept boxes and the gaps between them.
#include "kinesphere/bound.hpp"

#include <cmath>

#include "bound/relative_motion.hpp"
#include "bound/rounding.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

Bound bound_of(const BodyDefinition& body, const State& state, double time) {
  Bound bound{.time = time,
              .position = state.position,
              .velocity = state.velocity,
              .planned_acceleration = body.planned_acceleration,
              .radius = body.radius + body.position_error,
              .growth_speed = body.velocity_error,
              .acceleration_limit = body.acceleration_limit};
  if (body.radius_rate != 0.0)
    bound.growth_speed = rounding::sum_up(body.velocity_error, std::abs(body.radius_rate));
  return bound;
}

namespace {

/// Upper bound of p + v s + 1/2 a s^2 over s in [s0, s1]. Precondition: 0 <= s0 <= s1.
double greatest(double p, double v, double a, double s0, double s1) {
  const auto at = [=](double s) { return p + (v + 0.5 * a * s) * s; };
  double top = std::max(at(s0), at(s1));
  if (a < 0.0) {
    const double vertex = -v / a;
    if (vertex > s0 && vertex < s1) top = std::max(top, at(vertex));
  }
  using rounding::widened;
  const double size = widened(std::abs(p)) + (widened(std::abs(v)) + widened(std::abs(a)) * s1) * s1;
  return size <= limits::largest_size ? top + size * rounding::margin : infinity;
}

/// Returns the limits of a gap, widened in either direction by `growth` and by the rounding margin of `size`.
GapLimits limits_around(double gap, double growth, double size) {
  if (!(size <= limits::largest_size)) return {.lower = -infinity, .upper = infinity};
  const double margin = rounding::margin * size;
  return {.lower = gap - growth - margin, .upper = gap + growth + margin};
}

}  // namespace

Box swept_box(const Bound& bound, double from, double to) {
  const double s0 = from - bound.time;
  const double s1 = to - bound.time;
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = bound.position[axis];
    const double v = bound.velocity[axis];
    const double g = bound.planned_acceleration[axis];
    box.upper[axis] =
        greatest(p + bound.radius, v + bound.growth_speed, g + bound.acceleration_limit, s0, s1);
    box.lower[axis] =
        -greatest(bound.radius - p, bound.growth_speed - v, bound.acceleration_limit - g, s0, s1);
  }
  return box;
}

GapLimits gap_limits(const Bound& a, const Bound& b, double t) {
  const RelativeMotion motion(a, b, t);
  return limits_around(norm(motion.offset) - motion.radii, motion.growth, motion.offset_size);
}

GapLimits gap_limits(const Bound& bound, const HalfSpace& wall, double t) {
  const double s = t - bound.time;
  const double growth = (bound.growth_speed + 0.5 * bound.acceleration_limit * s) * s;
  const double gap = dot(wall.normal, bound.centre_at(t)) - wall.offset - bound.radius;
  using rounding::widened;
  const double size = widened(norm_one(bound.position) + bound.radius) +
                      (widened(norm_one(bound.velocity) + bound.growth_speed) +
                       widened(norm_one(bound.planned_acceleration) + bound.acceleration_limit) * s) *
                          s +
                      std::abs(wall.offset);
  return limits_around(gap, growth, size);
}

}  // namespace kinesphere
