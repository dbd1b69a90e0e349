// Looking at pairs: from bounds as they are, how long they cannot change; and when they are due, from fresh
// reports, whether they have.
#include <algorithm>
#include <cmath>

#include "engine/island.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

HotPair Island::hot_pair(double time, std::uint32_t a, std::uint32_t b) const {
  if (b >= HotPair::renewal) return {time, a, b, bodies()[a].stamp, 0};
  const auto [first, second] = std::minmax(a, b);
  return {time, first, second, bodies()[first].stamp, bodies()[second].stamp};
}

std::vector<HotPair> Island::hot_pairs(std::optional<std::uint32_t> number) const {
  std::vector<HotPair> pairs;
  agenda_.for_each([&](const HotPair& pair) {
    const bool asked = !number || pair.first == *number || pair.second == *number;
    if (asked && !is_void(pair)) pairs.push_back(pair);
  });
  return pairs;
}

/// Whether the two touch or sense each other.
bool Island::is_linked(std::uint32_t a, std::uint32_t b) const {
  return book().touch(a, b) || !book().crossings_of(a, b).empty();
}

/// For a pair that a search has found: as apart_until(). Of pairs that touch or sense each other, others take
/// care.
double Island::unchanged_until(std::uint32_t a, std::uint32_t b) const {
  const double until = apart_until(a, b);
  return until < infinity && is_linked(a, b) ? infinity : until;
}

/// Two that neither touch nor sense each other do not before this time, or not before a window ends
/// (+infinity); now, if that takes fresh reports.
double Island::apart_until(std::uint32_t a, std::uint32_t b) const {
  const Body& one = bodies()[a];
  const Body& other = bodies()[b];
  if (!bodies().may_meet(a, b)) return infinity;
  const double end = windows_end(a, b);
  if (one.is_fixed() || other.is_fixed() || end == infinity) {
    const double until = unchanged_until_by_thresholds(a, b);
    return until < end ? until : infinity;
  }
  const double sensed = bodies().reach_of_pair(a, b);
  MovedBound moved(other.bound, time_);
  if (bodies().space().repeats()) moved.centre += bodies().shift_to_meet(a, b);
  const Encounter pair(MovedBound(one.bound, time_), moved);
  const double near = sensed + bodies().definition().contact_tolerance;
  if (pair.stay_apart(end - time_, near)) return infinity;
  if (pair.is_near(near)) return time_;
  const double until =
      rounding::sum_down(time_, pair.meeting(end - time_, sensed + bodies().rounding_room()));
  return until < end ? std::max(until, time_) : infinity;
}

/// The same by the rules of contacts, for any pair; +infinity for ever.
double Island::unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const {
  const double end = windows_end(a, b);
  double first = infinity;
  if (!bodies().may_meet(a, b)) return first;
  bodies().visit_pair(a, b, [&](const Bound& bound, const auto& other) {
    for_each_threshold(a, b, [&](const Threshold& threshold) {
      const Outlook outlook(book().rule_of(threshold), threshold, bound, other, time_, {end, end});
      first = std::min(first, outlook.until_reports());
    });
  });
  return first;
}

/// A pair that was taken out of the agenda is put back unless it has been looked at.
class Island::StillDue {
 public:
  StillDue(Island& island, const HotPair& pair) : island_(island), pair_(pair) {}
  StillDue(const StillDue&) = delete;
  StillDue& operator=(const StillDue&) = delete;
  ~StillDue() {
    if (!done_) island_.agenda_.add(pair_);
  }
  void finish() { done_ = true; }

 private:
  Island& island_;
  HotPair pair_;
  bool done_ = false;
};

Result<void> Island::look(const HotPair& pair) {
  StillDue due(*this, pair);
  auto looked = pair.second == HotPair::walls     ? look_at_walls(pair.first)
                : pair.second == HotPair::renewal ? renew(pair.first)
                                                  : look_at_pair(pair.first, pair.second);
  if (looked) due.finish();
  return looked;
}

