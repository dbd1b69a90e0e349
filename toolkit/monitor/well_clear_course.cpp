#include "monitor/well_clear_course.hpp"

#include <algorithm>
#include <cmath>

#include "bound/rounding.hpp"

namespace kinesphere {
namespace {

/// Maximum number of steps of a search. Any number is safe: with fewer, a pair is rechecked sooner.
constexpr int most_steps = 16;
/// A search stops when a step is shorter than this part of the time found so far. Smaller values give later
/// times for more steps.
constexpr double short_step = 0.125;

/// Advances from `now` by the steps `step(time)` as long as they are > 0. Returns +infinity beyond the
/// horizon.
template <class Step>
double advance_while_positive(double now, double horizon, double least, Step step) {
  double time = now;
  for (int k = 0; k < most_steps; ++k) {
    const double gain = step(time);
    if (!(gain > 0.0)) break;
    time = rounding::sum_down(time, gain);
    if (time > horizon || gain == infinity) return infinity;
    if (time >= now + least && gain < std::max(least, (time - now) * short_step)) break;
  }
  return std::max(now, time);
}

}  // namespace

WellClearCourse::Part::Part(const ReachableSet& set, const Component& component)
    : time(set.time),
      position(component.part(set.position)),
      velocity(component.part(set.velocity)),
      acceleration(component.part(set.acceleration)),
      radius(component.length(set.radius)),
      speed(component.length(set.speed)),
      growth(component.length(set.growth)),
      position_size(norm_one(position) + radius),
      velocity_size(norm_one(velocity) + speed),
      acceleration_size(norm_one(acceleration) + growth) {}

WellClearCourse::WellClearCourse(const ReachableSet& a, const ReachableSet& b, const Component& component,
                                 double now, double least)
    : a_(a, component),
      b_(b, component),
      limits_{component.limit, component.modified_tau},
      outer_limits_{rounding::sum_down(component.limit, component.tolerance), component.modified_tau},
      now_(now),
      least_(least),
      now_discs_(discs_at(now)) {}

RelativeDiscs WellClearCourse::discs_at(double time) const {
  RelativeDiscs discs;
  const auto add = [&](const Part& part, double sign) {
    const double s = time - part.time;
    const double velocity_size = part.velocity_size + part.acceleration_size * s;
    discs.position += (part.position + (part.velocity + part.acceleration * (0.5 * s)) * s) * sign;
    discs.velocity += (part.velocity + part.acceleration * s) * sign;
    discs.position_error += part.radius + (part.speed + part.growth * (0.5 * s)) * s +
                            (part.position_size + velocity_size * s) * rounding::margin;
    discs.velocity_error += part.speed + part.growth * s + velocity_size * rounding::margin;
    discs.velocity_growth += part.growth;
  };
  add(a_, 1.0);
  add(b_, -1.0);
  if (a_.acceleration != b_.acceleration)
    discs.acceleration = norm(a_.acceleration - b_.acceleration) * (1.0 + rounding::margin);
  return discs;
}

RelativeDiscs WellClearCourse::least_discs_at(double time) const {
  RelativeDiscs discs = discs_at(time);
  discs.position_error = now_discs_.position_error;
  discs.velocity_error = now_discs_.velocity_error;
  discs.grows = false;
  return discs;
}

double WellClearCourse::clear_until(double horizon) const {
  return advance_while_positive(now_, horizon, least_,
                                [&](double time) { return clear_by_tau_for(discs_at(time), limits_); });
}

double WellClearCourse::lost_until(double horizon) const {
  return advance_while_positive(now_, horizon, least_,
                                [&](double time) { return lost_for(discs_at(time), outer_limits_); });
}

double WellClearCourse::may_be_clear(double horizon) const {
  return advance_while_positive(
      now_, horizon, least_, [&](double time) { return -clear_by_tau_for(least_discs_at(time), limits_); });
}

double WellClearCourse::may_be_lost(double horizon) const {
  return advance_while_positive(now_ + least_, horizon, least_,
                                [&](double time) { return -lost_for(least_discs_at(time), outer_limits_); });
}

}  // namespace kinesphere
