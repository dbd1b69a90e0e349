// Bounds of bodies, and the boxes and gaps that follow from them.
#include "kinesphere/bound.hpp"

#include "bound/relative_motion.hpp"
#include "bound/rounding.hpp"

namespace kinesphere {

Bound bound_of(const BodyDefinition& body, const State& state, double time) {
  return {.time = time,
          .position = state.position,
          .velocity = state.velocity,
          .planned_acceleration = body.planned_acceleration,
          .radius = body.radius + body.position_error,
          .growth_speed = body.velocity_error,
          .growth_acceleration = body.acceleration_limit};
}

namespace {

/// Upper bound of p + v s + 1/2 a s^2 over [s0, s1], 0 <= s0 <= s1.
double greatest(double p, double v, double a, double s0, double s1) {
  const auto at = [=](double s) { return p + (v + 0.5 * a * s) * s; };
  double top = std::max(at(s0), at(s1));
  if (a < 0.0) {
    const double vertex = -v / a;
    if (vertex > s0 && vertex < s1) top = std::max(top, at(vertex));
  }
  const double size = std::abs(p) + (std::abs(v) + std::abs(a) * s1) * s1;
  return top + size * rounding::margin;
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
        greatest(p + bound.radius, v + bound.growth_speed, g + bound.growth_acceleration, s0, s1);
    box.lower[axis] =
        -greatest(bound.radius - p, bound.growth_speed - v, bound.growth_acceleration - g, s0, s1);
  }
  return box;
}

GapLimits gap_limits(const Bound& a, const Bound& b, double t) {
  const RelativeMotion motion(a, b, t);
  const double margin = rounding::margin * motion.offset_size;
  const double gap = norm(motion.offset) - motion.radii;
  return {.lower = gap - motion.growth - margin, .upper = gap + motion.growth + margin};
}

GapLimits gap_limits(const Bound& bound, const HalfSpace& wall, double t) {
  const double s = t - bound.time;
  const double growth = (bound.growth_speed + 0.5 * bound.growth_acceleration * s) * s;
  const double gap = dot(wall.normal, bound.centre_at(t)) - wall.offset - bound.radius;
  const double size = norm_one(bound.position) + norm_one(bound.velocity) * s +
                      norm_one(bound.planned_acceleration) * (s * s) + bound.radius + growth +
                      std::abs(wall.offset);
  const double margin = rounding::margin * size;
  return {.lower = gap - growth - margin, .upper = gap + growth + margin};
}

}  // namespace kinesphere
