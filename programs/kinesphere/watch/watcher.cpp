// A watch: takes the reports of a stream and emits certain alerts.
#include "watch/watcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// Maximum reports held until their times are accepted. A document of all aircraft on earth has fewer.
constexpr std::size_t most_held = 65536;

/// Bound of a height that is not known, where heights have no unit.
constexpr double any_height = 1e9;

/// Returns a horizontal and a vertical bound, or one for all directions if the vertical one is absent.
ErrorBound spread_of(double flat, const std::optional<double>& upright) {
  return upright ? ErrorBound::cylinder(flat, *upright) : ErrorBound(flat);
}

}  // namespace

Watcher::Watcher(WatchSettings settings, AlertFn alert)
    : settings_(std::move(settings)),
      alert_(std::move(alert)),
      policy_(settings_.kinds, settings_.most_alerts),
      clock_(settings_.clock == WatchSettings::Clock::stamps ? StreamClock::Source::stamps
                                                             : StreamClock::Source::arrivals,
             settings_.leap),
      clock_is_chosen_(settings_.clock != WatchSettings::Clock::stream) {
  counts_.turns.resize(settings_.separations.size());
}

// Input.

void Watcher::take(const SourceReport& report) {
  if (!clock_is_chosen_) {
    clock_is_chosen_ = true;
    clock_.set_source(report.arrival ? StreamClock::Source::arrivals : StreamClock::Source::stamps);
  }
  // The caller sets the machine's clock before it passes a record.
  if (settings_.clock == WatchSettings::Clock::machine) return deliver(report);
  const bool by_arrival = clock_.source() == StreamClock::Source::arrivals;
  if (by_arrival && !report.arrival)
    return refuse(fmt::format("expected a time of arrival of {}, as reports before had one", report.id));
  const FileTime& time = clock_time(report);
  if (!clock_.believes(time)) {
    const bool confirmed = clock_.confirms(time, std::string(report.id), names_.size() > 1);
    hold(report);
    if (confirmed) {
      start(time, report.time_kind);
      deliver_held();
    }
    return;
  }
  drop_held();
  go_on(time);
  deliver(report);
}

void Watcher::time_is(const FileTime& arrival, TimeKind kind) {
  if (settings_.clock != WatchSettings::Clock::stream) return;
  if (!clock_is_chosen_) {
    clock_is_chosen_ = true;
    clock_.set_source(StreamClock::Source::arrivals);
  }
  if (clock_.source() != StreamClock::Source::arrivals) return;
  if (clock_.believes(arrival)) {
    drop_held();
    go_on(arrival);
  } else {
    const bool confirmed = clock_.confirms(arrival, "", true);
    if (clock_.in_a_row() == 1) drop_held();
    if (confirmed) {
      start(arrival, kind);
      deliver_held();
    }
  }
}

void Watcher::machine_time_is(const FileTime& now) {
  if (!clock_.has_begun()) start(now, TimeKind::number);
  go_on(now);
}

void Watcher::pass_over(Passed reason) {
  ++(reason == Passed::no_position ? counts_.no_position
     : reason == Passed::no_bound  ? counts_.no_bound
                                   : counts_.filtered);
}

void Watcher::refuse(std::size_t line, const std::string& reason) {
  constexpr std::size_t most_told = 10;
  ++counts_.malformed;
  const bool is_too_much = counts_.malformed > settings_.most_malformed;
  if (counts_.first_malformed.size() == most_told && !is_too_much) return;
  const std::string text = without_controls(reason);
  if (counts_.first_malformed.size() < most_told) counts_.first_malformed.push_back({line, text});
  if (is_too_much)
    throw ProgramError(fmt::format("{}:{}: {}; that makes {} malformed, and --most-malformed allows {}",
                                   settings_.source, line, text, counts_.malformed,
                                   settings_.most_malformed));
}

void Watcher::end_record() {
  if (monitor_) advance(monitor_->time());
}