Result<void> Island::look_at_pair(std::uint32_t a, std::uint32_t b) {
  ++counters_.pair_checks;
  const double end = windows_end(a, b);
  // A broken promise makes a body dirty, and then it gets all its pairs anew.
  while (!bodies()[a].dirty && !bodies()[b].dirty) {
    const bool fresh = bodies()[a].fresh(time_) && bodies()[b].fresh(time_);
    if (fresh) {
      const auto next = judge_pair(a, b);
      if (next && *next < end) agenda_.add(hot_pair(*next, a, b));
      return {};
    }
    ++counters_.certificates;
    const double until = is_linked(a, b) ? unchanged_until_by_thresholds(a, b) : apart_until(a, b);
    if (until > time_) {
      if (until < end) agenda_.add(hot_pair(until, a, b));
      return {};
    }
    if (auto probed = probe_staler(a, b); !probed) return probed;
  }
  return {};
}

/// What the fresh reports of two bodies say: when to look again, unless there is news to be told first.
std::optional<double> Island::judge_pair(std::uint32_t a, std::uint32_t b) {
  const double end = windows_end(a, b);
  const Body& one = bodies()[a];
  const Body& other = bodies()[b];
  const Promise sum{one.bound.growth_speed + other.bound.growth_speed,
                    one.largest_acceleration() + other.largest_acceleration()};
  std::optional<double> next = infinity;
  bodies().visit_pair(a, b, [&](const Bound& bound, const auto& partner) {
    for_each_threshold(a, b, [&](const Threshold& threshold) {
      ++counters_.certificates;
      const Outlook outlook(book().rule_of(threshold), threshold, bound, partner, time_, {end, end});
      const auto known = judge(outlook, threshold, contact(EventKind::zeno_guard, a, b), sum);
      next = next && known ? std::optional(std::min(*next, *known)) : std::nullopt;
    });
  });
  return next;
}

/// Holds fresh reports against the contact rule. Announces what is news; unless that is a begin or an end,
/// tells how long the threshold cannot be crossed.
template <class Partner>
std::optional<double> Island::judge(const Outlook<Partner>& outlook, const Threshold& threshold,
                                    Event current, const Promise& promise) {
  Verdict verdict = outlook.judge(current, promise);
  if (verdict.change == ContactRule::Change::begin && !threshold.sensed && book().is_jammed(current))
    verdict = outlook.put_off(current, promise);
  if (verdict.is_news()) {
    current.kind = kind_of(verdict.change, threshold.sensed, current.wall);
    current.distance = threshold.distance;
    instant_.announce(current);
    return std::nullopt;
  }
  if (verdict.change == ContactRule::Change::release) book().set_touching(current, false);
  if (verdict.zeno_step) ++counters_.zeno_steps;
  if (verdict.breaks_tolerance) instant_.announce(current);
  return verdict.next_look;
}

/// The walls of a body are due.
Result<void> Island::look_at_walls(std::uint32_t number) {
  ++counters_.wall_checks;
  const double end = end_of(number);
  while (!bodies()[number].dirty) {
    const Body& body = bodies()[number];
    if (body.fresh(time_)) {
      const auto next = judge_walls(number);
      if (next && *next < end) agenda_.add(hot_pair(*next, number, HotPair::walls));
      return {};
    }
    const double until = book().walls_of(number) != 0 ? time_
                                                      : until_reports_of_walls(book().rule(), body.bound,
                                                                               *bodies().walls(), time_, end);
    if (until > time_) {
      if (until < end) agenda_.add(hot_pair(until, number, HotPair::walls));
      return {};
    }
    if (auto probed = probe(std::span(&number, 1)); !probed) return probed;
  }
  return {};
}

/// Holds the fresh report of a body against each wall that it touches or may reach. The others cannot change
/// anything before its window ends.
std::optional<double> Island::judge_walls(std::uint32_t number) {
  const Body& body = bodies()[number];
  const double end = end_of(number);
  const Promise promise{body.bound.growth_speed, body.largest_acceleration()};
  const Box near = walls_in_reach(book().rule(), body.bound, *bodies().walls(), time_, end);
  double first = infinity;
  for (const Wall wall : walls) {
    const bool touches = book().touches_wall(number, wall);
    if (!touches && !stands(near, wall)) continue;
    const HalfSpace inside = half_space(*bodies().walls(), wall);
    const Threshold threshold{.within = touches};
    const Outlook<HalfSpace> outlook(book().rule(), threshold, body.bound, inside, time_, {end, end});
    const auto next = judge(outlook, threshold, wall_contact(EventKind::zeno_guard, number, wall), promise);
    if (next) first = std::min(first, *next);
  }
  return first;
}

}  // namespace kinesphere
