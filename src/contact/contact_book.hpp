// Who touches whom and who is within a sensor distance of whom, and the events of the present instant on
// their way to the caller.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "contact/chains.hpp"
#include "contact/contact_event.hpp"
#include "contact/contact_rule.hpp"
#include "contact/crossings.hpp"
#include "contact/event_set.hpp"
#include "contact/outlook.hpp"

namespace kinesphere {

class ContactBook {
 public:
  explicit ContactBook(const WorldDefinition& definition)
      : rule_(definition), sensor_rule_(rule_.with_ends()), space_(definition) {}

  /// Of contacts.
  const ContactRule& rule() const { return rule_; }
  const ContactRule& rule_of(const Threshold& threshold) const {
    return threshold.sensed ? sensor_rule_ : rule_;
  }

  void reserve(std::size_t bodies) { entries_.reserve(bodies); }
  /// A body that touches nothing. `largest_acceleration` sets its Zeno interval.
  void add(std::uint32_t body, double largest_acceleration);
  void set_largest_acceleration(std::uint32_t body, double largest_acceleration) {
    entries_[body].zeno_interval = Coarse(rule_.zeno_interval(largest_acceleration));
  }

  /// A fixed body has no contacts of its own: whether one is a repeated one, its partner decides.
  void set_fixed(std::uint32_t body) {
    entries_[body].zeno_interval = Coarse();
    entries_[body].fixed = true;
  }

  // Who touches whom.
  bool touch(std::uint32_t a, std::uint32_t b) const;
  bool touches_wall(std::uint32_t body, Wall wall) const { return (walls_of(body) & wall_bit(wall)) != 0; }
  /// In the order in which the contacts began; good until one begins or ends with the body.
  Chains<std::uint32_t>::List partners_of(std::uint32_t body) const { return partners_.of(body); }
  /// A set of wall_bit().
  std::uint8_t walls_of(std::uint32_t body) const { return entries_[body].walls; }
  /// By partner, of each from the outermost inward; good until the next one.
  Crossings::List crossings_of(std::uint32_t body) const { return crossings_.of(body); }
  /// Those of the two, from the outermost inward. Cost: O(log of the body's), as of is_within().
  Crossings::List crossings_of(std::uint32_t a, std::uint32_t b) const { return crossings_.of(a, b); }
  bool is_within(std::uint32_t a, std::uint32_t b, double distance) const {
    return crossings_.contains(a, {b, distance});
  }
  // They do not touch any more, and nobody is told.
  void release(const Event& contact) { set_touching(contact, false); }
  void release_all(std::uint32_t body);
  /// The caller is about to change a body, and those of its contacts and crossings end with that whose end
  /// `ends`(Event) picks. `sphere(number)` gives a body as it is before the change.
  template <class SphereNow, class Ends>
  void end_contacts(std::uint32_t body, double time, SphereNow sphere, const std::optional<Box>& box,
                    Ends ends) {
    std::vector<Event> found;
    for (const std::uint32_t partner : partners_of(body))
      found.push_back(contact_event(EventKind::contact_end, time, sphere(body), sphere(partner), space_));
    for (const Wall wall : walls)
      if (touches_wall(body, wall))
        found.push_back(wall_event(EventKind::wall_end, time, sphere(body), *box, wall));
    for (const Crossing& crossing : crossings_of(body)) {
      found.push_back(
          contact_event(EventKind::sensor_leave, time, sphere(body), sphere(crossing.partner), space_));
      found.back().distance = crossing.distance;
      found.back().senses = crossing.senses;
    }
    for (const Event& event : found)
      if (ends(event)) end(event);
  }
  /// The body is about to go, and all its contacts end.
  template <class SphereNow>
  void depart(std::uint32_t body, double time, SphereNow sphere, const std::optional<Box>& box) {
    end_contacts(body, time, sphere, box, [](const Event&) { return true; });
  }

  /// Whether a contact that could begin now has to wait for time to move on: each of the two has had so many
  /// at this instant that the caller's answers will not part them.
  bool is_jammed(const Event& current) const { return contacts_now(current) >= most_at_one_instant; }