void Watcher::finish() {
  // A stream may be too short for its times to confirm each other.
  if (!clock_.has_begun() && !held_.empty()) {
    const SourceReport& first = held_.front().report;
    start(clock_time(first), first.time_kind);
    deliver_held();
  }
  drop_held();
  end_record();
  write_refused(unbounded);
}

// Reports with unaccepted times.

void Watcher::hold(const SourceReport& report) {
  if (!monitor_ && settings_.has_automatic_classes) settings_.classes.begin(report.sayable);
  if (clock_.in_a_row() == 1) drop_held();
  if (held_.size() == most_held) {
    ++counts_.ahead;
    return;
  }
  held_.push_back({std::string(report.id), std::string(shown_name(report.name)), report});
}

void Watcher::drop_held() {
  if (held_.empty()) return;
  counts_.ahead += held_.size();
  held_.clear();
}

void Watcher::deliver_held() {
  clock_.interrupt();
  std::vector<HeldReport> reports = std::move(held_);
  held_.clear();
  for (HeldReport& held : reports) {
    if (!clock_.is_confirmed(clock_time(held.report))) {
      ++counts_.ahead;
      continue;
    }
    held.report.id = held.id;
    held.report.name = held.name;
    go_on(clock_time(held.report));
    deliver(held.report);
  }
}

// Time.

void Watcher::start(const FileTime& time, TimeKind kind) {
  if (!clock_.has_begun()) {
    FileTime first = time;
    for (const HeldReport& held : held_) first = std::min(first, clock_time(held.report), is_earlier);
    begin_times(first, kind);
    clock_.go_on(first);
    return;
  }
  go_on(held_.empty() ? time : clock_time(held_.front().report));
}

void Watcher::begin_times(const FileTime& first, TimeKind kind) {
  // Sufficient for years.
  constexpr std::int64_t span = std::int64_t{1} << 20;
  times_ = TimeScale(kind);
  times_.set_origin(first, {first.whole + span, 0.0});
  first_ = first;
  first_time_ = times_.seconds(first);
}

void Watcher::go_on(const FileTime& time) {
  clock_.interrupt();
  clock_.go_on(time);
  if (!monitor_) return;
  advance(std::max(monitor_->time(), times_.seconds(clock_.now())));
  if (monitor_->time() < next_forgetting_) return;
  next_forgetting_ = monitor_->time() + settings_.forget;
  for (const TrackGroups::Cell& group : groups_->forget_before(monitor_->time() - settings_.forget))
    end_group(group);
}

void Watcher::advance(double until) {
  for (;;) {
    const auto event = require(monitor_->advance(until));
    if (!event) return;
    report(*event);
    drop_crowd();
  }
}

bool Watcher::has_room() const {
  // The other half is reserved for watched tracks that approach each other.
  return names_.size() < settings_.most_tracks && monitor_->open_pair_count() < settings_.most_pairs / 2 + 1;
}

void Watcher::drop_crowd() {
  if (monitor_->open_pair_count() <= settings_.most_pairs) return;
  for (const TrackId id : monitor_->crowd(settings_.most_pairs / 2)) {
    remove(id, "crowd");
    ++counts_.dropped;
  }
}

void Watcher::remove(TrackId track, std::string_view reason) {
  require(monitor_->remove(track));
  removed_.insert_or_assign(track, reason);
}

void Watcher::report(const MonitorEvent& event) {
  // A watch of another share reports this track.
  const bool is_reported = settings_.share.contains(event.first);
  if (is_reported) count_and_report(event);
  const bool is_lost = event.kind == MonitorEventKind::stale || event.kind == MonitorEventKind::dropped;
  if (is_lost) report_lost(event);
  if (event.kind == MonitorEventKind::resumed)
    for (const AlertPolicy::Key& key : policy_.encounters_of(event.first))
      policy_.encounter(key).loss.reset();
  if (event.kind == MonitorEventKind::reclassified) policy_.forget(event.first);
  if (event.kind != MonitorEventKind::dropped) return;
  policy_.forget(event.first);
  names_.remove(event.first);
  removed_.erase(event.first);
  if (const auto group = group_tracks_.find(event.first); group != group_tracks_.end()) {
    groups_->dissolve(group->second);
    group_tracks_.erase(group);
  }
}

