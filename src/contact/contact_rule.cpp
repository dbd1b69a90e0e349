#include "contact/contact_rule.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

namespace {

/// Returns the time in which something that starts at this speed and accelerates goes so far.
double time_for(double way, double speed, double acceleration) {
  return 2.0 * way / (speed + std::sqrt(speed * speed + 2.0 * acceleration * way));
}

}  // namespace

ContactRule::ContactRule(const WorldDefinition& definition)
    : tolerance_(definition.contact_tolerance),
      separation_distance_(std::isnan(definition.separation_distance) ? 4.0 * definition.contact_tolerance
                                                                      : definition.separation_distance),
      zeno_interval_(definition.zeno_interval) {}

ContactRule::Change ContactRule::decide(const Threshold& threshold, double gap, double approach_speed,
                                        double approach_error) const {
  const bool ends = wants_ends(threshold.wanted);
  const bool approaches = is_approach(gap, approach_speed, approach_error);
  if (!threshold.within)
    return gap <= tolerance_ && (ends || approaches || is_inside(gap)) ? Change::begin : Change::none;
  if (gap >= separation_distance_) return ends ? Change::end : Change::release;
  if (threshold.is_watched() && gap <= tolerance_ && approaches) return Change::begin;
  const bool may_pass = threshold.state.approach == ApproachState::reported ||
                        threshold.state.approach == ApproachState::ignored ||
                        (threshold.state.approach == ApproachState::turned && approaches);
  const bool stays = may_pass || ends || threshold.state.has_history() || is_inside(gap);
  return stays ? Change::none : Change::release;
}

double ContactRule::guarded_gap(double gap) const {
  if (gap > tolerance_) return 0.0;
  return gap > -0.25 * tolerance_ ? -0.5 * tolerance_ : gap - 0x1p-20 * tolerance_;
}

double ContactRule::least_step(double gap, double speed_error, double acceleration, double sinking) const {
  if (gap > tolerance_ || !(speed_error + acceleration > 0.0)) return 0.0;
  return time_for(sinking * tolerance_, speed_error, acceleration);
}

double ContactRule::least_time_to_separate(double gap, double speed, double acceleration) const {
  return time_for(std::max(release_gap() - gap, tolerance_), speed, acceleration);
}

double ContactRule::zeno_interval(double acceleration) const {
  if (!(acceleration > 0.0)) return zeno_interval_;
  return std::max(zeno_interval_, 4.0 * std::sqrt(tolerance_ / acceleration));
}

double ContactRule::zeno_speed(double acceleration) const {
  return 4.0 * std::sqrt(tolerance_ * acceleration);
}

}  // namespace kinesphere
