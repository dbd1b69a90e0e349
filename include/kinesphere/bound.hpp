// Time-varying bounds, and certified lower bounds of the times at which they meet, separate or leave a box.
//
//   Bound a = ..., b = ...;
//   double t = earliest_meeting(a, b, now, now + 10);
//   // whatever the two bodies do within their motion limits, they are apart before t
//
// Every function here is pure. Each `earliest_` result is a LOWER bound of the true time: it is never late.
// Three facts ensure this:
//   1. Safe steps. Every step of an iteration is safe by itself: stopping early only returns an earlier time.
//   2. Rounding. Each coefficient of a step is lowered by a margin of 2^-47 times the sum of the magnitudes
//      that went into it, which exceeds the sum of all roundings up to there (fewer than 40, each at most
//      2^-53 of such a magnitude). Roots are computed in the form that cannot cancel, with the discriminant
//      moved to the early side, and shortened by 2^-47 of themselves; the final sum is rounded down. No
//      rounding mode is changed, so the result is the same on every machine and at every optimisation level
//      (the library is built with -ffp-contract=off and without -ffast-math).
//   3. Range. Numbers of all sizes are accepted, from zero up to overflow, infinity and NaN. Between
//      limits::least_size and limits::largest_size (limits.hpp) results are as close to the truth as rounding
//      allows. Smaller numbers are treated as if they could be as large as least_size, so results may be
//      early by as much. Beyond largest_size nothing is certain: the result is `from`, and gap limits are
//      infinite.
#pragma once

#include "kinesphere/body.hpp"

namespace kinesphere {

/// A growing, moving sphere that certainly contains the body. With s = t - time >= 0,
///   centre  c(s)   = position + velocity s + 1/2 planned_acceleration s^2
///   radius  rho(s) = radius + growth_speed s + 1/2 acceleration_limit s^2
/// (paper, eqs 3-6, which are the case of zero plan and zero growth_speed).
struct Bound {
  double time = 0.0;  ///< time of the report
  Vec3 position{};
  Vec3 velocity{};
  Vec3 planned_acceleration{};
  double radius = 0.0;              ///< r + e0
  double growth_speed = 0.0;        ///< e1, plus the magnitude of the rate at which r changes, rounded up
  double acceleration_limit = 0.0;  ///< A

  /// Centre and radius at time t >= time; each step is correctly rounded, without a margin.
  [[gnu::always_inline]] Vec3 centre_at(double t) const {
    const double s = t - time;
    return position + (velocity + planned_acceleration * (0.5 * s)) * s;
  }
  [[gnu::always_inline]] double radius_at(double t) const {
    const double s = t - time;
    return radius + (growth_speed + 0.5 * acceleration_limit * s) * s;
  }
  /// True if the centre moves exactly as planned and the radius does not grow.
  [[gnu::always_inline]] bool is_exact() const { return growth_speed == 0.0 && acceleration_limit == 0.0; }
  /// Velocity of the centre at time t >= time.
  [[gnu::always_inline]] Vec3 velocity_at(double t) const {
    return velocity + planned_acceleration * (t - time);
  }

  friend constexpr bool operator==(const Bound&, const Bound&) = default;
};

/// Returns the bound of a body that reports `state` at `time`.
Bound bound_of(const BodyDefinition& body, const State& state, double time);

/// Points p with dot(normal, p) >= offset: the region where bodies may be. Its plane is the wall.
struct HalfSpace {
  Vec3 normal{};  ///< of unit length
  double offset = 0.0;

  friend constexpr bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// Returns a time in [from, until] before which no two points of the two bodies come closer than `distance`
/// (length; default 0: contact), or +infinity if that holds up to and including `until`. Returns `from` if
/// the bounds are already that close. It solves
///   |c_i - c_j| = rho_i + rho_j + distance (paper, eq 9)
/// by Newton steps along the line of centres. For any unit vector n, |C(d)| >= n.C(d), so the first root of
/// the quadratic n.C(d) = rho(d) + distance is never later than that of eq 9; each step advances the two
/// bounds by it and takes the new n. The result is exact for a pair on a line, and the iteration converges
/// quadratically. Needs each report time <= from <= until. Units: times in, time out. Cost: about 20 ns a
/// round, 2-4 rounds.
double earliest_meeting(const Bound& a, const Bound& b, double from, double until, double distance = 0.0);

/// Returns a time before which the gap between the two bodies stays below `distance`, so that their contact
/// cannot end sooner. Values and conditions: as earliest_meeting(); returns `from` if the gap may already
/// be that large. Radii count as reported, r + e0, and positions without their errors: with e0 > 0 the
/// result refers to the bodies as reported, and the true gap may be larger by up to 2 e0 of each. It solves
///   |c_i - c_j| + growth_i + growth_j = r_i + r_j + distance,  growth = rho - rho(0)
/// through p(d) = S(d)^2 - |C(d)|^2 >= q0 + q1 d + q2 d^2, with the cubic and quartic terms replaced by
/// their least values over the step.
double earliest_separation(const Bound& a, const Bound& b, double from, double until, double distance);

/// Like earliest_meeting() of two bounds, for a bound and the plane of a half-space: the first root of the
/// quadratic
///   normal . c(s) - rho(s) - offset = distance.
double earliest_meeting(const Bound& bound, const HalfSpace& wall, double from, double until,
                        double distance = 0.0);

/// Like earliest_separation() of two bounds, for a bound and the plane of a half-space.
double earliest_separation(const Bound& bound, const HalfSpace& wall, double from, double until,
                           double distance);

/// Returns a time in [from, until] before which the bound lies inside the box, or +infinity if it does up
/// to `until`. Returns `from` if the bound already extends beyond the box. The result is the least root of
/// six quadratics. An axis on which the box extends from -infinity to +infinity is skipped; an infinite
/// side needs an infinite opposite side.
double earliest_exit(const Bound& bound, const Box& box, double from, double until);

/// Returns a box that contains the bound during all of [from, to], rounded outward; sides that overflow are
/// infinite. Needs a finite `to`.
Box swept_box(const Bound& bound, double from, double to);

/// Certified limits of the distance between the surfaces of two bodies at time t >= each report time: lower
/// = |C| - rho_i - rho_j, upper = |C| - r_i - r_j + growth_i + growth_j, rounded outward. With e0 > 0 the
/// upper limit refers to the bodies as reported, as in earliest_separation(). For sizes beyond
/// limits::largest_size: -infinity and +infinity.
struct GapLimits {
  double lower;
  double upper;

  friend constexpr bool operator==(const GapLimits&, const GapLimits&) = default;
};
/// Returns these limits.
GapLimits gap_limits(const Bound& a, const Bound& b, double t);
GapLimits gap_limits(const Bound& bound, const HalfSpace& wall, double t);

}  // namespace kinesphere
