// Gaps for the audit, by independent formulas: no code is shared with the certificates under test, and
// everything is computed in long double, where that has more digits.
#pragma once

#include "bodies/collision_shape.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Gap between two bodies with bounds, or between a body and a shape, at rest or carried. In periodic space,
/// the images nearest to each other at the requested time are used. Holds references to the arguments of the
/// constructor.
class PlainGap {
 public:
  /// Precondition: at most one of the two has a shape. `period` is zero on axes that are not periodic.
  /// `shear_rate`, `start`: of images that slide (WorldDefinition::shear_rate), since that time.
  PlainGap(const CollisionShape& a, const CollisionShape& b, const Vec3& period, double shear_rate = 0.0,
           double start = 0.0);

  /// Interval that contains the exact value. Precondition of each query: the time is not before either
  /// report.
  struct Limits {
    double lower;
    double upper;
  };
  /// Gap between the two bounds, with the radii grown up to `time`: bodies inside them are nowhere nearer.
  Limits of_bounds(double time) const;
  /// Largest gap that two bodies inside these bounds can have.
  Limits at_farthest(double time) const;
  /// Gap of two bodies anywhere inside these bounds.
  Limits of_bodies(double time) const { return {of_bounds(time).lower, at_farthest(time).upper}; }

  /// Upper bound of the rate at which these gaps change between the two times (length / time).
  double largest_speed(double from, double to) const;
  /// Tolerated numerical error of the motion from the reports up to `time` (length): reports that exceed the
  /// bound by less are not violations.
  double uncertainty(double time) const;

 private:
  Limits distance(double time) const;
  double radii() const;
  double growth(double time) const;

  const Bound& moving_;
  const Bound& other_;
  const Shape* shape_;
  bool is_carried_;
  double shape_radius_;  ///< part of the radius of other_ that stands for the shape
  Vec3 period_;
  double shear_rate_, start_;
};

}  // namespace kinesphere
