#include "contact/contact_rule.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

ContactRule::ContactRule(const WorldDefinition& definition)
    : tolerance_(definition.contact_tolerance),
      separation_distance_(std::isnan(definition.separation_distance) ? 4.0 * definition.contact_tolerance
                                                                      : definition.separation_distance),
      zeno_interval_(definition.zeno_interval),
      impacts_only_(definition.contacts == ContactMode::impacts) {}

ContactRule::Change ContactRule::decide(bool touching, double gap, double approach_speed,
                                        double approach_error) const {
  if (!touching) {
    if (gap > tolerance_) return Change::none;
    return impacts_only_ && !approach(gap, approach_speed, approach_error) ? Change::none : Change::begin;
  }
  if (impacts_only_) {
    const bool parts = gap >= separation_distance_ || !approach(gap, approach_speed, approach_error);
    return parts ? Change::release : Change::none;
  }
  return gap >= separation_distance_ ? Change::end : Change::none;
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

}  // namespace kinesphere
