// Time-varying bounds, and the certified times at which they can first do something.
//
//   Bound a = ..., b = ...;
//   double t = earliest_meeting(a, b, now, now + 10);
//   // whatever the two bodies do within their promises, they are apart before t
//
// Every function here is pure. Each `earliest_` answer is a LOWER bound of the true time: it is never
// late. Three things make sure of that:
//   1. Every step of an iteration is safe by itself, so stopping early only answers sooner.
//   2. Rounding. Each coefficient of a step is lowered by a margin of 2^-47 times the sum of the
//      magnitudes that went into it, which is more than all the roundings on the way there can add up
//      to (fewer than 40 of them, each at most 2^-53 of such a magnitude); roots are taken in the form
//      that cannot cancel, with the discriminant moved to the early side, and shortened by 2^-47 of
//      themselves; the final sum is rounded down. No rounding mode is changed, so the result is the same on
//      every machine and at every optimisation level (the library is built with -ffp-contract=off and
//      without -ffast-math).
//   3. Numbers of all sizes are taken, down to zero and up to what overflows, infinity and NaN. Between
//      limits::least_size and limits::largest_size (limits.hpp) answers are as near to the truth as rounding
//      allows. Numbers below count as if they were up to that large, so answers may be early by as much;
//      beyond, where nothing is certain, the answer is `from`, and gap limits are infinite.
#pragma once

#include "kinesphere/body.hpp"

namespace kinesphere {

/// A moving sphere that grows and is certain to contain the body. With s = t - time >= 0,
///   centre  c(s)   = position + velocity s + 1/2 planned_acceleration s^2
///   radius  rho(s) = radius + growth_speed s + 1/2 growth_acceleration s^2
/// (paper, eqs 3-6, which are the case of zero plan and zero growth_speed).
struct Bound {
  double time = 0.0;  ///< of the report
  Vec3 position{};
  Vec3 velocity{};
  Vec3 planned_acceleration{};
  double radius = 0.0;               ///< r + e0
  double growth_speed = 0.0;         ///< e1
  double growth_acceleration = 0.0;  ///< A

  /// Centre and radius at time t >= time, correctly rounded step by step (no margin).
  [[gnu::always_inline]] Vec3 centre_at(double t) const {
    const double s = t - time;
    return position + (velocity + planned_acceleration * (0.5 * s)) * s;
  }
  [[gnu::always_inline]] double radius_at(double t) const {
    const double s = t - time;
    return radius + (growth_speed + 0.5 * growth_acceleration * s) * s;
  }
  /// Velocity of the centre at time t >= time.
  [[gnu::always_inline]] Vec3 velocity_at(double t) const {
    return velocity + planned_acceleration * (t - time);
  }
};

/// The bound of a body that reports `state` at `time`.
Bound bound_of(const BodyDefinition& body, const State& state, double time);

/// The points p with dot(normal, p) >= offset: where bodies may be; the plane is the wall.
struct HalfSpace {
  Vec3 normal{};  ///< of unit length
  double offset = 0.0;

  friend constexpr bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// No pair of points of the two bodies comes closer than `distance` (length; default 0: contact)
/// before the returned time, which lies in [from, until], or is +infinity when that holds up to and
/// including `until`. Returns `from` when the bounds are already that close.
///   solves |c_i - c_j| = rho_i + rho_j + distance (paper, eq 9)
/// by Newton steps along the line of centres: for any unit vector n, |C(d)| >= n.C(d), so the first
/// root of the quadratic n.C(d) = rho(d) + distance is never later than that of eq 9; advance both
/// bounds by it, take the new n, repeat. Exact for a pair on a line, and quadratically convergent.
/// Needs both report times <= from <= until. Units: times in, time out. Cost: about 20 ns a round, 2-4
/// rounds.
double earliest_meeting(const Bound& a, const Bound& b, double from, double until, double distance = 0.0);

/// The gap between the two bodies stays below `distance` before the returned time (the pair's
/// end of contact cannot come sooner). Values and conditions as above; returns `from` when the gap
/// may already be that large. Radii count as reported, r + e0, and positions without their errors: with
/// e0 > 0 this is about the bodies as reported, and the true gap may be larger by up to 2 e0 of each.
///   solves |c_i - c_j| + growth_i + growth_j = r_i + r_j + distance,  growth = rho - rho(0)
/// through p(d) = S(d)^2 - |C(d)|^2 >= q0 + q1 d + q2 d^2 with the cubic and quartic terms replaced by
/// their least values over the step.
double earliest_separation(const Bound& a, const Bound& b, double from, double until, double distance);

/// As earliest_meeting, for a bound and the plane of a half-space: the first root of the quadratic
///   normal . c(s) - rho(s) - offset = distance.
double earliest_meeting(const Bound& bound, const HalfSpace& wall, double from, double until,
                        double distance = 0.0);

/// As earliest_separation, for a bound and the plane of a half-space.
double earliest_separation(const Bound& bound, const HalfSpace& wall, double from, double until,
                           double distance);

/// The bound lies inside the box before the returned time (in [from, until], or +infinity when it
/// does up to `until`). Returns `from` when it already reaches out. The least of six quadratics. Nothing is
/// asked on an axis where the box reaches from -infinity to +infinity; an infinite side has an infinite one
/// opposite.
double earliest_exit(const Bound& bound, const Box& box, double from, double until);

/// A box that contains the bound during all of [from, to], rounded outward; sides that overflow are infinite.
/// Needs a finite `to`.
Box swept_box(const Bound& bound, double from, double to);

/// Certified limits of the distance between the surfaces of two bodies at time t >= both report
/// times: lower = |C| - rho_i - rho_j, upper = |C| - r_i - r_j + growth_i + growth_j, rounded apart.
/// With e0 > 0 the upper limit is about the bodies as reported, as in earliest_separation. Where sizes are
/// beyond limits::largest_size: -infinity and +infinity.
struct GapLimits {
  double lower;
  double upper;
};
GapLimits gap_limits(const Bound& a, const Bound& b, double t);
GapLimits gap_limits(const Bound& bound, const HalfSpace& wall, double t);

}  // namespace kinesphere
