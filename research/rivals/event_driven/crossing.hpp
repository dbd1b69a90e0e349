// When a bound touches a plane between cells, when it has parted from one, and when it outgrows its cell
// (paper, eqs 7 and 8).
#pragma once

#include <limits>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// A bound's surface on one side of an axis, as it moves from now on. Its distance from a plane there is a
/// quadratic; rounding makes contact with a plane early and parting from it late, never the reverse.
class MovingSide {
 public:
  /// `from` is now, not before the report.
  MovingSide(const Bound& bound, int axis, bool upper, double from);

  /// The bound, now this side of the plane, stays there before the returned time, which lies in
  /// [now, horizon] or is +infinity. An infinite plane is never reached.
  double earliest_entering(double plane, double horizon) const;
  /// From the returned time on, for as long as the way leads there, the bound lies this side of the plane.
  /// Later than now, so that a bound that grazes a plane cannot enter and leave for ever at one instant;
  /// +infinity when that is not before `horizon`.
  double latest_leaving(double plane, double horizon) const;

 private:
  double room_to(double plane) const;

  double from_;
  double sign_;      ///< of the direction in which the side faces
  double position_;  ///< of the surface, in that direction, as speed and acceleration: no less than true
  double position_size_;
  double speed_;
  double acceleration_;
};

/// When the diameter of the bound comes up to `edge` (eq 8): a sliver of 2^-10 sooner, so that a bound never
/// meets three cells in a row, rounding or not. +infinity for a bound that does not grow.
double outgrowing_time(const Bound& bound, double edge);

}  // namespace kinesphere
