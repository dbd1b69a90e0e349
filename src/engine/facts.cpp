#include "engine/facts.hpp"

#include <cmath>
#include <utility>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Of two in their order.
[[gnu::always_inline]] inline double apart_until_in_order(const Bodies& bodies, const Known& a,
                                                          const Known& b, double now) {
  const double end = std::min(a.end, b.end);
  const double sensed = reach_of_pair(bodies, a.number, b.number);
  MovedBound moved(*b.bound, now);
  if (bodies.space().repeats()) moved.centre += bodies.space().shift_between_homes(*b.middle, *a.middle);
  const Encounter pair(MovedBound(*a.bound, now), moved);
  const double near = sensed + bodies.definition().contact_tolerance;
  if (pair.stay_apart(end - now, near)) return infinity;
  if (pair.is_near(near)) return now;
  const double until =
      rounding::sum_down(now, pair.meeting(end - now, sensed + rounding_room(bodies.definition())));
  return until < end ? std::max(until, now) : infinity;
}

}  // namespace

std::optional<Window> Facts::window_of(std::uint32_t number) const {
  if (const BodyKick* kick = beside_ ? beside_->last_kick(number) : nullptr) return kick->window;
  if (!tables_.windows.contains(number)) return std::nullopt;
  return tables_.windows.window_of(number);
}

HotPair Facts::hot_pair(double time, std::uint32_t a, std::uint32_t b) const {
  if (b >= HotPair::renewal) return {time, a, b, stamp_of(a), 0};
  const auto [first, second] = bodies().table().comes_before(b, a) ? std::pair(b, a) : std::pair(a, b);
  return {time, first, second, stamp_of(first), stamp_of(second)};
}

double apart_until(const Bodies& bodies, const Known& a, const Known& b, double now) {
  return bodies.table().comes_before(b.number, a.number) ? apart_until_in_order(bodies, b, a, now)
                                                         : apart_until_in_order(bodies, a, b, now);
}

double Facts::apart_until(std::uint32_t a, std::uint32_t b) const {
  // The same, to the last bit, whoever has found whom.
  if (bodies().table().comes_before(b, a)) std::swap(a, b);
  if (!bodies().may_meet(a, b)) return infinity;
  const Known one = known(a);
  const Known other = known(b);
  const double end = std::min(one.end, other.end);
  if (bodies()[a].is_fixed() || bodies()[b].is_fixed() || end == infinity) {
    const double until = unchanged_until_by_thresholds(a, b);
    return until < end ? until : infinity;
  }
  return apart_until_in_order(bodies(), one, other, time_);
}

double Facts::unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const {
  const double end = windows_end(a, b);
  double first = infinity;
  if (!bodies().may_meet(a, b)) return first;
  visit_pair(bodies(), a, b, [&](const Bound& bound, const auto& other) {
    for_each_threshold(a, b, [&](const Threshold& threshold) {
      const Outlook outlook(book().rule_of(threshold), threshold, bound, other, time_, {end, end});
      first = std::min(first, outlook.until_reports());
    });
  });
  return first;
}

double Facts::walls_unchanged_until(std::uint32_t number) const {
  if (book().walls_of(number) != 0) return time_;
  return until_reports_of_walls(book().rule(), bodies()[number].bound, *bodies().walls(), time_,
                                end_of(number));
}

double Facts::find_hot_pair(std::uint32_t a, std::uint32_t b, FoundPairs& found) const {
  ++found.candidates;
  const double until = apart_until(a, b);
  if (until == infinity) return until;
  ++found.near;
  if (are_linked(a, b)) return infinity;
  found.hot.push_back(hot_pair(until, a, b));
  ++found.pairs;
  return until;
}

/// They may be anywhere.
void Facts::find_known_pairs(std::uint32_t number, FoundPairs& found) const {
  const auto add = [&](std::uint32_t other) {
    // Of two in the round the first one finds it.
    if (!tables_.windows.contains(other) ||
        (bodies()[other].settled && bodies().table().comes_before(other, number)))
      return;
    const double until = unchanged_until_by_thresholds(number, other);
    if (until < windows_end(number, other)) found.hot.push_back(hot_pair(until, number, other));
  };
  for (const std::uint32_t partner : book().partners_of(number)) add(partner);
  const auto crossed = book().crossings_of(number);
  for (std::size_t k = 0; k < crossed.size(); ++k) {
    const std::uint32_t other = crossed[k].partner;
    if (k > 0 && other == crossed[k - 1].partner) continue;
    if (!book().touch(number, other)) add(other);
  }
}

void Facts::find_walls(std::uint32_t number, FoundPairs& found) const {
  const Body& body = bodies()[number];
  if (!bodies().walls() || body.is_fixed()) return;
  const double until = walls_unchanged_until(number);
  if (until < end_of(number)) found.hot.push_back(hot_pair(until, number, HotPair::walls));
}

}  // namespace kinesphere
