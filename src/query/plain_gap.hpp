// Gaps for the audit, by plain formulas of their own: nothing here is shared with the certificates that are
// held against them, and everything is computed with more digits where the machine has them.
#pragma once

#include <array>

#include "engine/collision_shape.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Two bodies whose bounds are known, or a body and a shape at rest. Where space repeats it is about their
/// images that are nearest at the time asked for.
class PlainGap {
 public:
  /// At most one of the two has a shape. `period` is zero on axes that do not repeat.
  PlainGap(const CollisionShape& a, const CollisionShape& b, const Vec3& period);

  /// At a time no earlier than both reports; each is a limit of the exact number.
  struct Limits {
    double lower;
    double upper;
  };
  /// Of the gap of the two bounds, radii as large as they have become: no bodies in them are nearer.
  Limits of_bounds(double time) const;
  /// Of the largest gap that two bodies in these bounds can have.
  Limits at_farthest(double time) const;
  /// Of the gap of two bodies in these bounds, wherever they are.
  Limits of_bodies(double time) const;

  /// How fast these gaps change between two times, at most.
  double largest_speed(double from, double to) const;
  /// A length that motion from the reports to this time may be uncertain by: reports that differ by no more
  /// from what was promised are no broken promise.
  double uncertainty(double time) const;

 private:
  Limits distance(double time) const;
  Limits of_bounds(double time, const Limits& distance) const;
  Limits at_farthest(double time, const Limits& distance) const;
  double radii() const;
  double growth(double time) const;

  const Bound& moving_;
  const Bound& other_;
  const Shape* shape_;
  Vec3 period_;
};

}  // namespace kinesphere
