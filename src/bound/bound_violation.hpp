// Checks a report against the bound that the previous report and the motion limits imply, and starts the
// bound anew from it.
#pragma once

#include <cmath>
#include <optional>

#include "kinesphere/bound.hpp"

namespace kinesphere {

/// Distance of a report from its bound, for position and velocity; each is zero if the bound holds.
struct BoundViolation {
  double position_excess = 0.0;  ///< length
  double velocity_excess = 0.0;  ///< length / time
};

/// Returns by how much the time between two reports (time) may be off, as the caller knows it: one unit in
/// the last place of each of the two times. A motion that counts from the rounded times of its own steps
/// shows its body there so much earlier or later than it was.
inline double time_rounding(double before, double after) {
  return 0x1p-52 * (std::abs(before) + std::abs(after));
}

/// Compares a report of a body of this radius with the bound of the previous report. Returns nullopt if the
/// report satisfies it. `before` and `after` are the bounds made from the previous and from the present
/// report; their error limits differ if the caller has changed them in between. `new_velocity` is the
/// velocity that the caller has set since the previous report: then that report was made at this very time,
/// or only its position counts. Rounding errors up to 1/16 of `contact_tolerance` are not a violation, as the
/// tolerance covers them, and neither is as far as the body moves, or changes its velocity, in the
/// time_rounding() of the two reports. `speed_of_terms`: the size of what velocities have been computed from,
/// beside these (length / time).
std::optional<BoundViolation> bound_violation(const Bound& before, const Bound& after, double radius,
                                              const std::optional<Vec3>& new_velocity,
                                              double contact_tolerance, double speed_of_terms = 0.0);

/// Returns the acceleration (length / time^2), beyond the planned one, that explains how far a report
/// deviates from the bound of the previous one: the least of what its place and its velocity need, plus a
/// 64th, so that a constant acceleration is not found again. Error limits are taken off first. Returns 0 if
/// the two do not agree on a direction, as where a body was moved without a velocity, or if no time has
/// passed. Place and velocity change together over a 16th of `contact_tolerance` at least: a shorter jump is
/// no acceleration.
double observed_acceleration(const Bound& before, const Bound& after, double radius,
                             double contact_tolerance);

/// Starts a bound anew from a report whose body has the limits that it had.
[[gnu::always_inline]] inline void restart(Bound& bound, double time, const State& report) {
  bound.time = time;
  bound.position = report.position;
  bound.velocity = report.velocity;
}

/// Returns true if bound_violation() certainly finds no excess of the position in a report at `time`, where
/// no error limit has changed since the previous report. Without square roots.
[[gnu::always_inline]] inline bool certainly_stays(const Bound& before, double time, const Vec3& position,
                                                   double radius, double contact_tolerance) {
  const double position_errors = (before.radius - radius) + (before.radius - radius);
  // Half of what bound_violation() leaves to rounding, as its own rounding differs.
  const double deviation_limit =
      before.radius_at(time) - before.radius + position_errors + contact_tolerance / 32.0;
  return norm_squared(position - before.centre_at(time)) <= deviation_limit * deviation_limit;
}

/// Returns true if bound_violation() certainly finds none, where nothing has changed since the previous
/// report.
[[gnu::always_inline]] inline bool certainly_keeps(const Bound& before, double time, const State& report,
                                                   double radius, double contact_tolerance) {
  const double change_limit =
      before.acceleration_limit * (time - before.time) + (before.growth_speed + before.growth_speed);
  return certainly_stays(before, time, report.position, radius, contact_tolerance) &&
         norm_squared(report.velocity - before.velocity_at(time)) <= change_limit * change_limit;
}

}  // namespace kinesphere
