// When a contact begins and ends: the one place where distances and approach become a decision.
#pragma once

#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// The lengths and times behind the promise, resolved from a WorldDefinition. "Pair" is two bodies, or a body
/// and a wall, with fresh reports.
class ContactRule {
 public:
  explicit ContactRule(const WorldDefinition& definition);

  /// `release` is an end that nobody is told of: bouncing bodies that have been turned apart.
  enum class Change { none, begin, end, release };
  /// `approach_error` is how much rounding may have done to the approach speed (approach_error() in
  /// contact_event.hpp): bouncing bodies whose approach may be made by rounding alone do not approach, unless
  /// they are as deep as step_breaks_tolerance().
  Change decide(bool touching, double gap, double approach_speed, double approach_error = 0.0) const;

  /// The contact tolerance.
  double tolerance() const { return tolerance_; }

  /// The gap at which a contact ends.
  double separation_distance() const { return separation_distance_; }

  /// For a pair that touches: the gap that it cannot exceed before its certificate ends.
  double release_gap() const { return separation_distance_ + tolerance_; }

  bool impacts_only() const { return impacts_only_; }

  /// The rule for sensor distances, beyond which gaps count from there: every begin has an end.
  ContactRule with_ends() const {
    ContactRule rule = *this;
    rule.impacts_only_ = false;
    return rule;
  }

  /// For a pair that is apart: the gap that a certificate must guard, 0 outside the tolerance. Bouncing
  /// bodies that leave each other within it may come back as far as half the tolerance inside or, when they
  /// are nearly that deep, to where they are: so each bounce of a resting body starts where the last one did.
  double guarded_gap(double gap) const;

  /// True for a pair so deep that the guarded gap lies outside the tolerance. That gap is good for it only as
  /// long as it stays below surface_gap(): when it has come out, the next approach counts again.
  bool is_deep(double gap) const { return guarded_gap(gap) < -tolerance_; }
  double surface_gap() const { return -0.5 * tolerance_; }

  /// The Zeno guard: the least time between two looks at a pair within the tolerance that does not approach,
  /// with these sums of velocity errors (and of what rounding may hide of an approach) and largest
  /// accelerations. In it the gap shrinks by at most 1/8 of the tolerance.
  double least_step(double gap, double speed_error, double acceleration) const;

  /// True when a least step from this gap may leave the tolerance, so that the caller must be told.
  bool step_breaks_tolerance(double gap) const { return gap < -0.875 * tolerance_; }

  /// A contact that comes sooner than this after the last one of a body with this largest acceleration (limit
  /// and plan) is a repeated one. A body that was stopped dead within the tolerance falls by at most 3/2 of
  /// it to the guarded gap, and a hop from there and back takes twice that time, sqrt(12 tolerance /
  /// acceleration): all of its contacts must count as repeated.
  double zeno_interval(double acceleration) const;

 private:
  bool approach(double gap, double approach_speed, double approach_error) const {
    return approach_speed > (step_breaks_tolerance(gap) ? 0.0 : approach_error);
  }

  double tolerance_;
  double separation_distance_;
  double zeno_interval_;
  bool impacts_only_;
};

}  // namespace kinesphere