  // Events of this instant.
  /// Time moves on.
  void start_instant() { guards_told_.clear(); }
  /// Queues an event; the same event is not queued twice.
  void announce(const Event& event);
  /// Queues one that has happened: it comes before all that are announced, with the states that it has.
  void tell(const Event& event) { ended_.insert(event); }
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
  /// The next event that still holds after what the caller did at the ones before it; first of all the ends
  /// that the caller brought about, which stay as they were then. `is_there(id)` tells whether a body has not
  /// gone, `sphere(number)` gives it as it is now, `senses_in(event)` tells whose sensor the two enter.
  template <class IsThere, class SphereNow, class SensesIn>
  std::optional<Event> deliver(IsThere is_there, SphereNow sphere, SensesIn senses_in,
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
        const Sphere first = sphere(event->first.index);
        if (event->kind == EventKind::sensor_enter) event->senses = senses_in(*event);
        if (event->kind == EventKind::sensor_leave) event->senses = senses_of(*event);
        if (take_effect(*event, first, alone ? first : sphere(event->second.index), box)) return event;
      } else if (!begins(event->kind) && event->kind != EventKind::zeno_guard) {
        return event;
      }
    }
    event.reset();
    return event;
  }

  /// The same where nothing is sensed.
  template <class IsThere, class SphereNow>
  std::optional<Event> deliver(IsThere is_there, SphereNow sphere, const std::optional<Box>& box) {
    return deliver(
        is_there, sphere, [](const Event&) { return Senses::neither; }, box);
  }

  /// Pairs (a body and itself: its walls) whose contact has been changed by a delivered event, so that
  /// nothing is known of them; for the caller to take out.
  std::vector<std::pair<std::uint32_t, std::uint32_t>>& changed() { return changed_; }
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& changed() const { return changed_; }

  /// All but the rules and the space, which follow from the world's definition.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    auto& [rule, sensor_rule, space, entries, partners, crossings, pending, ended, guards_told, changed] =
        self;
    archive(entries, partners, crossings, pending, ended, guards_told, changed);
  }
  /// For one that was read in a world of this many bodies at `time`: true when contacts are mutual, and
  /// events are such as could be announced now. `box` has the walls that stand; `is_known(id)` tells whether
  /// an id was ever given out.
  bool is_sound(std::size_t bodies, double time, const std::optional<Box>& box,
                const std::function<bool(BodyId)>& is_known) const;

 private:
  /// A number rounded to 20 bits after the first: of an interval that only marks events no more is needed.
  class Coarse {
   public:
    Coarse() = default;
    explicit Coarse(double value)
        : upper_half_(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(value) >> 32)) {}
    double value() const { return std::bit_cast<double>(std::uint64_t{upper_half_} << 32); }

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      archive(self.upper_half_);
    }

   private:
    std::uint32_t upper_half_ = 0;
  };

  struct Entry {
    double last_contact = -std::numeric_limits<double>::infinity();
    Coarse zeno_interval;
    std::uint16_t contacts_then = 0;  ///< at the time of the last one, most_at_one_instant at most
    std::uint8_t walls = 0;
    bool fixed = false;

    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
      auto& [last, interval, count_then, touched_walls, is_fixed] = self;
      archive(last, interval, count_then, touched_walls, is_fixed);
    }
  };

  static bool begins(EventKind kind) {
    return kind == EventKind::contact_begin || kind == EventKind::wall_begin ||
           kind == EventKind::sensor_enter;
  }

  void set_touching(const Event& contact, bool touching);
  Senses senses_of(const Event& leave) const;
  void end(const Event& contact);
  bool take_effect(Event& event, const Sphere& first, const Sphere& second, const std::optional<Box>& box);
  bool still_begins(const Event& now, const Sphere& first, const Sphere& second) const;
  bool contacts_are_sound(const std::optional<Box>& box) const;
  bool is_repeated(const Event& begin, std::uint32_t body) const;
  std::uint32_t contacts_now(const Event& contact) const;
  void note_contact(Event& begin);
  void note_contact(std::uint32_t body, double time);

  /// A chain of touching bodies passes a push on in some contacts each; these are far more.
  static constexpr std::uint32_t many_at_one_instant = 64;
  static constexpr std::uint32_t most_at_one_instant = 256;

  ContactRule rule_;
  ContactRule sensor_rule_;
  Space space_;
  std::vector<Entry> entries_;
  Chains<std::uint32_t> partners_;
  Crossings crossings_;
  EventSet pending_;
  std::set<Event, DeliveredBefore> ended_;  ///< by the caller's changes; and bodies that have woken
  std::set<Event, DeliveredBefore> guards_told_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changed_;
};

}  // namespace kinesphere
