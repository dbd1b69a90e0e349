#include "processor/pair_certifier.hpp"

#include <utility>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Computes apart_until() for two bodies in the order of their names.
[[gnu::always_inline]] inline double apart_until_in_order(const Bodies& bodies, const BoundRef& a,
                                                          const BoundRef& b, double now) {
  const double end = std::min(a.end, b.end);
  const double sensed = reach_of_pair(bodies, a.number, b.number);
  BoundAt moved(*b.bound, now);
  if (bodies.space().repeats()) moved.centre += bodies.space().shift_between_images(*b.middle, *a.middle);
  const QuickReject pair(BoundAt(*a.bound, now), moved);
  const double near = sensed + bodies.definition().contact_tolerance;
  if (pair.stay_apart(end - now, near)) return infinity;
  if (pair.is_near(near)) return now;
  const double until =
      rounding::sum_down(now, pair.meeting(end - now, sensed + rounding_margin(bodies.definition())));
  return until < end ? std::max(until, now) : infinity;
}

}  // namespace

/// Returns BroadPhase::search_begin() if two bodies, or one and its walls, await that search, otherwise
/// `end`.
[[gnu::noinline]] double PairCertifier::until_search(std::uint32_t a, std::uint32_t b, double end) const {
  const auto is_updated = [this](std::uint32_t number) {
    return log_ && log_->last_update(number) != nullptr;
  };
  return windows_.pair_awaits_search(a, b) && !is_updated(a) && !is_updated(b)
             ? std::min(end, windows_.search_begin())
             : end;
}

std::optional<Window> PairCertifier::window_of(std::uint32_t number) const {
  if (const SweptSphereUpdate* update = log_ ? log_->last_update(number) : nullptr) return update->window;
  if (!windows_.contains(number)) return std::nullopt;
  return windows_.window_of(number);
}

PairCertificate PairCertifier::certificate(double time, std::uint32_t a, std::uint32_t b) const {
  if (b >= PairCertificate::window_end) return {time, a, b, revision_of(a), 0};
  const auto [first, second] = bodies().table().comes_before(b, a) ? std::pair(b, a) : std::pair(a, b);
  return {time, first, second, revision_of(first), revision_of(second)};
}

double apart_until(const Bodies& bodies, const BoundRef& a, const BoundRef& b, double now) {
  return bodies.table().comes_before(b.number, a.number) ? apart_until_in_order(bodies, b, a, now)
                                                         : apart_until_in_order(bodies, a, b, now);
}

/// Returns apart_until() of two bodies that may meet if the balls around them decide, otherwise nullopt. They
/// decide for pairs whose swept spheres do not touch: a search may find some of these or none, and the fact
/// has to be the same.
[[gnu::noinline]] std::optional<double> PairCertifier::apart_by_balls(BoundRef a, BoundRef b) const {
  const Body& one = bodies()[a.number];
  const Body& other = bodies()[b.number];
  if (one.is_static() || other.is_static() || std::min(a.end, b.end) == infinity) return std::nullopt;
  const double until = kinesphere::apart_until(bodies(), a, b, time_);
  // What a shape that does not turn says costs little more, and is better than a time of the ball around it.
  const bool decides = one.has_shape() || other.has_shape() ? until == infinity : until > time_;
  return decides ? std::optional(until) : std::nullopt;
}

/// Computes apart_until() for two bodies that may meet, in the order of their names. Compiled into its
/// callers, since it is the engine's inner loop.
[[gnu::always_inline]] inline double PairCertifier::apart_until(const BoundRef& a, const BoundRef& b) const {
  const double end = std::min(a.end, b.end);
  const Body& one = bodies()[a.number];
  const Body& other = bodies()[b.number];
  if (one.is_shaped() || other.is_shaped() || end == infinity) {
    if (const auto known = apart_by_balls(a, b)) return *known;
    const double until = unchanged_until_by_thresholds(a.number, b.number);
    return until < end ? until : infinity;
  }
  return apart_until_in_order(bodies(), a, b, time_);
}

double PairCertifier::apart_until(std::uint32_t a, std::uint32_t b) const {
  // The order of the two is fixed, so that the result is bit-identical whichever body found the other.
  if (bodies().table().comes_before(b, a)) std::swap(a, b);
  if (!bodies().may_meet(a, b)) return infinity;
  return log_ == nullptr ? apart_until(bound_ref_without_log(a), bound_ref_without_log(b))
                         : apart_until(bound_ref(a), bound_ref(b));
}

