#include "processor/pair_certifier.hpp"

#include <utility>

#include "bound/straight_pair.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

/// Computes apart_until() for two bodies, of which the bounds decide until `end`.
[[gnu::always_inline]] inline double PairCertifier::apart_until_in_order(std::uint32_t a, std::uint32_t b,
                                                                         double end) const {
  const double sensed = reach_of_pair(bodies(), a, b);
  BoundAt moved(bodies()[b].bound, time_);
  if (const Space& space = bodies().space(); space.repeats())
    move_to_image(space, shift_to_meet(bodies(), a, b, time_), moved);
  const QuickReject pair(BoundAt(bodies()[a].bound, time_), moved);
  const double near = sensed + bodies().definition().contact_tolerance;
  if (pair.stay_apart(end - time_, near)) return infinity;
  if (pair.is_near(near)) return time_;
  const double until =
      rounding::sum_down(time_, pair.meeting(end - time_, sensed + rounding_margin(bodies().definition())));
  return until < end ? std::max(until, time_) : infinity;
}

/// Returns apart_until() of two bodies that may meet if the balls around them decide, otherwise nullopt.
[[gnu::noinline]] std::optional<double> PairCertifier::apart_by_balls(std::uint32_t a, std::uint32_t b,
                                                                      double end) const {
  const Body &one = bodies()[a], &other = bodies()[b];
  if (one.is_static() || other.is_static() || end == infinity) return std::nullopt;
  const double until = apart_until_in_order(a, b, end);
  // What a shape that does not turn says costs little more, and is better than a time of the ball around it.
  const bool decides = one.has_shape() || other.has_shape() ? until == infinity : until > time_;
  return decides ? std::optional(until) : std::nullopt;
}

double PairCertifier::apart_until(std::uint32_t a, std::uint32_t b) const {
  // The order of the two is fixed, so that the result is bit-identical whichever body found the other.
  if (bodies().table().comes_before(b, a)) std::swap(a, b);
  if (!bodies().may_meet(a, b)) return infinity;
  const double end = earlier_own_time(a, b);
  if (!bodies()[a].is_shaped() && !bodies()[b].is_shaped() && end < infinity)
    return apart_until_in_order(a, b, end);
  if (const auto known = apart_by_balls(a, b, end)) return *known;
  const double until = unchanged_until(a, b, contacts().links_of(a, b));
  return until < end ? until : infinity;
}

/// Returns true for two balls in exact flight, straight on relative to each other, that sense each other and
/// do not touch.
bool PairCertifier::are_within_in_flight(std::uint32_t a, std::uint32_t b, const PairLinks& links) const {
  if (links.overlaps.empty() || links.contact != nullptr) return false;
  const Body &one = bodies()[a], &other = bodies()[b];
  return one.bound.is_exact() && other.bound.is_exact() && !one.is_shaped() && !other.is_shaped() &&
         one.bound.planned_acceleration == other.bound.planned_acceleration && !bodies().radii.any();
}

/// Computes unchanged_until() for two that are are_within_in_flight().
double PairCertifier::within_in_flight_until(std::uint32_t a, std::uint32_t b, const PairLinks& links) const {
  if (bodies().table().comes_before(b, a)) std::swap(a, b);
  const Bound &one = bodies()[a].bound, &other = bodies()[b].bound;
  const State first{one.centre_at(time_), one.velocity_at(time_)};
  State second{other.centre_at(time_), other.velocity_at(time_)};
  if (const Space& space = bodies().space(); space.repeats())
    space.move(second, shift_to_meet(bodies(), a, b, time_));
  const StraightPair pair(second.position - first.position, second.velocity - first.velocity,
                          one.radius + other.radius);
  const double margin = rounding_margin(bodies().definition()), tolerance = contacts().rule().tolerance();
  double until = infinity;
  for_each_threshold(a, b, links, [&](const Threshold& threshold) {
    const auto stays_for = [&] {
      if (threshold.is_turned) return 0.0;
      if (threshold.within) return pair.parting(threshold.distance + contacts().rule().release_gap(), margin);
      if (!pair.are_near(threshold.distance + tolerance)) return pair.meeting(threshold.distance, margin);
      const bool only_approaches = !threshold.sensed && !wants_ends(threshold.wanted);
      const bool may_be_inside = pair.are_near(threshold.distance - tolerance);
      return only_approaches && !may_be_inside && recede_for_good(first, second) ? infinity : 0.0;
    };
    until = std::min(until, std::max(rounding::sum_down(time_, stays_for()), time_));
  });
  return until;
}

double PairCertifier::unchanged_until(std::uint32_t a, std::uint32_t b, const PairLinks& links) const {
  if (!bodies().may_meet(a, b)) return infinity;
  if (are_within_in_flight(a, b, links)) return within_in_flight_until(a, b, links);
  const double end = earlier_own_time(a, b);
  double first = infinity;
  visit_pair(bodies(), a, b, time_, [&](const Bound& bound, const auto& other) {
    for_each_threshold(a, b, links, [&](const Threshold& threshold) {
      const ContactPredictor predictor(contacts().rule(), threshold, bound, other, time_, {end, end});
      first = std::min(first, predictor.until_reports());
    });
  });
  return first;
}

double PairCertifier::walls_unchanged_until(std::uint32_t number) const {
  if (contacts().walls_of(number) != 0) return time_;
  const Bound& bound = bodies()[number].bound;
  const double end = own_time(number);
  const double outer = until_reports_of_walls(contacts().rule(), bound, *bodies().walls(), time_, end);
  if (outer > time_ || !bodies()[number].has_parts()) return outer;
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
  const Bound& bound = bodies()[a].bound;
  Bound other = bodies()[b].bound;
  if (const Space& space = bodies().space(); space.repeats())
    space.move(other, space.shift_to_nearest(other.centre_at(time_), bound.centre_at(time_), time_), time_);
  return bodies().are_balls() && recede_for_good(bound, other, time_) &&
         !QuickReject(BoundAt(bound, time_), BoundAt(other, time_)).is_near(-contacts().rule().tolerance());
}

}  // namespace kinesphere
