// Events at the present time that wait for delivery to the caller.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "contact/contact_graph.hpp"
#include "contact/event_set.hpp"

namespace kinesphere {

class PendingEvents {
 public:
  /// Drops all pending events and marks.
  void clear() {
    pending_.clear();
    ended_.clear();
    delivered_guards_.clear();
    changed_.clear();
    delivered_.reset();
  }
  /// Starts a new time: delivered Zeno guards may be queued again.
  void start() { delivered_guards_.clear(); }
  /// Queues an event, described as its bodies are now, unless it is already queued, or is a Zeno guard that
  /// was delivered at this time.
  /// `terms`: those of its bodies now; nullptr if they are to be looked at when it is delivered.
  void queue(const Event& event, const ContactTerms* terms = nullptr);
  /// A body changes: pending events have to be described anew.
  void outdate() { are_outdated_ = true; }
  /// Queues an event that has already taken effect. It is delivered unchanged, before all events of queue().
  void queue_first(const Event& event) { ended_.insert(event); }
  /// Drops the event that a body woke, as it sleeps again or is gone before the caller was told.
  void drop_woken(BodyId body) {
    std::erase_if(
        ended_, [body](const Event& event) { return event.kind == EventKind::woke && event.first == body; });
  }
  const EventSet& pending() const { return pending_; }
  /// Drops pending events of `body` for which `holds`(Event) is false.
  template <class Holds>
  void drop_pending(std::uint32_t body, Holds holds) {
    pending_.erase_if([&](const Event& event) {
      return (event.first.index == body || event.second.index == body) && !holds(event);
    });
  }
  /// Returns true if ends that the caller has caused wait for delivery: pop() returns the first of them.
  bool has_ends() const { return !ended_.empty(); }
  /// True if no event waits for delivery.
  bool is_quiet() const { return ended_.empty() && pending_.empty(); }

  /// Ends those contacts and overlaps of `body` for which `ends`(Event) is true, because the caller is about
  /// to change the body. `sphere(number)` returns a body as it is before the change.
  template <class SphereNow, class Ends>
  void end_contacts(ContactGraph& graph, std::uint32_t body, double time, SphereNow sphere,
                    const std::optional<Box>& box, Ends ends) {
    forget_delivered(graph, body);
    for (const Event& event : ends_of(graph, body, time, sphere, box)) {
      if (!ends(event)) continue;
      const Sphere first = sphere(graph.number_of(event.first));
      end(graph, event,
          event.second == no_body ? first.wanted
                                  : first.wanted | sphere(graph.number_of(event.second)).wanted);
    }
  }
  /// Ends all contacts and overlaps of a body that is about to be removed or disabled.
  template <class SphereNow>
  void end_all_contacts(ContactGraph& graph, std::uint32_t body, double time, SphereNow sphere,
                        const std::optional<Box>& box) {
    end_contacts(graph, body, time, sphere, box, [](const Event&) { return true; });
  }

  /// Returns the next event, or nullopt if none is left. Ends caused by the caller come first, as they were
  /// at that moment; others are described as their bodies are now, and dropped if earlier responses have
  /// invalidated them.
  /// `is_there(id)` is true unless the body was removed, `sphere(number)` returns its present state, and
  /// `senses_in(event)` returns whose sensor the pair enters.
  template <class IsThere, class SphereNow, class SensesIn>
  std::optional<Event> pop(ContactGraph& graph, IsThere is_there, SphereNow sphere, SensesIn senses_in,
                           const std::optional<Box>& box) {
    note_response(graph, [&](std::uint32_t number, const Vec3& seen) {
      const Sphere body = sphere(number);
      BodyMotion motion = motion_of(body);
      motion.velocity = graph.space().velocity_in_row(motion.velocity, body.state.position, seen);
      return motion;
    });
    std::optional<Event> event;
    if (!ended_.empty()) {
      event = ended_.extract(ended_.begin()).value();
      return event;
    }
    while (!pending_.empty()) {
      event = pending_.take_first();
      const std::optional<ContactTerms> known = std::exchange(terms_, std::nullopt);
      const bool alone = event->second == no_body;
      if (is_there(event->first) && (alone || is_there(event->second))) {
        if (event->kind == EventKind::sensor_enter) event->senses = senses_in(*event);
        if (event->kind == EventKind::sensor_leave) event->senses = senses_at_enter(graph, *event);
        const auto terms_now = [&] {
          const Sphere first = sphere(graph.number_of(event->first));
          const Sphere second = alone ? first : sphere(graph.number_of(event->second));
          if (are_outdated_) describe_now(*event, first, second, graph.space(), box);
          return terms_of(*event, first, second);
        };
        if (take_effect(graph, *event, known && !are_outdated_ ? *known : terms_now())) {
          are_outdated_ = true;
          return event;
        }
      } else if (!begins(event->kind) && event->kind != EventKind::zeno_guard) {
        return event;
      }
    }
    event.reset();
    return event;
  }

