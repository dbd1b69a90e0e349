// Where the tracks of a watch are: in the plane or space of the stream, or on a map of a part of the earth.
#include "watch/tracks/track_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Bound of a height that is not known, where heights have no unit.
constexpr double any_height = 1e9;

/// Returns a horizontal and a vertical bound, or one for all directions if the vertical one is absent.
ErrorBound spread_of(double flat, const std::optional<double>& upright) {
  return upright ? ErrorBound::cylinder(flat, *upright) : ErrorBound(flat);
}

/// Returns the bound of the stream, else that of the options, and its source.
std::optional<double> said(const std::optional<DeclaredError>& error, const FallbackError& fallback,
                           std::string_view& declaration) {
  declaration = error ? error->declaration : fallback.bound ? std::string_view(fallback.declaration) : "";
  return error ? std::optional(error->bound) : fallback.bound;
}

}  // namespace

void TrackMap::begin(const SourceReport& first, const TrackClasses& classes) {
  if (!first.geographic && !first.in_metres && !settings_.measured_option.empty())
    throw ProgramError(
        fmt::format("{}: expected numbers without a unit, because the unit of the lengths of {} is not "
                    "known, but got '{}'{}",
                    settings_.measured_option, settings_.source, settings_.measured_text,
                    settings_.format == "jsonl" ? "" : ": say --unit"));
  is_geographic_ = first.geographic;
  dimensions_ = settings_.dimensions.value_or(first.has_height || first.may_have_height ? 3 : 2);
  origin_ = settings_.origin.value_or(WatchSettings::Origin{first.position.y, first.position.x});
  go_on(classes);
}

void TrackMap::go_on(const TrackClasses& classes) {
  if (is_geographic_) begin_frame(classes);
  begin_areas();
}

void TrackMap::begin_frame(const TrackClasses& classes) {
  // A track is dropped before it gets farther than this beyond the radius.
  const double margin = classes.fastest() * settings_.forget;
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
  frame_.emplace(origin_.latitude, origin_.longitude, settings_.radius, margin);
}

void TrackMap::begin_areas() {
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

MonitorDefinition TrackMap::definition(const TrackClasses& classes, double start_time) const {
  MonitorDefinition definition{.dimensions = dimensions_,
                               .start_time = start_time,
                               .window = settings_.window,
                               .stale_after = settings_.silence,
                               .drop_after = settings_.forget,
                               .prediction_hold = settings_.hold,
                               .prediction_confirmation = settings_.confirm,
                               .prediction_margin = 0.1,
                               // About the 95 % of which errors are declared multiples.
                               .prediction_error_part = 0.4,
                               .shard = settings_.share};
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const auto& [acceleration, largest_speed] = classes[k].limits;
    definition.classes.push_back(
        frame_ ? frame_->promise(acceleration, largest_speed)
               : TrackClass{.acceleration_limit = acceleration, .largest_speed = largest_speed});
  }
  SeparationRule rule;
  double least = unbounded;
  for (const NamedSeparation& named : settings_.separations) {
    const Separation& separation = named.separation;
    rule.levels.push_back(frame_ ? frame_->separation(separation) : separation);
    least = std::min(least, separation.horizontal);
    if (dimensions_ == 3) least = std::min(least, separation.vertical);
  }
  definition.tolerance = 1e-4 * least;
  const std::size_t base = definition.classes.size();
  // The own track has classes of its own, whose pairs with others are the only ones.
  if (!settings_.own.empty())
    for (std::size_t k = 0; k < base; ++k) definition.classes.emplace_back(definition.classes[k]);
  for (std::size_t first = 0; first < base; ++first)
    for (std::size_t second = settings_.own.empty() ? first : base; second < definition.classes.size();
         ++second) {
      rule.first_class = first;
      rule.second_class = second;
      definition.separations.push_back(rule);
    }
  return definition;
}

