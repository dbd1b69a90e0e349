// How long what is known of a contact stays true: from bounds as they are, and from fresh reports.
#pragma once

#include <limits>

#include "contact/contact_rule.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/event.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

/// How far the bodies of a contact may stray from their paths together.
struct RelativeLimits {
  double speed_error;
  double acceleration;
};

/// How far an outlook has to reach: it is of no use beyond.
struct Horizon {
  double meeting = std::numeric_limits<double>::infinity();
  double separation = std::numeric_limits<double>::infinity();
};

/// What fresh reports say of a threshold.
struct ContactDecision {
  /// A begin or an end has to be delivered first; then no time is known.
  ContactRule::Change change = ContactRule::Change::none;
  /// Else: it cannot be crossed before this.
  double next_check = 0.0;
  /// The Zeno guard has put next_look off, and in the second case by so much that the caller must be told.
  bool zeno_step = false;
  bool breaks_tolerance = false;

  bool is_event() const { return change == ContactRule::Change::begin || change == ContactRule::Change::end; }
};

/// What may change between a body and its partner: whether their gap is within a distance. 0 is their
/// contact, all others are sensor distances.
struct Threshold {
  bool within;
  double distance = 0.0;
  bool sensed = false;
};

/// The kind of event that announces a change, a begin or an end: of a sensor distance, or of a contact with a
/// body or with `wall`.
EventKind kind_of(ContactRule::Change change, bool sensed, Wall wall);

/// A body and its partner, another body's Bound, the HalfSpace inside a wall or a shape at rest, seen from
/// now on.
template <class Partner>
class ContactPredictor {
 public:
  ContactPredictor(const ContactRule& rule, const Threshold& threshold, const Bound& bound,
                   const Partner& partner, double now, const Horizon& horizon)
      : rule_(rule), threshold_(threshold), bound_(bound), partner_(partner), now_(now), horizons_(horizon) {}

  /// From bounds as they are: the threshold cannot be crossed before this time. `now` when fresh reports
  /// are needed: bounds that keep away from where the contact changes give a useful certificate; if they do
  /// not, it may be as short as one likes, and with fresh reports the rule decides, or the certificate spans
  /// a tolerance.
  double until_reports() const;

  /// From fresh reports; `current` is an event that describes the two now.
  ContactDecision decide(const Event& current, const RelativeLimits& promise) const;

  /// For two that touch too often at this instant: the Zeno guard lets their gap shrink, by no more than it
  /// may, before the next contact can begin.
  ContactDecision defer(const Event& current, const RelativeLimits& promise) const;

 private:
  double meeting(double gap) const {
    return earliest_meeting(bound_, partner_, now_, horizons_.meeting, gap + threshold_.distance);
  }
  double separation(double gap) const {
    return earliest_separation(bound_, partner_, now_, horizons_.separation, gap + threshold_.distance);
  }
  double arm(double gap) const;
  double resolution() const;

  const ContactRule& rule_;
  Threshold threshold_;
  const Bound& bound_;
  const Partner& partner_;
  double now_;
  Horizon horizons_;
};

extern template class ContactPredictor<Bound>;
extern template class ContactPredictor<HalfSpace>;
extern template class ContactPredictor<Box>;
extern template class ContactPredictor<Triangle>;

/// The walls of the box to which the body may come as near as the tolerance before `until`: the box,
/// without end on all other axes. A quick test; it may name some too many.
Box walls_in_reach(const ContactRule& rule, const Bound& bound, const Box& box, double now, double until);

/// ContactPredictor::until_reports for a body that touches none of the walls of the box, all walls at once.
double until_reports_of_walls(const ContactRule& rule, const Bound& bound, const Box& box, double now,
                              double until);

/// The least time after this one.
double just_after(double time);

}  // namespace kinesphere
