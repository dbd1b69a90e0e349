// Handling of reports, and addition and removal of tracks.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "monitor/engine.hpp"
#include "number/powers.hpp"

namespace kinesphere {

Result<void> Monitor::Engine::report(TrackId id, const TrackReport& report) {
  if (Result<void> checked = check(id, report, "report"); !checked) return checked;
  if (!has_started_) start_clock(report.timestamp);
  const std::uint32_t number = take(id, report);
  decide_open_pairs(number);
  predict(number);
  return {};
}

/// Predicts from the present state of a track.
void Monitor::Engine::predict(std::uint32_t number) {
  const KnownTrack& track = tracks_[number];
  if (!(separations_.look_ahead(track.track_class) > 0.0)) return;
  std::vector<MonitorEvent> events;
  const ErrorBound& error = TrackEstimate::tightest(track.estimate.hypotheses().front(), time_).radius;
  predictions_.set_path(number, track.id, track.track_class, straight_on(track), error, time_, events);
  queue_all(events);
}

Result<void> Monitor::Engine::check(TrackId id, const TrackReport& report, const char* call) const {
  // Nearly all reports are valid, so their name is written without an allocation.
  constexpr std::string_view prefix = "report of track ";
  std::array<char, prefix.size() + std::numeric_limits<TrackId>::digits10 + 1> text;
  char* const end =
      std::to_chars(std::copy(prefix.begin(), prefix.end(), text.data()), text.data() + text.size(), id).ptr;
  const std::string_view name(text.data(), static_cast<std::size_t>(end - text.data()));
  const auto subject = [&name](std::string_view field) { return Subject{.argument = name, .part = field}; };
  InputCheck check(call);
  check.within(subject("timestamp"), report.timestamp, limits::largest_time)
      .within(subject("position"), report.state.position, definition_.tolerance * limits::largest_length)
      .within(subject("velocity"), report.state.velocity, limits::largest_speed)
      .from_zero_to(subject("timestamp_error"), report.timestamp_error, limits::largest_time)
      .require(report.track_class < definition_.classes.size(), ErrorCode::out_of_range,
               subject("track_class"), "must be less than the number of classes", definition_.classes.size(),
               report.track_class);
  const auto error_bound = [&](std::string_view field, const ErrorBound& value, double most,
                               bool may_be_infinite) {
    const auto is_valid = [most](double length) { return length >= 0.0 && length <= most; };
    if (is_valid(value.horizontal()) && is_valid(value.vertical()) && is_valid(value.total())) return;
    for (const double length : {value.horizontal(), value.vertical(), value.total()}) {
      if (may_be_infinite && length == infinity) continue;
      check.from_zero_to(subject(field), length, most);
    }
  };
  error_bound("position_error", report.position_error, limits::largest_size, false);
  error_bound("velocity_error", report.velocity_error, limits::largest_speed, true);
  if (report.plan) {
    check.within(subject("plan acceleration"), report.plan->acceleration, limits::largest_acceleration);
    error_bound("plan acceleration_limit", report.plan->acceleration_limit, limits::largest_acceleration,
                false);
    check.require(report.plan->valid_until > report.timestamp, ErrorCode::out_of_range,
                  subject("plan valid_until"), "must be later than the timestamp", report.plan->valid_until);
  }
  if (check.error()) return *check.error();
  const TrackClass& track_class = classes_[report.track_class];
  check.require(
      std::isfinite(track_class.largest_speed.total()) || std::isfinite(report.velocity_error.total()),
      ErrorCode::out_of_range, subject("velocity_error"),
      "must be finite where the class has no largest speed", report.velocity_error.total());
  return check.result();
}

/// Returns a report as the monitor counts it: without z in two dimensions.
TrackReport Monitor::Engine::as_seen(const TrackReport& report) const {
  TrackReport seen = report;
  if (definition_.dimensions != 2) return seen;
  seen.state.position.z = 0.0;
  seen.state.velocity.z = 0.0;
  seen.position_error = seen.position_error.flat();
  seen.velocity_error = seen.velocity_error.flat();
  if (seen.plan) {
    seen.plan->acceleration.z = 0.0;
    seen.plan->acceleration_limit = seen.plan->acceleration_limit.flat();
  }
  return seen;
}

/// Applies a checked report to its track. The caller decides the track's open pairs afterwards, once all
/// reports that arrive together are applied. Returns the track's number.
std::uint32_t Monitor::Engine::take(TrackId id, const TrackReport& report) {
  auto known = tracks_.find(id);
  if (known && tracks_[*known].track_class != report.track_class) {
    drop(*known, MonitorEventKind::reclassified);
    known.reset();
  }
  const std::uint32_t number = known ? *known : tracks_.add(id, report.track_class);
  KnownTrack& track = tracks_[number];
  const TrackEstimate::Learned learned =
      track.estimate.update(as_seen(report), classes_[report.track_class], time_, power_of_two(rung_));
  hasten_round();
  if (learned.outcome == TrackEstimate::Outcome::repeated) {
    ++counters_.repeated;
    return number;
  }
  ++counters_.reports;
  if (learned.late) ++counters_.late;
  if (known) {
    note_learned(number, learned);
  } else {
    move_regions(number);
    expect_to_hear(number);
  }
  return number;
}

/// Tells what a report says about a known track, and ends what it makes uncertain.
void Monitor::Engine::note_learned(std::uint32_t number, const TrackEstimate::Learned& learned) {
  KnownTrack& track = tracks_[number];
  if (track.stale && time_ - track.estimate.timestamp() < definition_.stale_after) {
    track.stale = false;
    queue({.time = time_, .kind = MonitorEventKind::resumed, .first = track.id});
    expect_to_hear(number);
  }
  if (learned.outcome == TrackEstimate::Outcome::contradicts) {
    ++counters_.contradictions;
    queue({.time = time_,
           .kind = MonitorEventKind::contradiction,
           .first = track.id,
           .position_excess = learned.excess.position,
           .velocity_excess = learned.excess.velocity});
  }
  if (learned.outcome == TrackEstimate::Outcome::resolves)
    queue({.time = time_, .kind = MonitorEventKind::resolved, .first = track.id});
  // Each hypothesis has its own region.
  if (learned.ends_certainty || learned.outcome == TrackEstimate::Outcome::resolves) move_regions(number);
  if (!learned.ends_certainty) return;
  for (const std::uint32_t other : near_.near(number))
    if (PairRecord* pair = pairs_.find(number, other); pair != nullptr && !pair->is_open())
      set_due(number, other, *pair, time_);
  for (const std::uint32_t other : track.open)
    for (LevelState& state : pairs_.find(number, other)->levels) state.until = -infinity;
  decide_open_pairs(number);
}

Result<void> Monitor::Engine::remove(TrackId id) {
  const auto number = tracks_.find(id);
  if (!number)
    return Error{ErrorCode::unknown_body, "id", no_body, "remove: there is no track " + std::to_string(id)};
  drop(*number, MonitorEventKind::dropped);
  return {};
}

/// Removes a track, with an event of this kind.
void Monitor::Engine::drop(std::uint32_t number, MonitorEventKind kind) {
  KnownTrack& track = tracks_[number];
  predictions_.remove(number);
  // A track that ends or starts anew has no events from before, but those of earlier tracks of its id.
  std::erase_if(events_, [&](const MonitorEvent& event) {
    if (is_of_pair(event.kind)) return event.first == track.id || event.second == track.id;
    return event.first == track.id && kind == MonitorEventKind::dropped &&
           event.kind != MonitorEventKind::dropped;
  });
  for (const std::uint32_t other : near_.near(number)) pairs_.remove(number, other);
  for (const std::uint32_t other : track.open) {
    pairs_.remove(number, other);
    std::erase(tracks_[other].open, number);
  }
  open_pairs_ -= track.open.size();
  near_.remove(number);
  queue({.time = time_, .kind = kind, .first = track.id});
  tracks_.remove(number);
}

/// Sets the time at which the track becomes stale or, if it is stale, is dropped.
void Monitor::Engine::expect_to_hear(std::uint32_t number) {
  KnownTrack& track = tracks_[number];
  const double after =
      track.stale ? definition_.drop_after : std::min(definition_.stale_after, definition_.drop_after);
  track.silent_at = std::max(time_, track.estimate.timestamp() + after);
  add_due({track.silent_at, DueTime::About::silence, number});
}

/// Drops a track, or makes it stale, if it has been silent for so long; otherwise schedules the next look.
void Monitor::Engine::look_at_silence(std::uint32_t number) {
  KnownTrack& track = tracks_[number];
  const double age = track.estimate.timestamp();
  if (age + definition_.drop_after <= time_) return drop(number, MonitorEventKind::dropped);
  if (!track.stale && age + definition_.stale_after <= time_) {
    track.stale = true;
    queue({.time = time_, .kind = MonitorEventKind::stale, .first = track.id});
  }
  expect_to_hear(number);
}
}  // namespace kinesphere