AlertFate Watcher::fate_of(MonitorEvent& event) {
  if (is_of_pair(event.kind))
    return policy_.take(event, areas_.empty() || is_in_area(event.first) || is_in_area(event.second));
  const bool is_asked_for =
      settings_.kinds.tracks && (settings_.own.empty() || track_id_of(settings_.own) == event.first);
  if (!is_asked_for) return AlertFate::of_track;
  // Where a track was is not known once it has been dropped.
  const bool is_elsewhere =
      !areas_.empty() && event.kind != MonitorEventKind::dropped && !is_in_area(event.first);
  if (is_elsewhere) return AlertFate::elsewhere;
  return policy_.has_room(event.time) ? AlertFate::written : AlertFate::too_many;
}

void Watcher::begin_areas() {
  for (const WatchedArea& area : settings_.areas) {
    if (!frame_) {
      areas_.push_back({{area.first, area.second, 0.0}, area.radius});
      continue;
    }
    const auto placed = frame_->place({area.second, area.first, 0.0}, false, {});
    if (!placed || std::abs(area.first) > 90.0)
      throw ProgramError(
          fmt::format("--area: expected a place in the radius of the map (--radius, --origin), but got {},{}",
                      area.first, area.second));
    areas_.push_back({placed->state.position, area.radius});
  }
}

bool Watcher::is_in_area(TrackId track) const {
  const auto view = monitor_->track(track);
  if (!view) return false;
  const auto contains = [&](const Circle& area) {
    return std::any_of(view->places.begin(), view->places.end(), [&](const TrackView::Place& place) {
      return std::hypot(place.centre.x - area.centre.x, place.centre.y - area.centre.y) <= area.radius;
    });
  };
  return std::any_of(areas_.begin(), areas_.end(), contains);
}

/// Tells of the encounters of a track that has entered an area.
void Watcher::enter_area(TrackId track) {
  if (areas_.empty() || !is_in_area(track)) return;
  for (const MonitorEvent& event : policy_.enter_area(track, monitor_->time())) {
    ++counts_.alerts;
    write(event.first, alert_line(context(), event, ""));
  }
}

/// Tells that a track was lost in its encounters: when it becomes stale, and when it is dropped.
void Watcher::report_lost(const MonitorEvent& event) {
  for (const AlertPolicy::Key& key : policy_.encounters_of(event.first)) {
    Encounter& encounter = policy_.encounter(key);
    if (event.kind == MonitorEventKind::stale) {
      const PairAnswer answer = require(monitor_->answer(key.first, key.second, key.level));
      encounter.loss = Encounter::Loss{answer.closest_time, answer.closest_distance};
    }
    if (!settings_.kinds.lost || !encounter.loss || !encounter.is_told()) continue;
    // Streams that lose a report now and then tell of it once.
    if (event.kind == MonitorEventKind::stale && std::exchange(encounter.silence_told, true)) continue;
    ++counts_.alerts;
    ++counts_.lost;
    write(key.first, lost_line(context(), event, key, encounter));
  }
}

void Watcher::write_refused(double time) {
  if (const auto refused = policy_.refused_before(time))
    alert_(settings_.share.first, refused_line(context(), *refused));
}

void Watcher::write(std::uint64_t share, std::string_view line) {
  write_refused(monitor_->time());
  alert_(share % settings_.share.of, line);
}

void Watcher::count_and_report(MonitorEvent event) {
  ++counts_.events[static_cast<std::size_t>(event.kind)];
  if (event.kind == MonitorEventKind::verdict) {
    auto& turns = counts_.turns[event.level];
    ++(event.verdict == Verdict::apart       ? turns.apart
       : event.verdict == Verdict::undecided ? turns.undecided
                                             : turns.within);
  }
  const AlertFate fate = fate_of(event);
  ++counts_.fates[static_cast<std::size_t>(fate)];
  if (fate != AlertFate::written) return;
  ++counts_.alerts;
  const auto removed = removed_.find(event.first);
  write(event.first, alert_line(context(), event, removed == removed_.end() ? "silence" : removed->second));
}