std::optional<TrackReport> TrackMap::place(const SourceReport& report, double timestamp,
                                           const TrackClasses& classes, Declared& declared) const {
  TrackReport result{.timestamp = timestamp};
  const MotionLimits& limits = classes[declared.motion_class].limits;
  result.track_class = declared.motion_class;
  if (!settings_.own.empty() && report.id == settings_.own) result.track_class += classes.size();
  double velocity_error_of_map = 0.0;
  if (is_geographic_) {
    // The velocity was measured a little earlier or later, elsewhere on the map than the reported position.
    const double error =
        report.position_error ? report.position_error->bound : settings_.position_error.bound.value_or(0.0);
    const double time = report.stamp_error.value_or(settings_.stamp_error) + velocity_age_of(report);
    const auto placed = frame_->place(report.position, report.has_height, report.velocity.value_or(Vec3{}),
                                      error + limits.largest_speed.horizontal() * time);
    if (!placed) return std::nullopt;
    result.state = placed->state;
    velocity_error_of_map = placed->velocity_error;
  } else {
    result.state = {report.position, report.velocity.value_or(Vec3{})};
  }
  result.position_error = position_error(report, declared);
  result.timestamp_error = report.stamp_error.value_or(settings_.stamp_error);
  result.velocity_error = velocity_error(report, limits, velocity_error_of_map, declared);
  return result;
}

double TrackMap::velocity_age_of(const SourceReport& report) const {
  return std::max(report.velocity_age, settings_.velocity_age);
}

double TrackMap::needed_bound(const FallbackError& fallback, const char* option) const {
  if (fallback.bound) return *fallback.bound;
  throw ProgramError(fmt::format("{}: expected it, because {} does not say how far off its reports may be",
                                 option, settings_.source));
}

ErrorBound TrackMap::position_error(const SourceReport& report, Declared& declared) const {
  auto flat = said(report.position_error, settings_.position_error, declared.position_by);
  if (!flat) flat = needed_bound(settings_.position_error, "--position-error");
  *flat += report.extent;
  auto upright = said(report.height_error, settings_.height_error, declared.height_by);
  if (lacks_height(report)) {
    upright = frame_ ? LocalFrame::largest_height : any_height;
    declared.height_by = unknown_height;
  }
  return frame_ ? ErrorBound::cylinder(frame_->position_error(*flat), upright.value_or(*flat))
                : spread_of(*flat, upright);
}

/// `of_map`: what the map adds to the error.
ErrorBound TrackMap::velocity_error(const SourceReport& report, const MotionLimits& limits, double of_map,
                                    Declared& declared) const {
  if (!report.velocity) return ErrorBound(unbounded);
  auto turning = said(report.velocity_error, settings_.velocity_error, declared.velocity_by);
  if (!turning) turning = needed_bound(settings_.velocity_error, "--velocity-error");
  auto climbing = said(report.climb_error, settings_.climb_error, declared.climb_by);
  if (!report.has_climb) {
    climbing = dimensions_ == 2 ? 0.0 : limits.largest_speed.vertical();
    declared.climb_by = "largest speed";
  }
  if (!std::isfinite(*turning)) return ErrorBound(unbounded);
  *turning += report.velocity_spread;
  // The velocity was measured a little before or after the position.
  const double age = velocity_age_of(report);
  if (age > 0.0 && std::isfinite(limits.acceleration.total())) {
    *turning += age * limits.acceleration.horizontal();
    climbing = climbing.value_or(*turning) + age * limits.acceleration.vertical();
  }
  return frame_ ? ErrorBound::cylinder(frame_->velocity_error(*turning) + of_map, climbing.value_or(*turning))
                : spread_of(*turning, climbing);
}

bool TrackMap::is_in_area(const TrackView& track) const {
  const auto contains = [&](const Circle& area) {
    return std::any_of(track.places.begin(), track.places.end(), [&](const TrackView::Place& place) {
      return std::hypot(place.centre.x - area.centre.x, place.centre.y - area.centre.y) <= area.radius;
    });
  };
  return std::any_of(areas_.begin(), areas_.end(), contains);
}

}  // namespace kinesphere::program
