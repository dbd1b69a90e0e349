// The events of the present instant on their way to the caller.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "contact/contact_graph.hpp"
#include "contact/event_set.hpp"

namespace kinesphere {

class PendingEvents {
 public:
  /// Forgets all.
  void clear() {
    pending_.clear();
    ended_.clear();
    delivered_guards_.clear();
    changed_.clear();
  }
  /// Time moves on.
  void start() { delivered_guards_.clear(); }
  /// Queues an event; the same event is not queued twice.
  void queue(const Event& event);
  /// Queues one that has happened: it comes before all that are announced, with the states that it has.
  void queue_first(const Event& event) { ended_.insert(event); }
  const EventSet& pending() const { return pending_; }
  /// What is pending about `body` and another, and does not hold any more, is dropped.
  template <class Holds>
  void drop_pending(std::uint32_t body, Holds holds) {
    pending_.erase_if([&](const Event& event) {
      return event.second != no_body && (event.first.index == body || event.second.index == body) &&
             !holds(event);
    });
  }
  /// Nothing is to be delivered.
  bool is_quiet() const { return ended_.empty() && pending_.empty(); }

  /// The caller is about to change a body, and those of its contacts and crossings end with that whose end
  /// `ends`(Event) picks. `sphere(number)` gives a body as it is before the change.
  template <class SphereNow, class Ends>
  void end_contacts(ContactGraph& book, std::uint32_t body, double time, SphereNow sphere,
                    const std::optional<Box>& box, Ends ends) {
    for (const Event& event : ends_of(book, body, time, sphere, box))
      if (ends(event)) end(book, event);
  }
  /// The body is about to go, and all its contacts end.
  template <class SphereNow>
  void remove_body(ContactGraph& book, std::uint32_t body, double time, SphereNow sphere,
                   const std::optional<Box>& box) {
    end_contacts(book, body, time, sphere, box, [](const Event&) { return true; });
  }

  /// The next event that still holds after what the caller did at the ones before it; first of all the ends
  /// that the caller brought about, which stay as they were then. `is_there(id)` tells whether a body has not
  /// gone, `sphere(number)` gives it as it is now, `senses_in(event)` tells whose sensor the two enter.
  template <class IsThere, class SphereNow, class SensesIn>
  std::optional<Event> pop(ContactGraph& book, IsThere is_there, SphereNow sphere, SensesIn senses_in,
                           const std::optional<Box>& box) {
    std::optional<Event> event;
    if (!ended_.empty()) {
      event = ended_.extract(ended_.begin()).value();
      return event;
    }
    while (!pending_.empty()) {
      event = pending_.take_first();
      const bool alone = event->second == no_body;
      if (is_there(event->first) && (alone || is_there(event->second))) {
        const Sphere first = sphere(book.number_of(event->first));
        if (event->kind == EventKind::sensor_enter) event->senses = senses_in(*event);
        if (event->kind == EventKind::sensor_leave) event->senses = senses_at_enter(book, *event);
        if (take_effect(book, *event, first, alone ? first : sphere(book.number_of(event->second)), box))
          return event;
      } else if (!begins(event->kind) && event->kind != EventKind::zeno_guard) {
        return event;
      }
    }
    event.reset();
    return event;
  }

  /// The same where nothing is sensed.
  template <class IsThere, class SphereNow>
  std::optional<Event> pop(ContactGraph& book, IsThere is_there, SphereNow sphere,
                           const std::optional<Box>& box) {
    return pop(
        book, is_there, sphere, [](const Event&) { return Senses::neither; }, box);
  }

  /// Pairs (a body and itself: its walls) whose contact has been changed by a delivered event, so that
  /// nothing is known of them; for the caller to take out.
  std::vector<std::pair<std::uint32_t, std::uint32_t>>& changed() { return changed_; }
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& changed() const { return changed_; }

  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [pending, ended, guards_told, changed] = self;
    archive(pending, ended, guards_told, changed);
  }
  /// For one that was read in a world of this many bodies at `time`: true when events are such as could be
  /// announced now. `box` has the walls that stand; `is_known(id)` tells whether an id was ever given out.
  bool is_valid(std::size_t bodies, double time, const std::optional<Box>& box,
                const std::function<bool(BodyId)>& is_known) const;

 private:
  /// The ends of all contacts and crossings of the body, if they were to end now. `sphere(number)` gives a
  /// body as it is.
  template <class SphereNow>
  static std::vector<Event> ends_of(const ContactGraph& book, std::uint32_t body, double time,
                                    SphereNow sphere, const std::optional<Box>& box) {
    const auto end_with = [&](EventKind kind, std::uint32_t partner) {
      return contact_event(kind, time, sphere(body), sphere(partner), book.space());
    };
    std::vector<Event> found;
    for (const std::uint32_t partner : book.partners_of(body))
      found.push_back(end_with(EventKind::contact_end, partner));
    for (const Wall wall : walls)
      if (book.touches_wall(body, wall))
        found.push_back(wall_event(EventKind::wall_end, time, sphere(body), *box, wall));
    for (const OverlapRecord& overlap : book.overlaps_of(body)) {
      found.push_back(end_with(EventKind::sensor_leave, overlap.partner));
      found.back().distance = overlap.distance;
      found.back().senses = overlap.senses;
    }
    return found;
  }
  static Senses senses_at_enter(const ContactGraph& book, const Event& leave);
  void end(ContactGraph& book, const Event& contact);
  bool take_effect(ContactGraph& book, Event& event, const Sphere& first, const Sphere& second,
                   const std::optional<Box>& box);

  EventSet pending_;
  std::set<Event, DeliveredBefore> ended_;  ///< by the caller's changes; and bodies that have woken
  std::set<Event, DeliveredBefore> delivered_guards_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changed_;
};

}  // namespace kinesphere