AlertContext Watcher::context() const {
  return {settings_, times_, names_, *monitor_, frame_ ? frame_->stretch() : 1.0, is_geographic_};
}

std::string Watcher::first_time() const {
  return clock_.has_begun() ? json_time(times_, first_time_) : "null";
}
std::string Watcher::last_time() const {
  return clock_.has_begun() ? json_time(times_, times_.seconds(clock_.now())) : "null";
}
double Watcher::time_covered() const {
  return clock_.has_begun() ? times_.seconds(clock_.now()) - first_time_ : 0.0;
}

// Reports.

void Watcher::begin_map(const WatchSettings::Origin& origin) {
  // A track is dropped before it gets farther than this beyond the radius.
  const double margin = settings_.classes.fastest() * settings_.forget;
  if (!std::isfinite(margin))
    throw ProgramError(
        "--largest-speed, --forget: expected finite ones, also for each --class, which latitudes and "
        "longitudes need: the error of the map rests upon them");
  if (settings_.radius + margin > LocalFrame::largest_radius)
    throw ProgramError(
        fmt::format("--radius: expected a radius that is, together with the way that a track goes at its "
                    "largest speed before "
                    "it is forgotten ({:.0f} km), at most {:.0f} km, but got {:.0f} km",
                    margin / 1e3, LocalFrame::largest_radius / 1e3, settings_.radius / 1e3));
  frame_.emplace(origin.latitude, origin.longitude, settings_.radius, margin);
}

void Watcher::begin_monitor(const SourceReport& report) {
  if (!report.geographic && !report.in_metres && !settings_.measured_option.empty())
    throw ProgramError(
        fmt::format("{}: expected numbers without a unit, because the unit of the lengths of {} is not "
                    "known, but got '{}'{}",
                    settings_.measured_option, settings_.source, settings_.measured_text,
                    settings_.format == "jsonl" ? "" : ": say --unit"));
  is_geographic_ = report.geographic;
  dimensions_ = settings_.dimensions.value_or(report.has_height || report.may_have_height ? 3 : 2);
  MonitorDefinition definition{.dimensions = dimensions_,
                               .start_time = times_.seconds(clock_.now()),
                               .window = settings_.window,
                               .stale_after = settings_.silence,
                               .drop_after = settings_.forget,
                               .prediction_hold = settings_.hold,
                               .prediction_confirmation = settings_.confirm,
                               .prediction_margin = 0.1,
                               // About the 95 % of which errors are declared multiples.
                               .prediction_error_part = 0.4,
                               .shard = settings_.share};
  double least = unbounded;
  SeparationRule rule;
  if (is_geographic_)
    begin_map(settings_.origin.value_or(WatchSettings::Origin{report.position.y, report.position.x}));
  for (std::size_t k = 0; k < settings_.classes.size(); ++k) {
    const auto& [acceleration, largest_speed] = settings_.classes[k].limits;
    definition.classes.push_back(
        frame_ ? frame_->promise(acceleration, largest_speed)
               : TrackClass{.acceleration_limit = acceleration, .largest_speed = largest_speed});
  }
  for (const NamedSeparation& named : settings_.separations) {
    const Separation& separation = named.separation;
    rule.levels.push_back(frame_ ? frame_->separation(separation) : separation);
    least = std::min(least, separation.horizontal);
    if (dimensions_ == 3) least = std::min(least, separation.vertical);
  }
  definition.tolerance = 1e-4 * least;
  const std::size_t base = definition.classes.size();
  if (!settings_.own.empty())
    // The own track has classes of its own, whose pairs with others are the only ones.
    for (std::size_t k = 0; k < base; ++k) definition.classes.push_back(TrackClass(definition.classes[k]));
  for (std::size_t first = 0; first < base; ++first)
    for (std::size_t second = settings_.own.empty() ? first : base; second < definition.classes.size();
         ++second) {
      rule.first_class = first;
      rule.second_class = second;
      definition.separations.push_back(rule);
    }
  monitor_.emplace(require(Monitor::create(definition)));
  begin_areas();
  groups_.emplace(cutting());
}

