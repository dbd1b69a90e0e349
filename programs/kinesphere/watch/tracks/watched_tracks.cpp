// The tracks of a watch, and their reports as the monitor takes them.
#include "watch/tracks/watched_tracks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/program_error.hpp"
#include "formats/fields/wrong_input.hpp"
#include "formats/streams/known_names.hpp"

namespace kinesphere::program {
namespace {

bool knows_velocity(const SourceReport& report) {
  return report.velocity && !(report.velocity_error && !std::isfinite(report.velocity_error->bound));
}

}  // namespace

WatchedTracks::WatchedTracks(const WatchSettings& settings, WatchCounts& counts, const ReportClock& clock,
                             Refuse refuse)
    : settings_(settings),
      counts_(counts),
      clock_(clock),
      refuse_(std::move(refuse)),
      classes_(settings.classes),
      map_(settings),
      rest_{.speed = settings.rest_speed, .room = settings.small_length()} {}

void WatchedTracks::begin_classes(const SourceReport& report) {
  if (settings_.has_automatic_classes) classes_.begin(report.sayable);
}

void WatchedTracks::begin_map(const SourceReport& report) {
  map_.begin(report, classes_);
  has_map_ = true;
}

void WatchedTracks::go_on() {
  names_.for_each([&](const NamedTrack& track) {
    if (track.declared.motion_class >= classes_.size())
      throw WrongInput("expected a class of each track in the snapshot");
  });
  if (has_map_) map_.go_on(classes_);
}

bool WatchedTracks::recognise(Arrival& arrival) {
  const SourceReport& report = arrival.report;
  arrival.id = track_id_of(report.id);
  arrival.known = names_.find(arrival.id);
  arrival.declared.motion_class = classes_.choose(report, arrival.known);
  return knows_velocity(report) ||
         std::isfinite(classes_[arrival.declared.motion_class].limits.largest_speed.total());
}

void WatchedTracks::refuse_without_velocity(bool is_first) {
  if (is_first)
    throw ProgramError(
        fmt::format("--largest-speed: expected it, because {} has positions without velocities: an "
                    "acceleration alone does not say how far a track goes",
                    settings_.source));
  ++counts_.no_velocity;
}

bool WatchedTracks::place(Arrival& arrival, bool has_room) {
  if (!is_usable(arrival, has_room)) return false;
  const SourceReport& report = arrival.report;
  const auto on_map = map_.place(report, clock_.seconds(report.stamp), classes_, arrival.declared);
  if (on_map)
    arrival.on_map = *on_map;
  else
    ++counts_.outside;
  return on_map.has_value();
}

/// Returns false, and counts the report, if it cannot be used.
bool WatchedTracks::is_usable(const Arrival& arrival, bool has_room) {
  const auto& [report, id, known, declared, on_map] = arrival;
  const auto no = [](std::uint64_t& count) {
    ++count;
    return false;
  };
  if (report.geographic != map_.is_geographic()) {
    refuse_(fmt::format("expected the position of {} in the same words as the first: {}", report.id,
                        map_.is_geographic() ? "latitude and longitude" : "x and y"));
    return false;
  }
  if (map_.ignores_height_of(report)) ++counts_.ignored_heights;
  if (map_.lacks_height(report) && report.on_ground) return no(counts_.on_ground);
  if (known == nullptr) return has_room || no(counts_.crowded);
  if (known->text != report.id) {
    refuse_(fmt::format("the ids {} and {} cannot be told apart", known->text, report.id));
    return false;
  }
  const bool is_repeated = known->position == report.position &&
                           std::abs(seconds_between(known->stamp, report.stamp)) <= report.same_within;
  if (is_repeated) return no(counts_.repeated);
  return !is_superseded(arrival) || no(counts_.superseded);
}

/// True if the report is from before its track had its present class, or would change it from the past.
bool WatchedTracks::is_superseded(const Arrival& arrival) const {
  const NamedTrack& known = *arrival.known;
  const FileTime& stamp = arrival.report.stamp;
  if (known.class_since && is_earlier(stamp, *known.class_since)) return true;
  return arrival.declared.motion_class != known.declared.motion_class && is_earlier(stamp, known.stamp);
}

bool WatchedTracks::remember(Arrival& arrival) {
  const SourceReport& report = arrival.report;
  if (report.id == settings_.own && !settings_.own.empty()) ++counts_.of_own;
  if (map_.lacks_height(report)) ++counts_.no_height;
  if (knows_velocity(report)) ++counts_.with_velocity;
  // Times of arrival tell that reports are late, and not in disorder.
  constexpr double seconds_of_disorder = 5.0;
  if (clock_.age_of(report.stamp) > seconds_of_disorder && clock_.goes_by_stamps()) ++counts_.behind;
  const bool is_first = arrival.known == nullptr;
  if (is_first) arrival.known = &names_.add(arrival.id, report.id);
  NamedTrack& track = *arrival.known;
  if (const std::string_view name = shown_name(report.name); !name.empty()) track.name = name;
  if (!is_first && is_earlier(report.stamp, track.stamp)) return false;
  track.stamp = report.stamp;
  track.position = report.position;
  track.extent = report.extent;
  if (!is_first && track.declared.motion_class != arrival.declared.motion_class)
    track.class_since = report.stamp;
  track.declared = arrival.declared;
  if (classes_.contradicts_rest(report)) track.contradicted_rest = report.stamp;
  return note_rest(arrival, is_first);
}

/// Returns true if the track was at rest, and is under way by its latest report.
bool WatchedTracks::note_rest(const Arrival& arrival, bool is_first) {
  if (!has_rest()) return false;
  const SourceReport& report = arrival.report;
  std::optional<double> speed = report.ground_speed;
  if (!speed && report.velocity) speed = norm({report.velocity->x, report.velocity->y, 0.0});
  if (!speed && report.said_kind == MotionPreset::aid_to_navigation) speed = 0.0;
  return rest_.take(arrival.known->rest, arrival.on_map.state.position, speed, arrival.on_map.timestamp,
                    is_first);
}

bool WatchedTracks::are_at_rest(TrackId first, TrackId second) const {
  if (!has_rest()) return false;
  const NamedTrack* const one = names_.find(first);
  const NamedTrack* const other = names_.find(second);
  return one != nullptr && other != nullptr && one->rest.is_at_rest && other->rest.is_at_rest;
}

}  // namespace kinesphere::program