  /// Takes note of the response to the last delivered begin: if the two still approach with more than half of
  /// their speed, they are let through until that changes; otherwise their next approach is an event. pop()
  /// does this before it delivers another event. Call it before velocities change for another reason, and
  /// before bodies are recertified. `motion(number, place)` returns how a body moves now, in its image at
  /// this place.
  template <class MotionNow>
  void note_response(ContactGraph& graph, MotionNow motion) {
    if (!delivered_) return;
    const Event& event = delivered_->event;
    const BodyMotion first = motion(graph.number_of(event.first), event.first_state.position);
    const bool is_pair = event.second != no_body;
    note_response(graph, first,
                  is_pair ? motion(graph.number_of(event.second), event.second_state.position) : first);
    delivered_.reset();
  }
  /// Returns true if note_response() would look at a begin.
  bool awaits_response() const { return delivered_.has_value(); }
  /// Drops the last delivered begin if it is one of this body, which the caller changes in another way.
  void forget_delivered(const ContactGraph& graph, std::uint32_t body);

  /// Pairs whose contact a delivered event has changed, so that their certificates are void. A pair of a body
  /// with itself stands for its walls. The caller takes them out.
  std::vector<std::pair<std::uint32_t, std::uint32_t>>& changed() { return changed_; }
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>& changed() const { return changed_; }

  static void serialize(auto& self, auto& archive) {
    auto& [pending, terms, ended, zeno_guards, changed, delivered, are_outdated] = self;
    archive(pending, ended, zeno_guards, changed, delivered);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(self)>>) are_outdated = true;
  }
  /// Validates events read from bytes, for a world of `bodies` bodies at `time`: true if every event could be
  /// queued now. `box` holds the existing walls; `is_known(id)` is true if an id was ever given out.
  bool is_valid(std::size_t bodies, double time, const std::optional<Box>& box,
                const std::function<bool(BodyId)>& is_known) const;

 private:
  /// A begin that has been delivered.
  struct Delivered {
    Event event;
    double arm;  ///< of its normal
    static void serialize(auto& self, auto& archive) { archive(self.event, self.arm); }
  };

  /// Returns the end events of all contacts and overlaps of the body, as if they ended now. `sphere(number)`
  /// returns the present state of a body.
  template <class SphereNow>
  static std::vector<Event> ends_of(const ContactGraph& graph, std::uint32_t body, double time,
                                    SphereNow sphere, const std::optional<Box>& box) {
    const auto end_with = [&](EventKind kind, std::uint32_t partner) {
      return contact_event(kind, time, sphere(body), sphere(partner), graph.space());
    };
    std::vector<Event> found;
    for (const ContactRecord& contact : graph.partners_of(body))
      found.push_back(end_with(EventKind::contact_end, contact.partner));
    for (const Wall wall : walls)
      if (graph.touches_wall(body, wall))
        found.push_back(wall_event(EventKind::wall_end, time, sphere(body), *box, wall));
    for (const OverlapRecord& overlap : graph.overlaps_of(body)) {
      found.push_back(end_with(EventKind::sensor_leave, overlap.partner));
      found.back().distance = overlap.distance;
      found.back().senses = overlap.senses;
    }
    return found;
  }
  static Senses senses_at_enter(const ContactGraph& graph, const Event& leave);
  void end(ContactGraph& graph, const Event& contact, ContactEvents wanted);
  void note_response(ContactGraph& graph, const BodyMotion& first, const BodyMotion& second);
  static void describe_now(Event& event, const Sphere& first, const Sphere& second, const Space& space,
                           const std::optional<Box>& box);
  bool take_effect(ContactGraph& graph, Event& event, const ContactTerms& terms);

  EventSet pending_;
  std::optional<ContactTerms> terms_;       ///< of the only pending event, if they are known
  std::set<Event, DeliveredBefore> ended_;  ///< ended by the caller's changes; also bodies that have woken
  std::set<Event, DeliveredBefore> delivered_guards_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changed_;
  std::optional<Delivered> delivered_;  ///< the last one, until the response to it is noted
  bool are_outdated_ = true;            ///< bodies may have changed since the pending events were described
};

}  // namespace kinesphere
