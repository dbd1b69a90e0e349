// Clock of a monitor: starts of windows, and the event loop over certificates.
#include "monitor/engine.hpp"

#include <tuple>

#include "number/powers.hpp"

namespace kinesphere {
namespace {

/// Number of windows of one length, before it doubles.
constexpr std::uint32_t windows_of_a_length = 8;

Space space_of(const MonitorDefinition& definition) {
  return Space(WorldDefinition{.dimensions = definition.dimensions});
}

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
      time_(definition.start_time.value_or(0.0)),
      has_started_(definition.start_time.has_value()),
      predictions_(definition_, separations_),
      broad_phase_(space_of(definition)) {}

bool Monitor::Engine::is_stale(const PairCertificate& pair) const {
  const KnownTrack& first = tracks_[pair.first];
  if (!pair.has_second()) return first.life != pair.first_revision || first.expected != pair.second_revision;
  if (pair.second_revision == of_open_record) {
    const PairRecord* record = pair_records_.find(pair.first, pair.second);
    return record == nullptr || record->revision != pair.first_revision;
  }
  return first.life != pair.first_revision || tracks_[pair.second].life != pair.second_revision ||
         pair_records_.find(pair.first, pair.second) != nullptr;
}

Result<std::optional<MonitorEvent>> Monitor::Engine::advance(double until, const Poll* poll) {
  if (!has_started_) {
    // A call with until == time() does not choose a start time, so the clock does not start.
    if (until == time_) return std::optional<MonitorEvent>{};
    start_clock(until);
  }
  for (;;) {
    queue_.open([this](const PairCertificate& pair) { return is_stale(pair); });
    const double next = std::min({broad_phase_.next_end(), queue_.next_time(), predictions_.next_time()});
    if (events_.empty() ? next > until : next > time_) break;
    time_ = std::max(time_, next);
    if (broad_phase_.next_end() <= time_) {
      if (const Result<void> done = start_windows(poll); !done) return done.error();
    } else if (queue_.next_time() <= time_) {
      if (const Result<void> done = recheck(poll); !done) return done.error();
    } else {
      std::vector<MonitorEvent> events;
      predictions_.advance(time_, events);
      queue_all(events);
    }
  }
  if (events_.empty()) {
    time_ = std::max(time_, until);
    return std::optional<MonitorEvent>{};
  }
  const MonitorEvent event = events_.front();
  events_.pop_front();
  return std::optional(event);
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

/// Returns the bound of a hypothesis for the broad phase, with the margin of its class and, for well clear,
/// the way that it may go in the modified tau. A planned
/// acceleration is replaced by a straight path: for d in [0, T],  1/2 g d^2  is within  |g| T^2 / 16  of  1/2
/// g (T d - T^2 / 8). This is tighter than the first tangent.
InflatedBound Monitor::Engine::inflated_bound(std::uint32_t number, const Hypothesis& hypothesis,
                                              double end) const {
  BoundAt moved(TrackEstimate::bound(hypothesis, time_, end), time_);
  if (const double duration = end - time_; moved.acceleration != Vec3{} && duration < infinity) {
    const double sixteenth = duration * duration * 0.0625;
    moved.centre -= moved.acceleration * sixteenth;
    moved.velocity += moved.acceleration * (0.5 * duration);
    moved.radius += norm(moved.acceleration) * (sixteenth * (1.0 + 0x1p-47));
    moved.acceleration = {};
  }
  const std::size_t track_class = tracks_[number].track_class;
  const double modified_tau = separations_.modified_tau(track_class);
  double margin = separations_.margin(track_class);
  if (modified_tau > 0.0)
    margin += modified_tau * TrackEstimate::largest_speed(hypothesis, time_, end) * (1.0 + 0x1p-40);
  return {moved, margin};
}

/// Returns the window that starts now. Its length doubles with every 8 windows that start without a report,
/// so a gap takes 8 times the binary logarithm of its length in windows. The length doubles more slowly while
/// windows find many pairs.
Window Monitor::Engine::next_window() const {
  return Window::at(time_, rung_ + static_cast<int>(quiet_windows_ / windows_of_a_length));
}

/// Lets windows become up to 8 times as long while fewer reports come than a sixteenth of the tracks: then
/// the cost is that of silent tracks, each of which starts with each window.
void Monitor::Engine::weigh_reports(std::size_t tracks) {
  constexpr std::uint64_t tracks_for_each = 16;
  constexpr std::uint32_t most = 3 * windows_of_a_length;
  const std::uint64_t reports = counters_.reports - reports_before_window_;
  reports_before_window_ = counters_.reports;
  if (reports == 0) return;
  if (reports * tracks_for_each < tracks)
    sparse_windows_ = std::min(sparse_windows_ + 1, most);
  else
    sparse_windows_ -= std::min(sparse_windows_, windows_of_a_length);
}

Result<void> Monitor::Engine::start_windows(const Poll* poll) {
  const Window next = next_window();
  const std::uint64_t pairs_before = counters_.near_pairs;
  // All tracks start together, including one that was added to a running window after a poll failed here; the
  // started tracks take a grid level of their own. Tracks are in ascending order, since the slots of a track
  // are contiguous.
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t place : broad_phase_.ended(time_, true))
    if (numbers.empty() || numbers.back() != track_at(place)) numbers.push_back(track_at(place));
  if (poll != nullptr) {
    // Poll tracks with a plan that ends in the next window, and tracks of undecided pairs.
    std::vector<std::uint32_t> asked;
    for (const std::uint32_t number : numbers) {
      const KnownTrack& track = tracks_[number];
      if (track.estimate.timestamp() < time_ &&
          (track.estimate.first_end() < next.end ||
           std::any_of(track.open.begin(), track.open.end(), [&](std::uint32_t other) {
             return pair_records_.find(number, other)->is_undecided();
           })))
        asked.push_back(number);
    }
    if (!asked.empty()) {
      quiet_windows_ = 0;
      if (Result<void> done = ask(asked, *poll, Placing::later); !done) return done;
      for (const std::uint32_t number : asked) decide_pairs_not_due(number);
    }
  }
  close_records();
  weigh_reports(numbers.size());
  window_ = next;
  ++counters_.windows;
  broad_phase_.end_windows(time_, true);
  std::vector<BroadPhase::Starter> starters;
  bounds_.resize(std::size_t{tracks_.numbers()} * TrackEstimate::slots);
  for (const std::uint32_t number : numbers) {
    KnownTrack& track = tracks_[number];
    for (const Hypothesis& hypothesis : track.estimate.hypotheses()) {
      track.placed |= 1u << hypothesis.slot;
      const std::uint32_t place = place_of(number, hypothesis);
      bounds_[place] = inflated_bound(number, hypothesis, next.end);
      starters.push_back({place, SizeClasses::size_class_of(*bounds_[place], next), next});
    }
  }
  PoolLease alone;
  const auto bound_of = [&](std::uint32_t place) -> const InflatedBound& { return *bounds_[place]; };
  broad_phase_.start(starters, time_, bound_of, alone);
  counters_.searches += starters.size();
  const std::size_t started = broad_phase_.started_slots();
  constexpr std::size_t at_once = 256;
  for (std::size_t from = 0; from < started; from += at_once)
    for (const auto& [a, b] :
         search_.near_started(broad_phase_, from, std::min(started, from + at_once), time_, bound_of))
      find_pair(track_at(a), track_at(b));
  // Longer windows find more pairs, which take memory, so a window that finds many counts as an eighth of
  // one.
  constexpr std::size_t many_pairs_for_each = 16;
  constexpr std::uint64_t slower = 8;
  const bool finds_many = counters_.near_pairs - pairs_before > many_pairs_for_each * numbers.size();
  if (!finds_many || counters_.windows % slower == 0) ++quiet_windows_;
  return {};
}
}  // namespace kinesphere
