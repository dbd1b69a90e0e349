// Rechecks of pairs that are due: the current bounds decide whether a contact can have changed; if so, fresh
// reports decide whether it has.
#include <algorithm>
#include <array>
#include <cmath>

#include "number/infinity.hpp"
#include "processor/event_processor.hpp"

namespace kinesphere {

/// Finds out whether something happens between two bodies now. Returns a time before which nothing does,
/// which means nothing beyond the own time of either; nullopt if an event waits, or if one of the two is
/// dirty.
Result<std::optional<double>> EventProcessor::check_pair(std::uint32_t a, std::uint32_t b) {
  const PairCertifier certifier = this->certifier();
  // A violated bound makes a body dirty; recertification then creates all its certificates.
  while (!bodies()[a].dirty && !bodies()[b].dirty) {
    const bool fresh = bodies()[a].fresh(time_) && bodies()[b].fresh(time_);
    if (fresh) return decide_pair(a, b);
    ++counters_of(a).certificates;
    const PairLinks links = contacts().links_of(a, b);
    const double until = links.any() ? certifier.unchanged_until(a, b, links) : certifier.apart_until(a, b);
    if (until > time_) return std::optional(until);
    if (auto probed = probe_stale_of(a, b); !probed) return probed.error();
  }
  return std::optional<double>();
}

/// Probes the body with the older report, or the second one if both are equally old. If neither is fresh and
/// both bounds are exact, probes both at once: one report would not move the certificate, so the other would
/// be due at the same time. Precondition: at least one of them is not fresh.
Result<void> EventProcessor::probe_stale_of(std::uint32_t a, std::uint32_t b) {
  const Bound& one = bodies()[a].bound;
  const Bound& other = bodies()[b].bound;
  const bool a_is_fresh = bodies()[a].fresh(time_);
  const bool b_is_fresh = bodies()[b].fresh(time_);
  const bool a_is_first = !a_is_fresh && (one.time < other.time || b_is_fresh);
  const std::array<std::uint32_t, 2> order = a_is_first ? std::array{a, b} : std::array{b, a};
  const bool asks_both = one.is_exact() && other.is_exact() && !a_is_fresh && !b_is_fresh;
  const bool touching = reports_.profile() != nullptr && contacts().touch(a, b);
  return probe(std::span(order).first(asks_both ? 2 : 1), touching ? ProbeCause::touching : ProbeCause::near);
}

/// Sets what limits say of radii that change with time. Returns the time until which the excess growth holds:
/// `end`, or when a ball that shrinks is a point.
double EventProcessor::note_rates(RelativeLimits& limits, std::initializer_list<std::uint32_t> numbers,
                                  double end) const {
  limits.speed_error = 0.0;
  for (const std::uint32_t number : numbers) {
    limits.speed_error += bodies().velocity_error(number);
    const ChangingRadius* const changing = bodies().radii.find(number);
    if (changing == nullptr) continue;
    limits.radius_rates += std::abs(changing->rate);
    limits.excess_growth += std::abs(changing->rate) - changing->rate_at(time_);
    if (changing->rate < 0.0 && !changing->is_point(time_)) end = std::min(end, changing->end());
  }
  return end;
}

/// Applies the contact rule to the fresh reports of two bodies. Returns the time of the next recheck, or
/// nullopt if an event must be delivered first.
std::optional<double> EventProcessor::decide_pair(std::uint32_t a, std::uint32_t b) {
  const PairCertifier certifier = this->certifier();
  const double end = certifier.earlier_own_time(a, b);
  RelativeLimits sum{bodies()[a].bound.growth_speed + bodies()[b].bound.growth_speed,
                     bodies().largest_acceleration(a) + bodies().largest_acceleration(b)};
  const double until = bodies().radii.any() ? note_rates(sum, {a, b}, end) : end;
  std::optional<double> next = infinity;
  Counters& work = counters_of(a);
  visit_pair(bodies(), a, b, time_, [&](const Bound& bound, const auto& partner) {
    certifier.for_each_threshold(a, b, contacts().links_of(a, b), [&](Threshold threshold) {
      ++work.certificates;
      if (threshold.is_turned) threshold.is_turned = !note_return(threshold, a, b);
      const ContactPredictor predictor(contacts().rule(), threshold, bound, partner, time_, {until, end},
                                       sum.excess_growth);
      const auto known = decide(predictor, threshold, sum, work, [&] { return describe_pair(a, b); });
      next = next && known ? std::optional(std::min(*next, *known)) : std::nullopt;
    });
  });
  if (next && until < end) next = std::min(*next, until);
  return next;
}

/// Returns true, and forgets that the two have been turned back, if they are back where they came from.
bool EventProcessor::note_return(const Threshold& turned, std::uint32_t a, std::uint32_t b) {
  const double gap = describe_pair(a, b).event.gap - turned.distance;
  if (!contacts().rule().is_back(turned, gap)) return false;
  contacts().pairs().set_turned(a, b, std::nullopt);
  return true;
}

/// Applies the contact rule to fresh reports. Queues the events that result. Returns the time before which
/// the threshold cannot be crossed, or nullopt if a begin or an end was queued. `describe` returns an event
/// of the two. `work`: where it is counted.
template <class Partner, class Describe>
std::optional<double> EventProcessor::decide(const ContactPredictor<Partner>& predictor,
                                             const Threshold& threshold, const RelativeLimits& limits,
                                             Counters& work, Describe describe) {
  if (const auto next_check = predictor.next_check_if_apart()) return next_check;
  auto [current, terms] = describe();
  ContactDecision decision = predictor.decide(current, limits);
  // A begin that has an end is told before it: two that have been let through would end what never began.
  const bool may_wait = threshold.within || !wants_ends(threshold.wanted);
  if (decision.change == ContactRule::Change::begin && !threshold.sensed && may_wait &&
      contacts().is_jammed(current))
    return defer(predictor, threshold, current, limits, work);
  if (decision.is_event()) {
    current.kind = kind_of(decision.change, threshold.sensed, current.wall);
    current.distance = threshold.distance;
    events_.queue(current, &terms);
    return std::nullopt;
  }
  if (decision.change == ContactRule::Change::release) contacts().set_touching(current, false);
  if (decision.zeno_step) ++work.zeno_steps;
  if (threshold.sensed) return decision.next_check;
  const bool stays = threshold.within && decision.change != ContactRule::Change::release;
  ContactState state = stays ? threshold.state : ContactState{};
  if (stays) state.approach = decision.approach;
  if (decision.breaks_tolerance && !state.guard_reported) {
    events_.queue(current);
    state.guard_reported = true;
  }
  if (stays ? state != threshold.state : state.guard_reported) {
    contacts().set_state(current, state);
    note_link(current, threshold);
  }
  return decision.next_check;
}

/// Tells the core of a contact that is remembered without an event of its begin, so that it is followed until
/// the two have separated.
void EventProcessor::note_link(const Event& current, const Threshold& threshold) {
  if (threshold.within) return;
  set_kind_in_core(bodies().table().number_of(current.first));
  if (current.second != no_body) set_kind_in_core(bodies().table().number_of(current.second));
}

/// Defers the begin of a jammed contact by a least step or, after too many jams, until the two have
/// separated.
template <class Partner>
double EventProcessor::defer(const ContactPredictor<Partner>& predictor, const Threshold& threshold,
                             const Event& current, const RelativeLimits& limits, Counters& work) {
  const ContactDecision decision = predictor.defer(current, limits);
  ++work.zeno_steps;
  const ContactGraph::Jam jam = contacts().note_jam(current, threshold, decision.breaks_tolerance);
  note_link(current, threshold);
  if (jam.is_news) events_.queue(current);
  return jam.is_last ? predictor.until_separated() : decision.next_check;
}

/// Evaluates check_pair() for a body and the walls.
Result<std::optional<double>> EventProcessor::check_walls(std::uint32_t number) {
  ++counters_of(number).wall_checks;
  while (!bodies()[number].dirty) {
    if (bodies()[number].fresh(time_)) return decide_walls(number);
    const double until = certifier().walls_unchanged_until(number);
    if (until > time_) return std::optional(until);
    const ProbeCause cause = contacts().walls_of(number) != 0 ? ProbeCause::touching : ProbeCause::near;
    if (auto probed = probe(std::span(&number, 1), cause); !probed) return probed.error();
  }
  return std::optional<double>();
}

/// Applies the contact rule to the fresh report of a body, for each wall that it touches or may reach. The
/// other walls cannot matter before its own time.
std::optional<double> EventProcessor::decide_walls(std::uint32_t number) {
  const Body& body = bodies()[number];
  const double end = certifier().own_time(number);
  RelativeLimits limits{body.bound.growth_speed, bodies().largest_acceleration(number)};
  const double until = bodies().radii.any() ? note_rates(limits, {number}, end) : end;
  const CollisionShape shape = collision_shape_of(bodies(), number);
  const Box near = walls_in_reach(contacts().rule(), body.bound, *bodies().walls(), time_, end);
  double first = infinity;
  for (const Wall wall : walls) {
    const bool touches = contacts().touches_wall(number, wall);
    if (!touches && !stands(near, wall)) continue;
    const HalfSpace inside = half_space(*bodies().walls(), wall);
    const Threshold threshold = contacts().wall_threshold(number, wall, body.contact_events);
    const auto next = visit_wall(shape, inside, [&](const Bound& bound, const auto& partner) {
      const ContactPredictor predictor(contacts().rule(), threshold, bound, partner, time_, {until, end},
                                       limits.excess_growth);
      return decide(predictor, threshold, limits, counters_of(number),
                    [&] { return describe_wall(number, wall); });
    });
    if (next) first = std::min(first, *next);
  }
  if (until < end) first = std::min(first, until);
  return first;
}

}  // namespace kinesphere
