#include "contact/contact_rule.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

ContactRule::ContactRule(const WorldDefinition& definition)
    : tolerance_(definition.contact_tolerance),
      separation_distance_(std::isnan(definition.separation_distance) ? 4.0 * definition.contact_tolerance
                                                                      : definition.separation_distance),
      zeno_interval_(definition.zeno_interval) {}

ContactRule::Change ContactRule::decide(const Threshold& threshold, double gap, double approach_speed,
                                        double approach_error) const {
  const bool ends = wants_ends(threshold.wanted);
  const bool approaches = is_approach(gap, approach_speed, approach_error);
  if (!threshold.within) return gap <= tolerance_ && (ends || approaches) ? Change::begin : Change::none;
  if (gap >= separation_distance_) return ends ? Change::end : Change::release;
  if (threshold.is_watched() && gap <= tolerance_ && approaches) return Change::begin;
  const bool may_pass = threshold.state.approach == ApproachState::reported ||
                        threshold.state.approach == ApproachState::ignored ||
                        (threshold.state.approach == ApproachState::turned && approaches);
  return may_pass || ends || threshold.state.has_history() ? Change::none : Change::release;
}

double ContactRule::guarded_gap(double gap) const {
  if (gap > tolerance_) return 0.0;
  return gap > -0.25 * tolerance_ ? -0.5 * tolerance_ : gap - 0x1p-20 * tolerance_;
}

double ContactRule::least_step(double gap, double speed_error, double acceleration) const {
  if (gap > tolerance_ || !(speed_error + acceleration > 0.0)) return 0.0;
  const double way = 0.125 * tolerance_;
  return 2.0 * way / (speed_error + std::sqrt(speed_error * speed_error + 2.0 * acceleration * way));
}

double ContactRule::zeno_interval(double acceleration) const {
  if (!(acceleration > 0.0)) return zeno_interval_;
  return std::max(zeno_interval_, 4.0 * std::sqrt(tolerance_ / acceleration));
}

double ContactRule::zeno_speed(double acceleration) const {
  return 4.0 * std::sqrt(tolerance_ * acceleration);
}

}  // namespace kinesphere
