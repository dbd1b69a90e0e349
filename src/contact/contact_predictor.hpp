// How long the state of a contact is certain not to change: from present bounds, and from fresh reports.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "bound/rigid_certificates.hpp"
#include "contact/contact_rule.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// Returns the smallest double greater than `time`; infinity and NaN are returned unchanged.
double just_after(double time);

/// Limits on how far the two bodies of a contact can deviate from their predicted relative motion.
struct RelativeLimits {
  double speed_error;
  double acceleration;
  double radius_rates = 0.0;   ///< sum of the magnitudes of the rates at which the radii change
  double excess_growth = 0.0;  ///< see ContactPredictor()
};

/// Horizon of a prediction, per kind of search: a time later than the horizon counts as never.
struct Horizon {
  double meeting = std::numeric_limits<double>::infinity();
  double separation = std::numeric_limits<double>::infinity();
};

/// Decision about a threshold from fresh reports.
struct ContactDecision {
  /// If `change` is begin or end, that event must be delivered first, and the other members mean nothing.
  ContactRule::Change change = ContactRule::Change::none;
  /// Otherwise, the threshold cannot be crossed before this time.
  double next_check = 0.0;
  /// What the next approach means from now on, if the two stay in touch.
  ApproachState approach = ApproachState::reported;
  /// `zeno_step`: the Zeno guard has postponed next_check. `breaks_tolerance`: the gap may leave the
  /// tolerance until then, which the caller must be notified of.
  bool zeno_step = false;
  bool breaks_tolerance = false;

  bool is_event() const { return change == ContactRule::Change::begin || change == ContactRule::Change::end; }
};

/// Returns the kind of event for a begin or an end of a sensor overlap, or of a contact with a body or with
/// `wall`.
EventKind kind_of(ContactRule::Change change, bool sensed, Wall wall);

/// Predicts one threshold between a body and a partner from `now` on. A partner is another body's Bound, the
/// HalfSpace inside a wall or of a static body, a Placed solid, or the RigidPair of the two. Holds references
/// to rule, bound and partner.
template <class Partner>
class ContactPredictor {
 public:
  /// `excess_growth` is the speed (length / time) by which the two bounds grow faster than the bodies do, up
  /// to the horizon of a meeting: positive if a radius shrinks. It must be 0 unless both reports are fresh.
  ContactPredictor(const ContactRule& rule, const Threshold& threshold, const Bound& bound,
                   const Partner& partner, double now, const Horizon& horizon, double excess_growth = 0.0)
      : rule_(rule),
        threshold_(threshold),
        bound_(bound),
        partner_(partner),
        now_(now),
        horizons_(horizon),
        excess_growth_(excess_growth) {}

  /// Returns a time before which the threshold cannot be crossed, from the present bounds; `now` if fresh
  /// reports are needed. The bounds give a useful certificate only while they are clear of the gap at which
  /// the contact changes. Nearer than that, their certificate can be arbitrarily short, whereas with fresh
  /// reports the rule decides or the certificate spans a tolerance.
  double until_reports() const;

  /// Returns the next check of two bodies that fresh reports show to be apart, as decide() would; nullopt if
  /// an event may be due.
  std::optional<double> next_check_if_apart() const;

  /// Decides from fresh reports. `current` is an event that describes the pair now.
  ContactDecision decide(const Event& current, const RelativeLimits& limits) const;

  /// Defers the begin of a jammed contact: the Zeno guard lets the gap shrink, by at most its limit, before
  /// the next check, which comes before the two have separated.
  ContactDecision defer(const Event& current, const RelativeLimits& limits) const;

  /// Returns a time after `now` before which the two do not separate.
  double until_separated() const { return std::max(separation(rule_.release_gap()), just_after(now_)); }

 private:
  ContactDecision decide_turned(double beyond, double approach_speed, double error) const;
  double meeting(double gap) const;
  double separation(double gap) const {
    return earliest_separation(bound_, partner_, now_, horizons_.separation, gap + threshold_.distance);
  }
  double arm(double gap) const;
  bool hides_depth(double gap) const;
  double resolution() const;
  double largest_speed(const RelativeLimits& limits) const;
  double sinking_from(double gap) const;
  double least_check(double time, double gap, double guarded, double speed_error,
                     const RelativeLimits& limits) const;
  double earliest_sinking_below(const Sinking& sinking, double until) const;
  /// Rounding margins count a falling radius as one that grows less; what they lack is far below the part
  /// that is left of the excess.
  double true_excess() const { return (1.0 - 0x1p-44) * excess_growth_; }
  double soonest_check(double gap, const RelativeLimits& limits) const;
  double separated(double gap, const RelativeLimits& limits) const;

  const ContactRule& rule_;
  Threshold threshold_;
  const Bound& bound_;
  const Partner& partner_;
  double now_;
  Horizon horizons_;
  double excess_growth_;
};

/// Returns true if two spheres recede by more than rounding could hide. If they go on without accelerating
/// relative to each other, their gap never shrinks again.
bool recede_for_good(const State& first, const State& second);
/// Returns that of exact bounds with the same planned acceleration; false for others.
bool recede_for_good(const Bound& a, const Bound& b, double now);

/// Returns the walls of the box that the body may come within the tolerance of before `until`, as the box
/// with infinite limits on all other axes. Conservative: may include walls that are not reached. Cost: O(1),
/// without roots.
Box walls_in_reach(const ContactRule& rule, const Bound& bound, const Box& box, double now, double until);

/// Evaluates ContactPredictor::until_reports for all walls of the box at once. Precondition: the body touches
/// none of them.
double until_reports_of_walls(const ContactRule& rule, const Bound& bound, const Box& box, double now,
                              double until);

}  // namespace kinesphere
