// The true places of the balls of bounds, in extended precision, and whether two of them meet.
#pragma once

#include <array>
#include <cmath>

#include "kinesphere/bound.hpp"

namespace kinesphere {

using Extended = long double;

struct TrueBall {
  std::array<Extended, 3> centre;
  Extended radius;
};

inline TrueBall true_ball(const Bound& bound, Extended time) {
  const Extended s = time - static_cast<Extended>(bound.time);
  TrueBall ball{};
  for (int axis = 0; axis < 3; ++axis) {
    const Extended velocity = bound.velocity[axis], acceleration = bound.planned_acceleration[axis];
    ball.centre[static_cast<std::size_t>(axis)] =
        static_cast<Extended>(bound.position[axis]) + (velocity + acceleration * s / 2) * s;
  }
  const Extended speed = bound.growth_speed, growth = bound.acceleration_limit;
  ball.radius = static_cast<Extended>(bound.radius) + (speed + growth * s / 2) * s;
  return ball;
}

/// Returns the gap between two balls, the second one moved by a shift; negative if they overlap.
inline Extended true_gap(const TrueBall& a, const TrueBall& b, const Vec3& shift = {}) {
  Extended square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const Extended way = b.centre[k] + static_cast<Extended>(shift[axis]) - a.centre[k];
    square += way * way;
  }
  return std::sqrt(square) - a.radius - b.radius;
}

/// Returns the least gap between two bounds from one time to another: exact for bounds that go straight on
/// and do not grow, else the least of some samples.
inline Extended least_true_gap(const Bound& a, const Bound& b, double from, double until,
                               const Vec3& shift = {}) {
  const Extended duration = static_cast<Extended>(until) - static_cast<Extended>(from);
  const TrueBall a_first = true_ball(a, from), b_first = true_ball(b, from);
  Extended xv = 0, vv = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const Extended x = b_first.centre[k] + static_cast<Extended>(shift[axis]) - a_first.centre[k];
    const Extended v =
        static_cast<Extended>(b.velocity_at(from)[axis]) - static_cast<Extended>(a.velocity_at(from)[axis]);
    xv += x * v;
    vv += v * v;
  }
  const auto gap_after = [&](Extended d) {
    const Extended t = static_cast<Extended>(from) + d;
    return true_gap(true_ball(a, t), true_ball(b, t), shift);
  };
  const Extended nearest = vv > 0 ? std::min(std::max(-xv / vv, Extended{0}), duration) : Extended{0};
  Extended least = std::min({true_gap(a_first, b_first, shift), gap_after(duration), gap_after(nearest)});
  const bool straight = a.planned_acceleration == Vec3{} && b.planned_acceleration == Vec3{} &&
                        a.growth_speed + b.growth_speed == 0.0 &&
                        a.acceleration_limit + b.acceleration_limit == 0.0;
  constexpr int samples = 8;
  for (int k = 1; !straight && k < samples; ++k) least = std::min(least, gap_after(duration * k / samples));
  return least;
}

}  // namespace kinesphere
