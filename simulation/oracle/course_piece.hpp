// The course of a gap in one piece, in which each motion is one cubic.
#pragma once

#include <array>

#include "kinesphere/bound.hpp"
#include "kinesphere/motion/trajectory.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

inline constexpr int course_degree = 6;
/// Power or Bernstein coefficients of a polynomial over [0, 1].
using Coefficients = std::array<double, course_degree + 1>;

Coefficients to_bernstein(const Coefficients& power);

/// Position in powers of the time since the begin of a piece.
struct CubicPosition {
  std::array<Vec3, 4> power{};
  std::array<double, 4> error{};  ///< bounds on the rounding of each, on each axis

  /// Returns a segment's position from `begin` on, which lies within the segment.
  static CubicPosition of(const Segment& segment, double begin);
  CubicPosition& operator-=(const CubicPosition& other);
};

/// The motion in one piece, in s = t - begin, and what it takes to find where the gap reaches a level and
/// where it is least.
struct CoursePiece {
  double begin, end;
  CubicPosition centre;  ///< position difference (pair) or position (wall)
  bool is_pair;
  HalfSpace wall;
  double radius;

  double gap(double s) const;
  /// Returns half the derivative of the squared distance of a pair.
  double slope(double s) const;
  /// Returns a polynomial over [0, 1], for the way from s = lower to s = upper, that is positive where the
  /// gap is larger than `level`. Sets `error` to a bound on the rounding in its coefficients.
  Coefficients above(double level, double lower, double upper, double& error) const;
  /// Returns slope() times (upper - lower) in the same way, for a pair. The bound includes the rounding of
  /// the centre's coefficients.
  Coefficients slope_over(double lower, double upper, double& error) const;
  /// Returns the centre in powers over [0, 1], for the way from s = lower to s = upper.
  CubicPosition centre_over(double lower, double upper) const;
};

}  // namespace kinesphere
