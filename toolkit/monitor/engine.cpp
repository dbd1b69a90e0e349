// Clock of a monitor: the loop over what is due.
#include "monitor/engine.hpp"

#include <tuple>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

std::vector<TrackClass> classes_of(const MonitorDefinition& definition) {
  std::vector<TrackClass> classes = definition.classes;
  if (definition.dimensions == 2)
    for (TrackClass& track_class : classes) {
      track_class.acceleration_limit = track_class.acceleration_limit.flat();
      track_class.planned_acceleration.z = 0.0;
      track_class.largest_speed = track_class.largest_speed.flat();
    }
  return classes;
}

/// Returns the kind by which events of one time are ordered: that of a begin for its end, too.
MonitorEventKind kind_that_begins(MonitorEventKind kind) {
  switch (kind) {
    case MonitorEventKind::prediction_ended:
      return MonitorEventKind::predicted;
    case MonitorEventKind::resolved:
      return MonitorEventKind::contradiction;
    case MonitorEventKind::resumed:
      return MonitorEventKind::stale;
    default:
      return kind;
  }
}

/// Order of the events of one time. A track that ends or starts anew does so before all that follows for its
/// id. What begins and ends for the same tracks keeps the order in which it did.
auto order_of(const MonitorEvent& event) {
  const bool is_end = event.kind == MonitorEventKind::dropped || event.kind == MonitorEventKind::reclassified;
  return std::tuple(!is_end, kind_that_begins(event.kind), event.first, event.second, event.level);
}

}  // namespace

Monitor::Engine::Engine(const MonitorDefinition& definition)
    : definition_(definition),
      classes_(classes_of(definition)),
      separations_(definition),
      rung_(exponent_of(definition.window)),
      time_(0.0),
      has_started_(false),
      near_(definition.tolerance, definition.dimensions),
      predictions_(definition_, separations_) {
  if (definition.start_time) start_clock(*definition.start_time);
}

void Monitor::Engine::start_clock(double time) {
  time_ = time;
  has_started_ = true;
  round_ = next_round();
}

Result<std::optional<MonitorEvent>> Monitor::Engine::advance(double until, const Poll* poll) {
  if (!has_started_) {
    // A call with until == time() does not choose a start time, so the clock does not start.
    if (until == time_) return std::optional<MonitorEvent>{};
    start_clock(until);
  }
  // Rounds have been left out where there was no poll.
  if (poll != nullptr && round_ < time_) round_ = next_round();
  for (;;) {
    const double round = poll != nullptr ? round_ : infinity;
    const double next = std::min({round, due_.next_time(), predictions_.next_time()});
    if (events_.empty() ? next > until : next > time_) break;
    time_ = std::max(time_, next);
    if (const Result<void> done = handle_next(poll); !done) return done.error();
  }
  if (events_.empty()) {
    time_ = std::max(time_, until);
    return std::optional<MonitorEvent>{};
  }
  const MonitorEvent event = events_.front();
  events_.pop_front();
  return std::optional(event);
}

/// Handles one thing that is due now. Precondition: there is one.
Result<void> Monitor::Engine::handle_next(const Poll* poll) {
  if (poll != nullptr && round_ <= time_) return ask_round(*poll);
  if (due_.next_time() > time_) {
    std::vector<MonitorEvent> events;
    predictions_.advance(time_, events);
    queue_all(events);
    return {};
  }
  const DueTime due = due_.take_first();
  if (!is_due(due)) return {};
  if (due.about == DueTime::About::pair) return recheck(due, poll);
  if (due.about == DueTime::About::silence) {
    look_at_silence(due.first);
  } else {
    leave_regions(due.first);
  }
  return {};
}

/// Returns false if this time is stale.
bool Monitor::Engine::is_due(const DueTime& due) const {
  if (due.about == DueTime::About::pair) {
    const PairRecord* pair = pairs_.find(due.first, due.second);
    return pair != nullptr && pair->due == due.time;
  }
  const KnownTrack& track = tracks_[due.first];
  return track.present && (due.about == DueTime::About::region ? track.own : track.silent_at) == due.time;
}

/// Adds a time to the queue, if it ever comes. Precondition: the track or the pair has this time.
void Monitor::Engine::add_due(const DueTime& due) {
  if (!(due.time < infinity)) return;
  if (due_.are_stale(2 * tracks_.size() + pairs_.size())) return index_due();
  due_.add(due);
}

/// Makes the queue anew from the times of all tracks and pairs.
void Monitor::Engine::index_due() {
  using About = DueTime::About;
  due_.clear();
  const auto add = [this](const DueTime& due) {
    if (due.time < infinity) due_.add(due);
  };
  for (std::uint32_t number = 0; number < tracks_.numbers(); ++number) {
    if (!tracks_[number].present) continue;
    add({tracks_[number].own, About::region, number});
    add({tracks_[number].silent_at, About::silence, number});
  }
  pairs_.for_each([&](std::uint32_t a, std::uint32_t b, const PairRecord& pair) {
    add({pair.due, About::pair, a, b});
  });
}

void Monitor::Engine::queue(MonitorEvent event) {
  const auto at = std::upper_bound(
      events_.begin(), events_.end(), event,
      [](const MonitorEvent& a, const MonitorEvent& b) { return order_of(a) < order_of(b); });
  events_.insert(at, event);
}

void Monitor::Engine::queue_all(const std::vector<MonitorEvent>& events) {
  for (const MonitorEvent& event : events) queue(event);
}

}  // namespace kinesphere