void Watcher::deliver(const SourceReport& report) {
  const double age = seconds_between(report.stamp, clock_.now());
  if (age > settings_.forget) {
    ++counts_.stale;
    return;
  }
  if (-age > settings_.leap) {
    ++counts_.ahead;
    return;
  }
  const bool knows_velocity =
      report.velocity && !(report.velocity_error && !std::isfinite(report.velocity_error->bound));
  if (!monitor_ && settings_.has_automatic_classes) settings_.classes.begin(report.sayable);
  const TrackId id = track_id_of(report.id);
  NamedTrack* const known = names_.find(id);
  NamedTrack track;
  track.motion_class = settings_.classes.choose(report, known);
  if (!knows_velocity && !std::isfinite(limits_of(track).largest_speed.total())) {
    if (!monitor_ || monitor_->counters().reports == 0)
      throw ProgramError(
          fmt::format("--largest-speed: expected it, because {} has positions without velocities: an "
                      "acceleration alone does not "
                      "say how far a track goes",
                      settings_.source));
    ++counts_.no_velocity;
    return;
  }
  if (!monitor_) begin_monitor(report);
  if (report.geographic != is_geographic_)
    return refuse(fmt::format("expected the position of {} in the same words as the first: {}", report.id,
                              is_geographic_ ? "latitude and longitude" : "x and y"));
  ignores_heights_ = ignores_heights_ || (dimensions_ == 2 && !settings_.dimensions && report.has_height);
  const bool lacks_height = dimensions_ == 3 && !report.has_height;
  if (lacks_height && report.on_ground) {
    ++counts_.on_ground;
    return;
  }
  if (known != nullptr) {
    if (known->text != report.id)
      return refuse(fmt::format("the ids {} and {} cannot be told apart", known->text, report.id));
    if (known->position == report.position &&
        std::abs(seconds_between(known->stamp, report.stamp)) <= report.same_within) {
      ++counts_.repeated;
      return;
    }
    if (is_superseded(report, *known, track.motion_class)) {
      ++counts_.superseded;
      return;
    }
  }
  if (known == nullptr && !has_room()) {
    ++counts_.crowded;
    return;
  }
  const auto on_map = this->on_map(report, track);
  if (!on_map) {
    ++counts_.outside;
    return;
  }
  if (watch_as_group(report, id, *on_map, track)) return;
  if (const auto taken = monitor_->report(id, *on_map); !taken)
    return refuse(fmt::format("{}: {}", report.id, taken.error().message));
  if (!settings_.own.empty() && report.id == settings_.own) ++counts_.of_own;
  if (lacks_height) ++counts_.no_height;
  if (knows_velocity) ++counts_.with_velocity;
  // Times of arrival tell that reports are late, and not in disorder.
  constexpr double seconds_of_disorder = 5.0;
  if (age > seconds_of_disorder && clock_.source() == StreamClock::Source::stamps) ++counts_.behind;
  NamedTrack& named = known != nullptr ? *known : names_.add(id, report.id);
  if (const std::string_view name = shown_name(report.name); !name.empty()) named.name = name;
  if (known == nullptr || seconds_between(named.stamp, report.stamp) >= 0.0) {
    named.stamp = report.stamp;
    named.position = report.position;
    named.extent = report.extent;
    if (known != nullptr && named.motion_class != track.motion_class) named.class_since = report.stamp;
    named.motion_class = track.motion_class;
    if (settings_.classes.contradicts_rest(report)) named.contradicted_rest = report.stamp;
    named.position_by = track.position_by;
    named.height_by = track.height_by;
    named.velocity_by = track.velocity_by;
    named.climb_by = track.climb_by;
  }
  enter_area(id);
}

// Groups.

