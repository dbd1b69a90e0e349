// Trajectory: exact motion as consecutive cubic segments.
#pragma once

#include <vector>

#include "kinesphere/body.hpp"

namespace kinesphere {

/// Motion during [begin, end]: with s = t - begin,
///   x(t) = position + velocity s + 1/2 acceleration s^2 + 1/6 jerk s^3.
struct Segment {
  double begin = 0.0;
  double end = 0.0;
  Vec3 position{};
  Vec3 velocity{};
  Vec3 acceleration{};
  Vec3 jerk{};

  /// Returns position and velocity at time t.
  State state_at(double t) const;
  /// Returns the acceleration at time t.
  [[gnu::always_inline]] Vec3 acceleration_at(double t) const { return acceleration + jerk * (t - begin); }

  friend constexpr bool operator==(const Segment&, const Segment&) = default;
};

/// Consecutive segments: each begins where the one before it ends.
using Trajectory = std::vector<Segment>;

}  // namespace kinesphere
