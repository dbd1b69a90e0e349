// PairCertifier computes what is certain of bodies at an instant: how long the contact state of a pair cannot
// change.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "contact/contact_predictor.hpp"
#include "processor/world_state.hpp"

namespace kinesphere {

/// What is certain of two bodies says nothing beyond the own time of either (core::Ball::own), when they are
/// searched for each other again.
class PairCertifier {
 public:
  PairCertifier(const WorldState& state, double time) : state_(state), time_(time) {}

  /// Returns the time until which the body stays in its safe region and meets no wall.
  double own_time(std::uint32_t number) const { return state_.core.balls()[number].own; }
  double earlier_own_time(std::uint32_t a, std::uint32_t b) const {
    return std::min(own_time(a), own_time(b));
  }

  /// Calls visit(threshold) for each threshold that two bodies with these links can cross next: their
  /// contact, the next sensor distance inward, and the next one outward. Precondition: the two may meet.
  template <class Visit>
  void for_each_threshold(std::uint32_t a, std::uint32_t b, const PairLinks& links, Visit visit) const;
  /// Returns the time before which two unlinked bodies neither touch nor sense each other; +infinity if they
  /// do not before the own time of either. Returns the current time if only fresh reports can decide. The
  /// result is bit-identical for either order of arguments.
  double apart_until(std::uint32_t a, std::uint32_t b) const;
  /// Returns true if the next event of two near bodies would be an approach, and they recede for good: a
  /// response has just parted them.
  bool bounce_apart(std::uint32_t a, std::uint32_t b) const;
  /// Returns the time before which no threshold of two bodies with these links is crossed, by the contact
  /// rules; +infinity if none is before the own time of either. Valid for linked and unlinked pairs.
  double unchanged_until(std::uint32_t a, std::uint32_t b, const PairLinks& links) const;
  /// Returns the time before which the body neither touches nor leaves a wall; the current time if it touches
  /// one. Precondition: the world has walls.
  double walls_unchanged_until(std::uint32_t number) const;

 private:
  bool are_within_in_flight(std::uint32_t a, std::uint32_t b, const PairLinks& links) const;
  double within_in_flight_until(std::uint32_t a, std::uint32_t b, const PairLinks& links) const;
  double apart_until_in_order(std::uint32_t a, std::uint32_t b, double end) const;
  std::optional<double> apart_by_balls(std::uint32_t a, std::uint32_t b, double end) const;
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }

  const WorldState& state_;
  double time_;
};

template <class Visit>
void PairCertifier::for_each_threshold(std::uint32_t a, std::uint32_t b, const PairLinks& links,
                                       Visit visit) const {
  if (bodies()[a].solid && bodies()[b].solid)
    visit(contact_threshold(links.contact, bodies().wanted_of(a, b)));
  if (!bodies().sensors.any()) return;
  const auto sensed = [&](bool within, double distance) {
    visit(Threshold{
        .within = within, .distance = distance, .sensed = true, .is_turned = links.turned_at == distance});
  };
  if (links.overlaps.size() < bodies().sensors.distance_count()) {
    if (const auto next =
            bodies().sensors.next_inward(sensing_of(bodies(), a), sensing_of(bodies(), b), links.overlaps))
      sensed(false, *next);
  }
  if (!links.overlaps.empty()) sensed(true, links.overlaps.back().distance);
}

}  // namespace kinesphere
