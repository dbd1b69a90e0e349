// Reports of a stream as reports of tracks, with their errors.
#include "watch/watcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/program_error.hpp"
#include "formats/streams/known_names.hpp"

namespace kinesphere::program {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Bound of a height that is not known, where heights have no unit.
constexpr double any_height = 1e9;

/// Returns a horizontal and a vertical bound, or one for all directions if the vertical one is absent.
ErrorBound spread_of(double flat, const std::optional<double>& upright) {
  return upright ? ErrorBound::cylinder(flat, *upright) : ErrorBound(flat);
}

}  // namespace

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
  begin_bodies();
  groups_.emplace(cutting());
}

void Watcher::deliver(const SourceReport& report) {
  const double age = seconds_between(report.stamp, clock_.now());
  if (age > settings_.forget || -age > settings_.leap) {
    ++(age > 0.0 ? counts_.stale : counts_.ahead);
    return;
  }
  if (!monitor_ && settings_.has_automatic_classes) settings_.classes.begin(report.sayable);
  const TrackId id = track_id_of(report.id);
  NamedTrack* const known = names_.find(id);
  NamedTrack track;
  track.motion_class = settings_.classes.choose(report, known);
  if (!knows_velocity(report) && !std::isfinite(limits_of(track).largest_speed.total()))
    return refuse_without_velocity();
  if (!monitor_) begin_monitor(report);
  if (!is_usable(report, known, track)) return;
  const auto on_map = this->on_map(report, track);
  if (!on_map) {
    ++counts_.outside;
    return;
  }
  if (watch_as_group(report, id, *on_map, track)) return;
  if (const auto taken = monitor_->report(id, *on_map); !taken)
    return refuse(fmt::format("{}: {}", report.id, message_of(taken.error())));
  if (!settings_.own.empty() && report.id == settings_.own) ++counts_.of_own;
  if (lacks_height(report)) ++counts_.no_height;
  if (knows_velocity(report)) ++counts_.with_velocity;
  // Times of arrival tell that reports are late, and not in disorder.
  constexpr double seconds_of_disorder = 5.0;
  if (age > seconds_of_disorder && clock_.source() == StreamClock::Source::stamps) ++counts_.behind;
  remember(id, report, known != nullptr ? *known : names_.add(id, report.id), track, *on_map,
           known == nullptr);
}

bool Watcher::knows_velocity(const SourceReport& report) {
  return report.velocity && !(report.velocity_error && !std::isfinite(report.velocity_error->bound));
}

void Watcher::refuse_without_velocity() {
  if (!monitor_ || monitor_->counters().reports == 0)
    throw ProgramError(
        fmt::format("--largest-speed: expected it, because {} has positions without velocities: an "
                    "acceleration alone does not say how far a track goes",
                    settings_.source));
  ++counts_.no_velocity;
}

/// Returns false, and counts the report, if it cannot be used. `known`: its track; null for a new one.
/// `track` has the class of the report.
bool Watcher::is_usable(const SourceReport& report, const NamedTrack* known, const NamedTrack& track) {
  const auto no = [](std::uint64_t& count) {
    ++count;
    return false;
  };
  if (report.geographic != is_geographic_) {
    refuse(fmt::format("expected the position of {} in the same words as the first: {}", report.id,
                       is_geographic_ ? "latitude and longitude" : "x and y"));
    return false;
  }
  ignores_heights_ = ignores_heights_ || (dimensions_ == 2 && !settings_.dimensions && report.has_height);
  if (lacks_height(report) && report.on_ground) return no(counts_.on_ground);
  if (known == nullptr) return has_room() || no(counts_.crowded);
  if (known->text != report.id) {
    refuse(fmt::format("the ids {} and {} cannot be told apart", known->text, report.id));
    return false;
  }
  const bool is_repeated = known->position == report.position &&
                           std::abs(seconds_between(known->stamp, report.stamp)) <= report.same_within;
  if (is_repeated) return no(counts_.repeated);
  return !is_superseded(report, *known, track.motion_class) || no(counts_.superseded);
}

/// Remembers a report that the monitor has taken. `track` has the class and the declarations of the report.
void Watcher::remember(TrackId id, const SourceReport& report, NamedTrack& named, const NamedTrack& track,
                       const TrackReport& on_map, bool is_first) {
  if (const std::string_view name = shown_name(report.name); !name.empty()) named.name = name;
  if (is_first || seconds_between(named.stamp, report.stamp) >= 0.0) {
    named.stamp = report.stamp;
    named.position = report.position;
    named.extent = report.extent;
    if (!is_first && named.motion_class != track.motion_class) named.class_since = report.stamp;
    named.motion_class = track.motion_class;
    if (settings_.classes.contradicts_rest(report)) named.contradicted_rest = report.stamp;
    named.position_by = track.position_by;
    named.height_by = track.height_by;
    named.velocity_by = track.velocity_by;
    named.climb_by = track.climb_by;
    note_rest(id, named, report, on_map, is_first);
  }
  compare_bodies(id, named.seen, on_map, is_first);
  enter_area(id);
  release_due();
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
    track.height_by = unknown_height;
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