/// Returns cells so small that two tracks in one are within the smallest separation, with room for errors.
TrackGroups::Cutting Watcher::cutting() const {
  TrackGroups::Cutting cutting{.edge = unbounded};
  constexpr double part = 0.25;
  double height = unbounded;
  for (const NamedSeparation& named : settings_.separations) {
    cutting.edge = std::min(cutting.edge, part * named.separation.horizontal);
    height = std::min(height, part * named.separation.vertical);
  }
  if (dimensions_ == 3) cutting.height = height;
  cutting.slow = cutting.edge / settings_.silence;
  constexpr double walking_pace = 1.0;  // metres per second
  if (is_geographic_) cutting.slow = std::min(cutting.slow, walking_pace);
  return cutting;
}

std::string Watcher::group_name(const TrackGroups::Cell& group) const {
  const Vec3 centre = groups_->centre_of(group);
  if (!frame_) return fmt::format("group at {:.6g},{:.6g},{:.6g}", centre.x, centre.y, centre.z);
  const Vec3 at = frame_->geographic(centre);
  return fmt::format("group at {:.5f},{:.5f},{:.0f}", at.y, at.x, at.z);
}

/// Returns true for a report of a track that is watched in a group. Then the track that stands for the group
/// gets it, as a report of the cell's centre with an error that reaches all of the cell.
bool Watcher::watch_as_group(const SourceReport& report, TrackId id, const TrackReport& on_map,
                             const NamedTrack& track) {
  if (report.id == settings_.own) return false;
  if (groups_->size() >= settings_.most_tracks && !groups_->contains(id)) return false;
  std::optional<double> speed;
  if (report.velocity) speed = norm(*report.velocity);
  const auto outcome = groups_->take(id, on_map.state.position, speed, on_map.timestamp);
  if (outcome.dissolved) end_group(*outcome.dissolved);
  if (!outcome.group) return false;
  if (outcome.is_new) begin_group(outcome);
  for (const TrackId member : outcome.joined)
    if (monitor_->contains(member)) remove(member, "group");
  if (!groups_->is_due(*outcome.group, on_map.timestamp, 0.5 * settings_.window)) {
    ++counts_.grouped;
    return true;
  }
  const auto [edge, height, slow] = groups_->cutting();
  TrackReport of_group = on_map;
  // Members may have several classes.
  of_group.track_class = 0;
  of_group.state = {groups_->centre_of(*outcome.group), {}};
  if (height == 0.0) of_group.state.position.z = on_map.state.position.z;
  of_group.position_error = on_map.position_error + ErrorBound::cylinder(std::sqrt(0.5) * edge, 0.5 * height);
  if (std::isfinite(on_map.velocity_error.total()))
    of_group.velocity_error = on_map.velocity_error + ErrorBound(slow);
  const std::string name = group_name(*outcome.group);
  const TrackId group_id = track_id_of(name);
  if (!monitor_->report(group_id, of_group)) return true;
  group_tracks_[group_id] = *outcome.group;
  NamedTrack* const known = names_.find(group_id);
  NamedTrack& named = known != nullptr ? *known : names_.add(group_id, name);
  named = track;
  named.motion_class = 0;
  named.text = name;
  named.stamp = report.stamp;
  named.position = report.position;
  return true;
}

void Watcher::begin_group(const TrackGroups::Outcome& outcome) {
  ++counts_.groups;
  const std::string name = group_name(*outcome.group);
  const TrackId id = track_id_of(name);
  if (!settings_.share.contains(id)) return;
  ++counts_.alerts;
  write(id, group_line(context(), monitor_->time(), name, outcome.joined.size()));
}

void Watcher::end_group(const TrackGroups::Cell& group) {
  const TrackId id = track_id_of(group_name(group));
  group_tracks_.erase(id);
  if (monitor_->contains(id)) remove(id, "dissolved");
}

bool Watcher::is_superseded(const SourceReport& report, const NamedTrack& known, std::size_t motion_class) {
  if (known.class_since && is_earlier(report.stamp, *known.class_since)) return true;
  return motion_class != known.motion_class && is_earlier(report.stamp, known.stamp);
}

