#include "engine/pacing.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// What a report costs, in looks at a capsule: with it, all that the caller does for it.
constexpr double price_of_report = 500.0;

}  // namespace

int Pacing::tier_for(std::uint32_t number, const Pace& pace) const {
  int tier = tables_.tempo.tier_for(pace);
  if (!bodies().space().repeats()) return tier;
  tier = Windows::window_at(time_, tier).tier;
  const double release_gap = tables_.book.rule().release_gap();
  while (power_of_two(tier) > bodies().longest_in_period(number, time_, power_of_two(tier), release_gap)) {
    const int shorter = Windows::window_at(time_, tier - 1).tier;
    if (shorter == tier) break;
    tier = shorter;
  }
  return tier;
}

Window Pacing::next_window(std::uint32_t number, const std::optional<Window>& present) const {
  const Body& body = bodies()[number];
  if (body.is_fixed() || body.stands_still()) return Windows::endless();
  const Window window = window_for(number);
  if (!present || body.arrived) return window;
  const bool suits = present->tier >= window.tier - 2 * Tempo::powers_between_tiers &&
                     present->end <= window.end &&
                     (present->tier <= window.tier || !bodies().space().repeats());
  return suits && time_ < present->end ? *present : window;
}

bool Pacing::needs_report(std::uint32_t number) const {
  const Body& body = bodies()[number];
  if (body.fresh(time_)) return false;
  const Bound& bound = body.bound;
  const Pace pace = bodies().pace_of(number, time_);
  const Window window = Windows::window_at(time_, tier_for(number, pace));
  const double s = window.end - bound.time;
  const auto growth_after = [&bound](double time) {
    return (bound.growth_speed + 0.5 * bound.growth_acceleration * time) * time;
  };
  const double saved = growth_after(s) - growth_after(window.end - time_);
  if (tables_.tempo.cost_of_width(2.0 * saved) > price_of_report) return true;
  const double speed = norm(bound.velocity) + bound.growth_speed + body.largest_acceleration() * s;
  if (!bodies().space().repeats()) return speed * s > bodies().longest_way();
  if (window.tier < tables_.tempo.tier_for(pace)) return true;
  const Vec3& period = bodies().space().period();
  double half = infinity;
  for (int axis = 0; axis < 3; ++axis)
    if (bodies().space().repeats(axis)) half = std::min(half, 0.5 * period[axis]);
  return speed * s > half;
}

}  // namespace kinesphere
