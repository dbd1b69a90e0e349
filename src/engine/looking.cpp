// Looking at pairs that are due: from bounds as they are, whether they can have changed; and if so, from
// fresh reports, whether they have.
#include <algorithm>
#include <cmath>

#include "engine/island.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

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
  ++work_.counters.pair_checks;
  const Facts facts = this->facts();
  const double end = facts.windows_end(a, b);
  // A broken promise makes a body dirty, and then it gets all its pairs anew.
  while (!bodies()[a].dirty && !bodies()[b].dirty) {
    const bool fresh = bodies()[a].fresh(time_) && bodies()[b].fresh(time_);
    if (fresh) {
      const auto next = judge_pair(a, b);
      if (next && *next < end) agenda_.add(facts.hot_pair(*next, a, b));
      return {};
    }
    ++work_.counters.certificates;
    const double until =
        facts.are_linked(a, b) ? facts.unchanged_until_by_thresholds(a, b) : facts.apart_until(a, b);
    if (until > time_) {
      if (until < end) agenda_.add(facts.hot_pair(until, a, b));
      return {};
    }
    if (auto probed = probe_staler(a, b); !probed) return probed;
  }
  return {};
}

/// Probes the body whose report is older; the second one, if they are of the same age. One of them at least
/// is not fresh.
Result<void> Island::probe_staler(std::uint32_t a, std::uint32_t b) {
  const bool a_is_staler = bodies()[a].bound.time < bodies()[b].bound.time;
  const bool a_is_asked = !bodies()[a].fresh(time_) && (a_is_staler || bodies()[b].fresh(time_));
  const std::uint32_t staler = a_is_asked ? a : b;
  return probe(std::span(&staler, 1));
}

/// What the fresh reports of two bodies say: when to look again, unless there is news to be told first.
std::optional<double> Island::judge_pair(std::uint32_t a, std::uint32_t b) {
  const Facts facts = this->facts();
  const double end = facts.windows_end(a, b);
  const Body& one = bodies()[a];
  const Body& other = bodies()[b];
  const Promise sum{one.bound.growth_speed + other.bound.growth_speed,
                    one.largest_acceleration() + other.largest_acceleration()};
  std::optional<double> next = infinity;
  visit_pair(bodies(), a, b, [&](const Bound& bound, const auto& partner) {
    facts.for_each_threshold(a, b, [&](const Threshold& threshold) {
      ++work_.counters.certificates;
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
  Judgement verdict = outlook.judge(current, promise);
  if (verdict.change == ContactRule::Change::begin && !threshold.sensed && book().is_jammed(current))
    verdict = outlook.put_off(current, promise);
  if (verdict.is_news()) {
    current.kind = kind_of(verdict.change, threshold.sensed, current.wall);
    current.distance = threshold.distance;
    instant_.announce(current);
    return std::nullopt;
  }
  if (verdict.change == ContactRule::Change::release) book().set_touching(current, false);
  if (verdict.zeno_step) ++work_.counters.zeno_steps;
  if (verdict.breaks_tolerance) instant_.announce(current);
  return verdict.next_look;
}

/// The walls of a body are due.
Result<void> Island::look_at_walls(std::uint32_t number) {
  ++work_.counters.wall_checks;
  const Facts facts = this->facts();
  const double end = facts.end_of(number);
  while (!bodies()[number].dirty) {
    if (bodies()[number].fresh(time_)) {
      const auto next = judge_walls(number);
      if (next && *next < end) agenda_.add(facts.hot_pair(*next, number, HotPair::walls));
      return {};
    }
    const double until = facts.walls_unchanged_until(number);
    if (until > time_) {
      if (until < end) agenda_.add(facts.hot_pair(until, number, HotPair::walls));
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
  const double end = facts().end_of(number);
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