double Watcher::velocity_age_of(const SourceReport& report) const {
  return std::max(report.velocity_age, settings_.velocity_age);
}

std::optional<TrackReport> Watcher::on_map(const SourceReport& report, NamedTrack& track) {
  TrackReport result{.timestamp = times_.seconds(report.stamp)};
  result.track_class = track.motion_class;
  if (!settings_.own.empty() && report.id == settings_.own) result.track_class += settings_.classes.size();
  double added_velocity_error = 0.0;
  if (is_geographic_) {
    // The velocity was measured a little earlier or later, elsewhere on the map than the reported position.
    const double error =
        report.position_error ? report.position_error->bound : settings_.position_error.bound.value_or(0.0);
    const double time = report.stamp_error.value_or(settings_.stamp_error) + velocity_age_of(report);
    const auto placed = frame_->place(report.position, report.has_height, report.velocity.value_or(Vec3{}),
                                      error + limits_of(track).largest_speed.horizontal() * time);
    if (!placed) return std::nullopt;
    result.state = placed->state;
    added_velocity_error = placed->velocity_error;
  } else {
    result.state = {report.position, report.velocity.value_or(Vec3{})};
  }
  add_errors(report, added_velocity_error, result, track);
  return result;
}

double Watcher::needed_bound(const FallbackError& fallback, const char* option) const {
  if (fallback.bound) return *fallback.bound;
  throw ProgramError(fmt::format("{}: expected it, because {} does not say how far off its reports may be",
                                 option, settings_.source));
}

void Watcher::add_errors(const SourceReport& report, double added_velocity_error, TrackReport& result,
                         NamedTrack& track) const {
  // Returns the bound of the stream, else that of the options, with its source.
  const auto said = [](const std::optional<DeclaredError>& error, const FallbackError& fallback,
                       std::string_view& declaration) -> std::optional<double> {
    declaration = error ? error->declaration : fallback.bound ? std::string_view(fallback.declaration) : "";
    return error ? std::optional(error->bound) : fallback.bound;
  };
  auto flat = said(report.position_error, settings_.position_error, track.position_by);
  if (!flat) flat = needed_bound(settings_.position_error, "--position-error");
  *flat += report.extent;
  auto upright = said(report.height_error, settings_.height_error, track.height_by);
  if (dimensions_ == 3 && !report.has_height) {
    upright = frame_ ? LocalFrame::largest_height : any_height;
    track.height_by = "unknown";
  }
  result.position_error = frame_
                              ? ErrorBound::cylinder(frame_->position_error(*flat), upright.value_or(*flat))
                              : spread_of(*flat, upright);
  result.timestamp_error = report.stamp_error.value_or(settings_.stamp_error);
  if (!report.velocity) {
    result.velocity_error = ErrorBound(unbounded);
    return;
  }
  auto turning = said(report.velocity_error, settings_.velocity_error, track.velocity_by);
  if (!turning) turning = needed_bound(settings_.velocity_error, "--velocity-error");
  const MotionLimits& limits = limits_of(track);
  auto climbing = said(report.climb_error, settings_.climb_error, track.climb_by);
  if (!report.has_climb) {
    climbing = dimensions_ == 2 ? 0.0 : limits.largest_speed.vertical();
    track.climb_by = "largest speed";
  }
  if (!std::isfinite(*turning)) {
    result.velocity_error = ErrorBound(unbounded);
    return;
  }
  *turning += report.velocity_spread;
  // The velocity was measured a little before or after the position.
  const double age = velocity_age_of(report);
  if (age > 0.0 && std::isfinite(limits.acceleration.total())) {
    *turning += age * limits.acceleration.horizontal();
    climbing = climbing.value_or(*turning) + age * limits.acceleration.vertical();
  }
  if (frame_)
    result.velocity_error = ErrorBound::cylinder(frame_->velocity_error(*turning) + added_velocity_error,
                                                 climbing.value_or(*turning));
  else
    result.velocity_error = spread_of(*turning, climbing);
}

}  // namespace kinesphere::program
