#include "contact/pending_events.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {
namespace {

/// Part of the approach speed that a response may leave and still part the two. What remains is another event
/// at the same instant, so the speed is gone after about 60 of them.
constexpr double largest_rest_of_approach = 0.5;

/// Returns the threshold that the event crosses. A sensor overlap that may be entered does not exist yet.
Threshold threshold_of(const ContactGraph& graph, const Event& event, ContactEvents wanted) {
  return is_of_sensor(event.kind) ? Threshold{.within = false, .sensed = true}
                                  : graph.threshold_of(event, wanted);
}

}  // namespace

/// Recomputes what an event says of its bodies, if that is of now.
void PendingEvents::describe_now(Event& event, const Sphere& first, const Sphere& second, const Space& space,
                                 const std::optional<Box>& box) {
  if (event.kind == EventKind::zeno_guard || event.kind == EventKind::bound_violation) return;
  if (event.wall != Wall::none)
    describe(event, first, *box);
  else
    describe(event, first, second, space);
}

/// Returns the sensing direction that the sensor_enter of this pair and distance had.
Senses PendingEvents::senses_at_enter(const ContactGraph& graph, const Event& leave) {
  for (const OverlapRecord& overlap :
       graph.overlaps_of(graph.number_of(leave.first), graph.number_of(leave.second)))
    if (overlap.distance == leave.distance) return overlap.senses;
  return Senses::neither;
}

void PendingEvents::end(ContactGraph& graph, const Event& contact, ContactEvents wanted) {
  graph.set_touching(contact, false);
  // The end may also be pending because the contact ended by itself; it is dropped there.
  pending_.erase(contact);
  if (is_of_sensor(contact.kind) || wants_ends(wanted)) ended_.insert(contact);
}

void PendingEvents::forget_delivered(const ContactGraph& graph, std::uint32_t body) {
  if (!delivered_) return;
  const auto is_body = [&](BodyId id) { return id != no_body && graph.number_of(id) == body; };
  if (is_body(delivered_->event.first) || is_body(delivered_->event.second)) delivered_.reset();
}

void PendingEvents::note_response(ContactGraph& graph, const BodyMotion& first, const BodyMotion& second) {
  Event& event = delivered_->event;
  const auto moves_on = [](const BodyMotion& now, const State& state, const Vec3& spin) {
    return now.velocity == state.velocity && now.spin == spin;
  };
  if (moves_on(first, event.first_state, event.first_angular_velocity) &&
      (event.second == no_body || moves_on(second, event.second_state, event.second_angular_velocity)))
    return;
  const ContactEvents wanted = first.wanted | second.wanted;
  const Threshold threshold = graph.threshold_of(event, wanted);
  if (!threshold.within || threshold.state.approach == ApproachState::ignored) return;
  const double before = event.approach_speed;
  const double rates = turn(event, first, second);
  const double now = event.approach_speed;
  ContactState state = threshold.state;
  const double error = approach_error(event, delivered_->arm, rates);
  const auto is_approach = [&](double speed) { return graph.rule().is_approach(event.gap, speed, error); };
  const bool passes = is_approach(before) && is_approach(now) && now > largest_rest_of_approach * before;
  state.approach = passes ? ApproachState::reported : ApproachState::watched;
  // A response to a jammed contact should return no speed (Event::jammed), but for rounding.
  if (event.jammed && -now > error + 0x1p-20 * before && state.jams == 0) state.jams = 1;
  if (state.approach == ApproachState::watched && !wants_ends(wanted) && !state.has_history()) {
    graph.set_touching(event, false);
  } else {
    graph.set_state(event, state);
  }
}

void PendingEvents::queue(const Event& event, const ContactTerms* terms) {
  // A caller that changes a velocity at a Zeno guard must not get that guard again at the same time, without
  // end.
  if (delivered_guards_.contains(event)) return;
  if (pending_.empty()) are_outdated_ = false;
  terms_ = pending_.empty() && terms != nullptr ? std::optional(*terms) : std::nullopt;
  pending_.insert(event);
}

/// Applies the event to the contact graph, as the present states have it. Returns false, and leaves the graph
/// unchanged, if the event no longer holds.
bool PendingEvents::take_effect(ContactGraph& graph, Event& event, const ContactTerms& terms) {
  if (event.kind == EventKind::zeno_guard) delivered_guards_.insert(event);
  if (event.kind == EventKind::zeno_guard || event.kind == EventKind::bound_violation) return true;
  if (!begins(event.kind)) {
    graph.set_touching(event, false);
  } else {
    const Threshold threshold = threshold_of(graph, event, terms.wanted);
    const double error = approach_error(event, terms.arm, terms.rates);
    if (graph.rule().decide(threshold, event.gap - event.distance, event.approach_speed, error) !=
        ContactRule::Change::begin)
      return false;
    if (threshold.sensed) {
      graph.set_touching(event, true);
    } else {
      event.already_touching = threshold.within && wants_ends(terms.wanted);
      graph.note_contact(event, terms.acceleration);
      ContactState state = threshold.within ? threshold.state : ContactState{};
      const bool approaches = graph.rule().is_approach(event.gap, event.approach_speed, error);
      state.approach = approaches ? ApproachState::reported : ApproachState::watched;
      // The begin itself says that the two overlap.
      state.guard_reported = state.guard_reported || event.gap < -graph.rule().tolerance();
      graph.set_state(event, state);
      delivered_ = {event, terms.arm};
    }
  }
  const std::uint32_t first = graph.number_of(event.first);
  changed_.emplace_back(first, event.second == no_body ? first : graph.number_of(event.second));
  return true;
}

bool PendingEvents::is_valid(std::size_t bodies, double time, const std::optional<Box>& box,
                             const std::function<bool(BodyId)>& is_known) const {
  const auto event_is_valid = [&](const Event& event) {
    const bool pair = is_known(event.second) && event.first < event.second && event.wall == Wall::none;
    const bool wall = event.second == no_body && event.wall != Wall::none &&
                      static_cast<int>(event.wall) <= wall_count && box && stands(*box, event.wall);
    if (event.time != time || !is_known(event.first)) return false;
    if (!(event.senses <= Senses::both)) return false;
    switch (event.kind) {
      case EventKind::bound_violation:
      case EventKind::woke:
        return event.second == no_body && event.wall == Wall::none;
      case EventKind::contact_begin:
      case EventKind::contact_end:
        return pair;
      case EventKind::wall_begin:
      case EventKind::wall_end:
        return wall;
      case EventKind::zeno_guard:
        return pair || wall;
      case EventKind::sensor_enter:
      case EventKind::sensor_leave:
        return pair && event.distance >= 0.0;
      case EventKind::timer:
        return false;
    }
    return false;
  };
  const auto change_is_valid = [&](const auto& pair) { return pair.first < bodies && pair.second < bodies; };
  return pending_.is_valid() && pending_.all_of(event_is_valid) &&
         std::all_of(ended_.begin(), ended_.end(), event_is_valid) &&
         std::all_of(delivered_guards_.begin(), delivered_guards_.end(), event_is_valid) &&
         std::all_of(changed_.begin(), changed_.end(), change_is_valid) &&
         (!delivered_ || (event_is_valid(delivered_->event) && !std::isnan(delivered_->arm) &&
                          (delivered_->event.kind == EventKind::contact_begin ||
                           delivered_->event.kind == EventKind::wall_begin)));
}

}  // namespace kinesphere
