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

  bool are_linked(std::uint32_t a, std::uint32_t b) const { return contacts().are_linked(a, b); }
  /// Calls visit(threshold) for each threshold that two bodies can cross next: their contact, the next sensor
  /// distance inward, and the next one outward. Precondition: the two may meet.
  template <class Visit>
  void for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const;
  /// Returns the time before which two unlinked bodies neither touch nor sense each other; +infinity if they
  /// do not before the own time of either. Returns the current time if only fresh reports can decide. The
  /// result is bit-identical for either order of arguments.
  double apart_until(std::uint32_t a, std::uint32_t b) const;
  /// Returns true if the next event of two near bodies would be an approach, and they recede for good: a
  /// response has just parted them.
  bool bounce_apart(std::uint32_t a, std::uint32_t b) const;
  /// Returns the time before which no threshold of the two is crossed, by the contact rules; +infinity if
  /// none is before the own time of either. Valid for linked and unlinked pairs.
  double unchanged_until_by_thresholds(std::uint32_t a, std::uint32_t b) const;
  /// Returns the time before which the body neither touches nor leaves a wall; the current time if it touches
  /// one. Precondition: the world has walls.
  double walls_unchanged_until(std::uint32_t number) const;

 private:
  bool are_within_in_flight(std::uint32_t a, std::uint32_t b) const;
  double within_in_flight_until(std::uint32_t a, std::uint32_t b) const;
  double apart_until_in_order(std::uint32_t a, std::uint32_t b, double end) const;
  std::optional<double> apart_by_balls(std::uint32_t a, std::uint32_t b, double end) const;
  const Bodies& bodies() const { return state_.bodies; }
  const ContactGraph& contacts() const { return state_.contacts; }

  const WorldState& state_;
  double time_;
};

template <class Visit>
void PairCertifier::for_each_threshold(std::uint32_t a, std::uint32_t b, Visit visit) const {
  if (bodies()[a].solid && bodies()[b].solid)
    visit(contacts().contact_threshold(a, b, bodies().wanted_of(a, b)));
  if (!bodies().sensors.any()) return;
  const OverlapRecords::List crossed = contacts().overlaps_of(a, b);
  const double turned_at = contacts().pairs().between(a, b).turned_at;
  const auto sensed = [&](bool within, double distance) {
    visit(Threshold{
        .within = within, .distance = distance, .sensed = true, .is_turned = turned_at == distance});
  };
  if (const auto next =
          bodies().sensors.next_inward(sensing_of(bodies(), a), sensing_of(bodies(), b), crossed))
    sensed(false, *next);
  if (!crossed.empty()) sensed(true, crossed.back().distance);
}

}  // namespace kinesphere
