// Decides when a contact begins and ends from gap and approach speed. No other code makes this decision.
#pragma once

#include <algorithm>

#include "contact/contact_state.hpp"
#include "kinesphere/contact_events.hpp"
#include "kinesphere/world_definition.hpp"

namespace kinesphere {

/// A change to predict between a body and its partner: leaving (`within`) or entering a gap of `distance`
/// (length). Distance 0 is contact unless `sensed`.
struct Threshold {
  bool within;
  double distance = 0.0;
  bool sensed = false;
  /// The two have come to this distance and have been turned back (ContactGraph::turn_back()): they may still
  /// be beyond it, on their way back. Then they cross it only if they move on away from where they came from.
  bool is_turned = false;
  ContactEvents wanted = ContactEvents::begin_and_end;
  /// State of the contact, if `within`. A sensor overlap has the state of a contact that was reported.
  ContactState state{.approach = ApproachState::reported};

  /// True if an approach within the threshold would be an event.
  bool is_watched() const { return within && state.approach == ApproachState::watched; }
};

/// The lengths and times behind the guarantee, resolved from a WorldDefinition. A "pair" is two bodies, or a
/// body and a wall, with fresh reports.
class ContactRule {
 public:
  explicit ContactRule(const WorldDefinition& definition);

  /// `release` is an end without an event: two bodies that ask for no ends have separated, or no longer
  /// approach and are not inside each other.
  enum class Change { none, begin, end, release };
  /// Decides the change of a pair. `gap` is a length from the threshold's distance, speeds are length / time.
  /// `approach_error` bounds the rounding error of the approach speed (approach_error() in
  /// contact_event.hpp).
  Change decide(const Threshold& threshold, double gap, double approach_speed,
                double approach_error = 0.0) const;
  /// True if the two approach. An approach that rounding alone could produce does not count, unless
  /// step_breaks_tolerance(gap).
  bool is_approach(double gap, double approach_speed, double approach_error) const {
    return approach_speed > (step_breaks_tolerance(gap) ? 0.0 : approach_error);
  }

  /// True for two without a contact that lie so deep in each other as no motion brings them: one of the two
  /// has been put there. That is a begin, whether they approach or not.
  bool is_inside(double gap) const { return gap < -tolerance_; }

  /// Of a threshold at which two have been turned back: true if they are back where they came from, a gap of
  /// at most the tolerance from the distance or, if they came from outside, a larger one.
  bool is_back(const Threshold& turned, double gap) const { return (gap <= tolerance_) == turned.within; }
  /// Gaps from the distance, in tolerances, that two who have been turned back have certainly not reached
  /// until they are next looked at, on the side that they come from.
  static constexpr double back_inside = 0.5, back_outside = 1.5;
  /// The farthest gap that they have certainly not reached then on the other side (length): beyond that of
  /// all first crossings, or hardly farther than where they are. So two that swing about each other, and come
  /// out again where they were turned back, get no farther.
  double farthest_turned(const Threshold& turned, double gap) const {
    const double hardly = 0x1p-20 * tolerance_;
    return turned.within ? std::max(release_gap() + tolerance_, gap + hardly)
                         : std::min(-tolerance_, gap - hardly);
  }
  /// By so much they may get farther, in tolerances, where time would otherwise stop.
  static constexpr double farther = 0.125;

  /// Contact tolerance (length).
  double tolerance() const { return tolerance_; }

  /// Gap at which a contact ends (length).
  double separation_distance() const { return separation_distance_; }

  /// Gap that a touching pair cannot exceed before its certificate fails (length).
  double release_gap() const { return separation_distance_ + tolerance_; }

  /// Returns the gap that the certificate of a separate pair must guard: 0 outside the tolerance. Bouncing
  /// bodies that part within the tolerance may come back to half the tolerance inside or, if already nearly
  /// that deep, to slightly below where they are: so each bounce of a resting body starts where the previous
  /// one did.
  double guarded_gap(double gap) const;

  /// True for a pair so deep that the guarded gap lies outside the tolerance. That guarded gap is valid only
  /// while the gap stays below surface_gap(): above it, the next approach counts again.
  bool is_deep(double gap) const { return guarded_gap(gap) < -tolerance_; }
  double surface_gap() const { return -0.5 * tolerance_; }

  /// The Zeno guard: returns the minimum time between two checks of a pair within the tolerance that does not
  /// approach. `speed_error` is the sum of the velocity errors and of the approach that rounding may hide,
  /// `acceleration` the sum of the largest accelerations. In this time the gap shrinks by at most `sinking`
  /// of the tolerance. Returns 0 outside the tolerance or if both sums are 0.
  double least_step(double gap, double speed_error, double acceleration, double sinking = most_sinking) const;
  static constexpr double most_sinking = 0.125;
  /// What a step may sink that is as short as the fastest of several points needs it to be. Smaller values
  /// make more checks of a body that rocks on an edge; larger ones let a body that lands on several points in
  /// turn sink deeper.
  static constexpr double least_sinking = 0x1p-6;
  /// Returns what a step of a body of several points may sink from this gap, in tolerances: less where there
  /// is less room, since a point that is answered can push another one down, again and again.
  double sinking_of_several(double gap) const {
    return std::clamp(0.25 * (1.0 + gap / tolerance_), least_sinking, most_sinking);
  }

  /// Returns a lower bound of the time after which two bodies can have separated whose points move relative
  /// to each other at this speed at most, and gain speed by this acceleration at most. Infinity if both are
  /// 0.
  double least_time_to_separate(double gap, double speed, double acceleration) const;

  /// True if a least_step() from this gap may leave the tolerance, which the caller must be notified of.
  bool step_breaks_tolerance(double gap, double sinking = most_sinking) const {
    return gap < -(1.0 - sinking) * tolerance_;
  }

  /// Returns the interval (time) within which a contact counts as repeated after the previous one of a body
  /// with this largest acceleration (limit plus plan). A body that was stopped within the tolerance falls by
  /// at most 3/2 of it to the guarded gap. A hop from there and back takes twice that time, sqrt(12 tolerance
  /// / acceleration). The interval is at least that long, so all contacts of such a body count as repeated.
  double zeno_interval(double acceleration) const;
  /// Returns the interval of the world's definition (time), within which contacts of any speed are repeated.
  double least_zeno_interval() const { return zeno_interval_; }
  /// Returns an approach speed (length / time) above that of each hop within the tolerance, of two that are
  /// pressed upon each other with this acceleration: the fall of zeno_interval() ends with sqrt(3 tolerance
  /// acceleration), and this is 4 sqrt(tolerance acceleration).
  double zeno_speed(double acceleration) const;

 private:
  double tolerance_;
  double separation_distance_;
  double zeno_interval_;
};

}  // namespace kinesphere
