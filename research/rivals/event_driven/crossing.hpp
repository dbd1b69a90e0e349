// Times at which a bound touches a plane between cells, has parted from one, and outgrows its cell (paper,
// eqs 7 and 8).
#pragma once

#include <limits>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// The surface of a bound on one side of an axis, as it moves from now on. Its distance from a plane is a
/// quadratic in time. Rounding makes contact with a plane early and parting from it late, never the reverse.
class MovingSide {
 public:
  /// `from` is the present time, not before the report.
  MovingSide(const Bound& bound, int axis, bool upper, double from);

  /// Returns a time, in [now, horizon] or +infinity, before which the bound stays on this side of the plane.
  /// Precondition: it is on this side now. An infinite plane is never reached.
  double earliest_entering(double plane, double horizon) const;
  /// Returns the time from which the bound is on this side of the plane, for as long as it moves away. The
  /// time is later than now, so that a bound that grazes a plane cannot enter and leave for ever at one
  /// instant; +infinity if it is not before `horizon`.
  double latest_leaving(double plane, double horizon) const;

 private:
  double room_to(double plane) const;

  double from_;
  double sign_;      ///< sign of the direction in which the side faces
  double position_;  ///< surface along that direction, as speed and acceleration: upper bounds
  double position_size_;
  double speed_;
  double acceleration_;
};

/// Returns the time at which the diameter of the bound reaches `edge` (length; eq 8), with a margin of 2^-10,
/// so that a bound never meets three cells in a row, whatever rounding does. +infinity for a bound that does
/// not grow.
double outgrowing_time(const Bound& bound, double edge);

}  // namespace kinesphere
