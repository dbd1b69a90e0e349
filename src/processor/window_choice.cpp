#include "processor/window_choice.hpp"

#include <algorithm>
#include <cmath>

#include "number/infinity.hpp"
#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// Cost of a report, including the caller's work, in units of one swept-sphere comparison. Trades probes
/// against searches that find more candidates.
constexpr double price_of_report = 800.0;

/// Returns the largest width (length) of the box of a body on a periodic axis, by space/space.hpp (2);
/// slightly reduced for rounding.
double widest_in_period(double period, double position_error, double release_gap) {
  return (0.5 - 0x1p-10) * period - release_gap - 4.0 * position_error;
}

}  // namespace

/// Returns the longest duration of a window, at most `length`, for which the box around the body's path
/// satisfies space/space.hpp (2).
double WindowChoice::longest_in_period(std::uint32_t number, double length, double release_gap) const {
  const Body& body = bodies()[number];
  const Space& space = bodies().space();
  const BoundAt moved(body.bound, time_);
  const double radius = moved.radius + bodies().sensors.reach(body.sensor_class) +
                        2.0 * bodies().definition().contact_tolerance;
  double longest = length;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space.repeats(axis)) continue;
    const double speed = std::abs(moved.velocity[axis]) + 2.0 * moved.speed;
    const double a = norm_one(moved.acceleration) + moved.growth;
    const double widest = widest_in_period(space.period()[axis], body.position_error, release_gap);
    const double way = std::max(widest - 2.0 * radius, 0.0);
    if ((speed + a * longest) * longest <= way) continue;
    const double divisor = speed + std::sqrt(speed * speed + 4.0 * a * way);
    if (divisor > 0.0) longest = std::min(longest, 2.0 * way / divisor);
  }
  return longest;
}

/// Returns the rung of the longest window from now on, up to `rung`, that is short enough for periodic space.
int WindowChoice::rung_in_space(std::uint32_t number, int rung) const {
  if (!bodies().space().repeats()) return rung;
  rung = Window::at(time_, rung).rung;
  const double release_gap = state_.contacts.rule().release_gap();
  while (power_of_two(rung) > longest_in_period(number, power_of_two(rung), release_gap)) {
    const int shorter = Window::at(time_, rung - 1).rung;
    if (shorter == rung) break;
    rung = shorter;
  }
  return rung;
}

Window WindowChoice::next_window(std::uint32_t number, const std::optional<Window>& present) const {
  const Body& body = bodies()[number];
  if (body.is_static() || body.stands_still()) return Window::endless();
  const Window window = window_for(number);
  if (!present || body.relocated || is_entered_early(window.rung)) return window;
  const bool suits = present->rung >= window.rung - 2 * WindowPolicy::powers_between_rungs &&
                     present->end <= window.end &&
                     (present->rung <= window.rung || !bodies().space().repeats());
  return suits && time_ < present->end ? *present : window;
}

Window WindowChoice::longer_window(std::uint32_t number, const Window& ended) const {
  const int suits = state_.window_policy.rung_for(speed_bound_of(BoundAt(bodies()[number].bound, time_)));
  return window_of(rung_in_space(number, std::max(suits, ended.rung + 1)));
}

bool WindowChoice::needs_report(std::uint32_t number, double report_time) const {
  const Body& body = bodies()[number];
  if (body.fresh(report_time)) return false;
  const Bound& bound = body.bound;
  const auto is_far_after = [&](double s, double length) {
    return (norm(bound.velocity) + bound.growth_speed + body.largest_acceleration() * s) * s > length;
  };
  // An exact bound does not grow, and no window ends after a main one.
  if (bound.is_exact() && !bodies().space().repeats()) {
    const Window longest = window_of(state_.window_policy.main_rung());
    if (!is_far_after(longest.end - bound.time, longest_way(bodies().definition()))) return false;
  }
  const SpeedBound speed_bound = speed_bound_of(BoundAt(bound, time_));
  const Window window = window_of(rung_for(number, speed_bound));
  const double s = window.end - bound.time;
  const auto growth_after = [&bound](double time) {
    return (bound.growth_speed + 0.5 * bound.acceleration_limit * time) * time;
  };
  const double saved = growth_after(s) - growth_after(window.end - report_time);
  if (state_.window_policy.cost_of_width(2.0 * saved) > price_of_report) return true;
  if (!bodies().space().repeats()) return is_far_after(s, longest_way(bodies().definition()));
  if (window.rung < state_.window_policy.rung_for(speed_bound)) return true;
  const Vec3& period = bodies().space().period();
  double half = infinity;
  for (int axis = 0; axis < 3; ++axis)
    if (bodies().space().repeats(axis)) half = std::min(half, 0.5 * period[axis]);
  return is_far_after(s, half);
}

}  // namespace kinesphere
