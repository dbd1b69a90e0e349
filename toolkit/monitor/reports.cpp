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
  const std::uint32_t number = take(id, report, Placing::now);
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

/// Applies a checked report to its track. The caller decides the track's open pairs afterwards, once all
/// reports that arrive together are applied. Returns the track's number.
std::uint32_t Monitor::Engine::take(TrackId id, const TrackReport& report, Placing placing) {
  const TrackClass& track_class = classes_[report.track_class];
  auto known = tracks_.find(id);
  if (known && tracks_[*known].track_class != report.track_class) {
    drop(*known, MonitorEventKind::reclassified);
    known.reset();
  }
  const std::uint32_t number = known ? *known : tracks_.add(id, report.track_class);
  KnownTrack& track = tracks_[number];
  TrackReport flat = report;
  if (definition_.dimensions == 2) {
    flat.state.position.z = 0.0;
    flat.state.velocity.z = 0.0;
    flat.position_error = flat.position_error.flat();
    flat.velocity_error = flat.velocity_error.flat();
    if (flat.plan) {
      flat.plan->acceleration.z = 0.0;
      flat.plan->acceleration_limit = flat.plan->acceleration_limit.flat();
    }
  }
  const TrackEstimate::Learned learned = track.estimate.update(flat, track_class, time_, power_of_two(rung_));
  quiet_windows_ = std::min(quiet_windows_, sparse_windows_);
  if (learned.outcome == TrackEstimate::Outcome::repeated) {
    ++counters_.repeated;
    return number;
  }
  ++counters_.reports;
  if (learned.late) ++counters_.late;
  std::uint32_t slots = 0;
  for (const Hypothesis& hypothesis : track.estimate.hypotheses()) slots |= 1u << hypothesis.slot;
  track.placed &= slots;
  if (!known) {
    place(number);
    expect_to_hear(number);
    return number;
  }
  if (track.stale && time_ - track.estimate.timestamp() < definition_.stale_after) {
    track.stale = false;
    queue({.time = time_, .kind = MonitorEventKind::resumed, .first = id});
    expect_to_hear(number);
  }
  if (learned.outcome == TrackEstimate::Outcome::contradicts) {
    ++counters_.contradictions;
    queue({.time = time_,
           .kind = MonitorEventKind::contradiction,
           .first = id,
           .position_excess = learned.excess.position,
           .velocity_excess = learned.excess.velocity});
  }
  if (learned.outcome == TrackEstimate::Outcome::resolves)
    queue({.time = time_, .kind = MonitorEventKind::resolved, .first = id});
  if (!learned.ends_certainty) return number;
  for (const std::uint32_t other : track.open)
    for (LevelState& state : pair_records_.find(number, other)->levels) state.until = -infinity;
  if (placing == Placing::now) place(number);
  return number;
}

/// Enters the track's hypotheses that have no swept sphere yet into the broad phase, adds the pairs that the
/// search finds, and decides the track's open pairs. Call it when a track is new or may be outside of its
/// earlier bounds.
void Monitor::Engine::place(std::uint32_t number) {
  KnownTrack& track = tracks_[number];
  window_ = window();
  const Window& now = window_;
  for (const Hypothesis& hypothesis : track.estimate.hypotheses()) {
    if ((track.placed & 1u << hypothesis.slot) != 0) continue;
    track.placed |= 1u << hypothesis.slot;
    const std::uint32_t at = place_of(number, hypothesis);
    const InflatedBound bound = inflated_bound(number, hypothesis, now.end);
    broad_phase_.enter(at, bound, time_, now);
    ++counters_.searches;
    // find_pair() does not search, so the results of search_ remain valid in this loop.
    for (const std::uint32_t near : search_.near(broad_phase_, at, bound, time_, now.end))
      find_pair(number, track_at(near));
  }
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
  for (const std::uint32_t other : track.open) {
    pair_records_.remove(number, other);
    std::erase(tracks_[other].open, number);
  }
  queue({.time = time_, .kind = kind, .first = track.id});
  for (std::uint32_t slot = 0; slot < TrackEstimate::slots; ++slot)
    if (const std::uint32_t place = number * TrackEstimate::slots + slot; broad_phase_.contains(place))
      broad_phase_.leave(place);
  tracks_.remove(number);
}

/// Schedules the time at which the track becomes stale or, if it is stale, is dropped. Invalidates the
/// previously scheduled time.
void Monitor::Engine::expect_to_hear(std::uint32_t number) {
  KnownTrack& track = tracks_[number];
  const double after =
      track.stale ? definition_.drop_after : std::min(definition_.stale_after, definition_.drop_after);
  const double time = std::max(time_, track.estimate.timestamp() + after);
  ++track.expected;
  if (time < infinity)
    queue_.add({.failure_time = time,
                .first = number,
                .second = PairCertificate::silence,
                .first_revision = track.life,
                .second_revision = track.expected});
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