bool PairCertifier::needs_thresholds(std::uint32_t a, std::uint32_t b) const {
  const bool are_balls = !bodies()[a].is_shaped() && !bodies()[b].is_shaped();
  if ((are_balls && earliest_window_end(a, b) < infinity) || !bodies().may_meet(a, b)) return false;
  return !apart_by_balls(bound_ref(a), bound_ref(b));
}

double PairCertifier::unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const {
  const double end = earliest_window_end(a, b);
  double first = infinity;
  if (!bodies().may_meet(a, b)) return first;
  visit_pair(bodies(), a, b, [&](const Bound& bound, const auto& other) {
    for_each_threshold(a, b, [&](const Threshold& threshold) {
      const ContactPredictor predictor(contacts().rule(), threshold, bound, other, time_, {end, end});
      first = std::min(first, predictor.until_reports());
    });
  });
  return first;
}

double PairCertifier::walls_unchanged_until(std::uint32_t number) const {
  if (contacts().walls_of(number) != 0) return time_;
  const Bound& bound = bodies()[number].bound;
  const double end = walls_end_of(number);
  const double outer = until_reports_of_walls(contacts().rule(), bound, *bodies().walls(), time_, end);
  if (outer > time_ || !bodies()[number].is_rigid) return outer;
  // The ball around a rigid body may reach beyond a wall that its parts do not touch.
  double first = infinity;
  const Box near = walls_in_reach(contacts().rule(), bound, *bodies().walls(), time_, end);
  for (const Wall wall : walls) {
    if (!stands(near, wall)) continue;
    visit_wall(collision_shape_of(bodies(), number), half_space(near, wall),
               [&](const Bound& ball, const auto& partner) {
                 const ContactPredictor predictor(contacts().rule(), {.within = false}, ball, partner, time_,
                                                  {end, end});
                 first = std::min(first, predictor.until_reports());
               });
  }
  return first;
}

[[gnu::noinline]] bool PairCertifier::bounce_apart(std::uint32_t a, std::uint32_t b) const {
  if (bodies().sensors.any() || wants_ends(bodies().wanted_of(a, b))) return false;
  const Bound& bound = *bound_ref(a).bound;
  Bound other = *bound_ref(b).bound;
  if (bodies().space().repeats())
    other.position += bodies().space().shift_to_nearest(other.centre_at(time_), bound.centre_at(time_));
  return bodies().are_balls() && recede_for_good(bound, other, time_);
}

double PairCertifier::certify(std::uint32_t a, std::uint32_t b, SearchResults& found) const {
  ++found.candidates;
  const double until = apart_until(a, b);
  if (until == infinity) return until;
  ++found.near;
  if (are_linked(a, b)) {
    if (found.keeps_linked) found.linked.push_back(certificate(until, a, b));
    return infinity;
  }
  if (until <= time_ && bounce_apart(a, b)) return infinity;
  found.certificates.push_back(certificate(until, a, b));
  ++found.certified;
  return until;
}

/// Linked partners can be outside the swept sphere, so they come from the contact graph, not from the search.
void PairCertifier::certify_linked(std::uint32_t number, SearchResults& found) const {
  const auto add = [&](std::uint32_t other) {
    // If both bodies are marked as visited, the first one certifies the pair.
    if (!windows_.contains(other) ||
        (bodies()[other].visited && bodies().table().comes_before(other, number)))
      return;
    const double until = unchanged_until_by_thresholds(number, other);
    if (until < earliest_window_end(number, other))
      found.certificates.push_back(certificate(until, number, other));
  };
  for (const ContactRecord& contact : contacts().partners_of(number)) add(contact.partner);
  const auto crossed = contacts().overlaps_of(number);
  for (std::size_t k = 0; k < crossed.size(); ++k) {
    const std::uint32_t other = crossed[k].partner;
    if (k > 0 && other == crossed[k - 1].partner) continue;
    if (!contacts().touch(number, other)) add(other);
  }
}

void PairCertifier::certify_walls(std::uint32_t number, SearchResults& found) const {
  if (!bodies().meets_walls(number)) return;
  const double until = walls_unchanged_until(number);
  if (until < walls_end_of(number))
    found.certificates.push_back(certificate(until, number, PairCertificate::walls));
}

}  // namespace kinesphere
