// Reads recorded motion from text files.
#include "tracks/track_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/input_file.hpp"
#include "base/program_error.hpp"
#include "formats/fields/suspicions.hpp"
#include "tracks/cleaning.hpp"
#include "tracks/echoes.hpp"
#include "tracks/handovers.hpp"
#include "tracks/headings.hpp"
#include "tracks/questions.hpp"
#include "tracks/raw_samples.hpp"

namespace kinesphere::program {
namespace {

template <class Visitor>
void for_each_sample(const RawTrackSet& raw, Visitor visit) {
  for (const RawTrack& track : raw.tracks())
    for (const RawSample& sample : track.samples) visit(sample);
}

/// Returns the time of all samples; nothing if there are several or no samples.
std::optional<FileTime> only_time(const RawTrackSet& raw) {
  std::optional<FileTime> time;
  bool is_only = true;
  for_each_sample(raw, [&](const RawSample& sample) {
    if (!time) time = sample.time;
    is_only = is_only && !is_earlier(*time, sample.time) && !is_earlier(sample.time, *time);
  });
  return is_only ? time : std::nullopt;
}

TimeScale time_scale_of(const RawTrackSet& raw) {
  TimeScale scale = raw.time_scale();
  std::optional<FileTime> first, last;
  for_each_sample(raw, [&](const RawSample& sample) {
    if (!first || is_earlier(sample.time, *first)) first = sample.time;
    if (!last || is_earlier(*last, sample.time)) last = sample.time;
  });
  if (first) scale.set_origin(*first, *last);
  return scale;
}

/// Asks about lengths that may be degrees.
void ask_about_degrees(const RawTrackSet& raw) {
  DegreeCheck check;
  for_each_sample(raw, [&](const RawSample& sample) { check.add(sample.position.x, sample.position.y); });
  if (const std::string suspicion = check.suspicion(); !suspicion.empty())
    throw ProgramError(fmt::format("{}: {}", raw.head().file, suspicion));
}

Coordinates coordinates_of(const RawTrackSet& raw, const TrackOptions& options) {
  const TableColumns& columns = raw.columns();
  const Vec3 units{columns.x().unit, columns.y().unit, columns.z() ? columns.z()->unit : 1.0};
  if (columns.geographic) {
    std::vector<Vec3> points;
    for_each_sample(raw, [&](const RawSample& sample) {
      const Vec3& at = sample.position;
      points.push_back({at.x * units.x, at.y * units.y, at.z * units.z});
    });
    if (points.empty()) return {};
    return Coordinates(project(points, columns.z().has_value(), options.projection), units);
  }
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  Box extent{{unbounded, unbounded, unbounded}, {-unbounded, -unbounded, -unbounded}};
  for_each_sample(raw, [&](const RawSample& sample) {
    for (int axis = 0; axis < 3; ++axis) {
      extent.lower[axis] = std::min(extent.lower[axis], sample.position[axis]);
      extent.upper[axis] = std::max(extent.upper[axis], sample.position[axis]);
    }
  });
  if (!(extent.lower.x <= extent.upper.x)) return {};
  if (!columns.positions_said && !columns.x().has_unit) ask_about_degrees(raw);
  std::optional<UtmZone> zone;
  if (options.hints.positions.starts_with("utm:"))
    zone = parse_utm_zone(std::string_view(options.hints.positions).substr(4), "--positions utm");
  return Coordinates(extent, units, zone);
}

/// Asks about ids that are another for each row, as the number of the row is.
void ask_about_row_numbers(const RawTrackSet& raw) {
  const bool all_alone = std::all_of(raw.tracks().begin(), raw.tracks().end(),
                                     [](const RawTrack& track) { return track.samples.size() <= 1; });
  if (!all_alone || raw.tracks().size() < 3 || !raw.columns()[Quantity::id]) return;
  // One frame has each id once.
  const auto has_other_time = [&](const RawTrack& track) {
    const auto& first = raw.tracks().front().samples;
    return !track.samples.empty() && !first.empty() && is_earlier(first[0].time, track.samples[0].time);
  };
  if (std::none_of(raw.tracks().begin(), raw.tracks().end(), has_other_time)) return;
  const std::size_t column = raw.columns()[Quantity::id]->place;
  const TableHead& head = raw.head();
  throw ProgramError(fmt::format(
      "{}: each row has an id of its own in {}, as a row number is: say id=... with --columns; it has {}",
      head.file,
      head.names.empty() ? fmt::format("column {}", column + 1)
                         : fmt::format("column '{}'", head.names[column]),
      head.text()));
}

/// Asks about numbers that may be clock times or days.
void ask_about_times(const RawTrackSet& raw) {
  if (raw.columns().time_unit_said || raw.time_scale().kind() != TimeKind::number) return;
  TimeCheck check;
  std::size_t most_samples = 0;
  for (const RawTrack& track : raw.tracks()) most_samples = std::max(most_samples, track.samples.size());
  for_each_sample(raw, [&](const RawSample& sample) { check.add(sample.time); });
  for (const std::string& suspicion : {check.clock_suspicion(), check.day_suspicion(most_samples)})
    if (!suspicion.empty()) throw ProgramError(fmt::format("{}: {}", raw.head().file, suspicion));
}

/// Returns a warning about rows that go back in time; nothing where none do, or all, as in a file that begins
/// with its end.
std::optional<std::string> warning_about_order(const RawTrackSet& raw) {
  std::size_t rows = 0;
  const RawTrack* first = nullptr;
  for (const RawTrack& track : raw.tracks()) {
    if (track.forward == 0) continue;
    rows += track.backward;
    if (track.backward > 0 && first == nullptr) first = &track;
  }
  if (first == nullptr) return std::nullopt;
  return fmt::format(
      "{}: this row and {} others are earlier than the row of their id before (id '{}'): rows are taken in "
      "the order of their times, so that a clock that was set back, or begins again, mixes two courses",
      raw.name(first->first_backward), rows - 1, first->id);
}

/// Returns a warning about places of a table that may be in radians by their numbers: as degrees, they are
/// around the Gulf of Guinea. Nothing where a unit is said.
std::optional<std::string> warning_of_radians(const RawTrackSet& raw) {
  const TableColumns& columns = raw.columns();
  const auto &longitude = columns[Quantity::longitude], &latitude = columns[Quantity::latitude];
  const bool is_table = columns.format.starts_with("table") || columns.format.starts_with("columns as given");
  if (!is_table || !longitude || !latitude || longitude->has_unit || latitude->has_unit) return std::nullopt;
  Vec3 farthest{};
  bool all_whole = true;
  for_each_sample(raw, [&](const RawSample& sample) {
    const Vec3& at = sample.position;
    farthest = {std::max(farthest.x, std::abs(at.x)), std::max(farthest.y, std::abs(at.y)), 0.0};
    all_whole = all_whole && at.x == std::floor(at.x) && at.y == std::floor(at.y);
  });
  constexpr double pi = 3.141592653589794, least = 0.2;
  if (all_whole || farthest.y < least || farthest.y > pi / 2 || farthest.x > pi) return std::nullopt;
  return fmt::format(
      "{}: all latitudes are from -{:.4g} to {:.4g}, and all longitudes from -{:.4g} to {:.4g}: if they are "
      "radians, say so with --columns ...,lon=...:rad,lat=...:rad",
      raw.head().file, farthest.y, farthest.y, farthest.x, farthest.x);
}

/// Returns a warning where no two tracks of several bodies are there at one time, as where clocks of files
/// count from different starts.
std::optional<std::string> warning_about_lone_tracks(const TrackSet& track_set) {
  std::vector<const RecordedTrack*> tracks;
  for (const RecordedTrack& track : track_set.tracks) tracks.push_back(&track);
  const auto begin = [](const RecordedTrack* track) { return track->from(); };
  const auto end = [](const RecordedTrack* track) { return track->until(); };
  std::sort(tracks.begin(), tracks.end(), [&](const auto* a, const auto* b) { return begin(a) < begin(b); });
  const RecordedTrack* other = nullptr;
  double last = -std::numeric_limits<double>::infinity();
  for (const RecordedTrack* track : tracks) {
    if (begin(track) <= last) return std::nullopt;
    last = end(track);
    if (track->id != tracks.front()->id && other == nullptr) other = track;
  }
  if (other == nullptr) return std::nullopt;
  const auto span = [&](const RecordedTrack* track) {
    return fmt::format("'{}' from {} to {}", track->id, track_set.times.text(begin(track)),
                       track_set.times.text(end(track)));
  };
  return fmt::format(
      "no two bodies are recorded at one time, so that there is no pair: {}, {}; clocks of files may count "
      "from different starts",
      span(tracks.front()), span(other));
}

/// The pieces of one id, before they are split at gaps.
struct Body {
  std::string id;
  double radius;
  RectangleBody size;
  std::vector<Piece> pieces;
  std::vector<double> placeless;  ///< times of rows without a position, in order
  Presence presence;              ///< without what became tracks
};

class Reading {
 public:
  Reading(const RawTrackSet& raw, const TrackOptions& options) : raw_(raw), options_(options) {
    static_cast<ReadCounts&>(track_set_) = raw.counts();
    if (auto warning = warning_about_order(raw)) track_set_.warnings.push_back(std::move(*warning));
    if (auto warning = warning_of_radians(raw)) track_set_.warnings.push_back(std::move(*warning));
    track_set_.times = time_scale_of(raw);
    track_set_.dates = raw.columns().dates;
    track_set_.coordinates = coordinates_of(raw, options);
    track_set_.in_metres = raw.columns().in_metres;
    track_set_.format = raw.columns().format;
    track_set_.has_sizes = options.hints.sizes;
    track_set_.has_heights = raw.columns().z().has_value();
    track_set_.is_plane = !raw.columns().z() && track_set_.coordinates.are_plane();
    if (track_set_.times.kind() == TimeKind::frames) track_set_.frame_rate = track_set_.times.rate();
    track_set_.filter = raw.columns().where;
    track_set_.outside = options.outside;
    track_set_.ground = options.ground;
    for (const std::size_t column : raw.columns().unused)
      track_set_.unused.push_back(raw.head().names.empty() ? fmt::format("{}", column + 1)
                                                           : raw.head().names[column]);
    track_set_.smallest_max_gap = std::numeric_limits<double>::infinity();
    track_set_.has_rectangles = track_set_.has_sizes && track_set_.coordinates.are_plane();
    if (!track_set_.has_rectangles) return;
    headings_ = heading_scale_of(raw, options, track_set_.coordinates);
    track_set_.headings = headings_.text;
  }

  TrackSet run() {
    for (const RawTrack& track : raw_.tracks()) bodies_.push_back(cleaned(track));
    std::vector<double> intervals;
    for (const Body& body : bodies_)
      for (const Piece& piece : body.pieces) add_intervals(piece, intervals);
    track_set_.sample_interval = median_interval(std::move(intervals));
    for (const Body& body : bodies_) {
      if (body.presence.first > body.presence.last) continue;
      span_.from = std::min(span_.from, body.presence.first);
      span_.until = std::max(span_.until, body.presence.last);
    }
    for (const Body& body : bodies_) add_tracks(body);
    if (!options_.counts_handovers) hand_over();
    if (auto warning = warning_about_lone_tracks(track_set_))
      track_set_.warnings.push_back(std::move(*warning));
    return std::move(track_set_);
  }

 private:
  Body cleaned(const RawTrack& track) {
    Body body{.id = track.id, .radius = track.radius, .size = {.length = track.length, .width = track.width}};
    if (raw_.columns().z()) {
      body.size.height = track.height;
      body.radius = std::hypot(body.radius, 0.5 * track.height);
    }
    Piece samples;
    samples.reserve(track.samples.size());
    for (const RawSample& sample : track.samples) {
      samples.push_back(
          {{track_set_.times.seconds(sample.time), track_set_.coordinates.local(sample.position)},
           sample.place,
           sample.heading});
    }
    leave_one_at_each_time(samples, track.id, options_.duplicates, raw_, track_set_.duplicates);
    leave_out_echoes(samples, raw_, track_set_.echoes);
    body.presence = presence_of(track, samples);
    if (options_.max_speed) {
      body.pieces = split_by_speed(samples, *options_.max_speed, raw_, track_set_.too_fast);
    } else {
      body.pieces.push_back(std::move(samples));
    }
    for (const RawTrack::Placeless& at : track.timed_placeless)
      body.placeless.push_back(track_set_.times.seconds(at.time));
    std::sort(body.placeless.begin(), body.placeless.end());
    return body;
  }

  Presence presence_of(const RawTrack& track, const Piece& samples) const {
    constexpr double never = std::numeric_limits<double>::infinity();
    Presence presence{
        .id = track.id, .first = never, .last = -never, .samples = track.placeless + samples.size()};
    const auto add = [&](double time) {
      presence.first = std::min(presence.first, time);
      presence.last = std::max(presence.last, time);
    };
    for (const PlacedSample& sample : samples) add(sample.sample.time);
    for (const RawTrack::Placeless& row : track.timed_placeless) add(track_set_.times.seconds(row.time));
    return presence;
  }

  /// Fewer than 3 intervals give no reliable median.
  double max_gap_of(const Body& body) const {
    if (options_.is_plan) return std::numeric_limits<double>::infinity();
    if (options_.max_gap) return *options_.max_gap;
    std::vector<double> intervals;
    for (const Piece& piece : body.pieces) add_intervals(piece, intervals);
    return 2.5 * (intervals.size() < 3 ? track_set_.sample_interval : median_interval(std::move(intervals)));
  }

  void add_tracks(const Body& body) {
    const double max_gap = max_gap_of(body);
    track_set_.smallest_max_gap = std::min(track_set_.smallest_max_gap, max_gap);
    track_set_.largest_max_gap = std::max(track_set_.largest_max_gap, max_gap);
    Presence& presence = track_set_.presences.emplace_back(body.presence);
    presence.first_track = track_set_.tracks.size();
    const std::span<const double> breaks =
        options_.missing == MissingPolicy::split ? body.placeless : std::span<const double>();
    std::vector<Piece> pieces;
    for (const Piece& whole : body.pieces)
      for (Piece& piece : split_at_gaps(whole, max_gap, breaks)) pieces.push_back(std::move(piece));
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      RecordedTrack track{.id = body.id, .samples = {}, .radius = body.radius};
      if (track_set_.has_rectangles)
        track.shape = rectangle_of(pieces[k], body.size, headings_, raw_.columns().place);
      for (const PlacedSample& sample : pieces[k]) track.samples.push_back(sample.sample);
      if (options_.outside != Outside::vanish) reach_outside(track, k == 0, k + 1 == pieces.size());
      if (track.samples.size() == 1) {
        ++track_set_.left_out;
        continue;
      }
      track_set_.samples += pieces[k].size();
      presence.used += pieces[k].size();
      presence.first = std::min(presence.first, track.from());
      presence.last = std::max(presence.last, track.until());
      ++presence.tracks;
      track_set_.tracks.push_back(std::move(track));
    }
  }

  /// A body that goes on under another id is not outside of its samples.
  void hand_over() {
    track_set_.handovers = handovers_in(track_set_);
    for (const Handover& handover : track_set_.handovers) {
      Presence &from = track_set_.presences[handover.from], &to = track_set_.presences[handover.to];
      RecordedTrack &last = track_set_.tracks[from.first_track + from.tracks - 1],
                    &first = track_set_.tracks[to.first_track];
      last.reaches_on_to.reset();
      last.rests.last = false;
      from.last = bodies_[handover.from].presence.last;
      first.reaches_back_to.reset();
      first.rests.first = false;
      to.first = bodies_[handover.to].presence.first;
    }
  }

  /// Makes the first and the last track of an id reach to the ends of the recording. One sample is enough for
  /// a body that stays.
  void reach_outside(RecordedTrack& track, bool is_first, bool is_last) const {
    const bool stays = options_.outside == Outside::stay, is_alone = track.samples.size() == 1;
    if (is_alone && !stays) return;
    const TrackSample first = track.samples.front(), last = track.samples.back();
    if (is_last && last.time < span_.until) {
      track.reaches_on_to = span_.until;
      track.rests.last = stays;
      if (is_alone) track.samples.push_back({span_.until, last.position});
    }
    if (is_first && span_.from < first.time) {
      track.reaches_back_to = span_.from;
      track.rests.first = stays;
      if (track.samples.size() == 1)
        track.samples.insert(track.samples.begin(), {span_.from, first.position});
    }
  }

  const RawTrackSet& raw_;
  const TrackOptions& options_;
  TrackSet track_set_;
  HeadingScale headings_;
  std::vector<Body> bodies_;
  /// From the first to the last row of all ids.
  struct {
    double from = std::numeric_limits<double>::infinity(), until = -std::numeric_limits<double>::infinity();
  } span_;
};

void check(const TrackOptions& options) {
  if (options.max_gap && !(*options.max_gap >= 0))
    throw ProgramError(fmt::format("--max-gap: expected a number >= 0, but got {}", *options.max_gap));
  if (options.max_gap && options.is_plan)
    throw ProgramError("--max-gap: expected none with --plan, whose ways have no gaps");
  if (options.max_speed && !(*options.max_speed > 0))
    throw ProgramError(fmt::format("--max-speed: expected a number > 0, but got {}", *options.max_speed));
}

/// Throws ProgramError, at the first thing that is asked about.
TrackSet parse_once(const std::vector<NamedText>& texts, const TrackOptions& options) {
  RawTrackSet raw(options, texts.size() > 1);
  std::vector<std::string> files;
  for (const NamedText& text : texts) {
    files.push_back(text.file);
    raw.read(text.text, text.file);
  }
  raw.ask_about_identities();
  ask_about_row_numbers(raw);
  raw.ask_about_ids();
  ask_about_times(raw);
  raw.ask_about_scenes();
  TrackSet track_set = Reading(raw, options).run();
  if (track_set.tracks.empty()) {
    if (track_set.rows > 0 && track_set.filtered.count == track_set.rows)
      throw ProgramError(fmt::format("{}: expected rows for which this holds: {}; but there are none",
                                     fmt::join(files, ", "), track_set.filter));
    if (track_set.rows > 0 && track_set.ignored.count == track_set.rows)
      throw ProgramError(fmt::format("{}: expected an id that --ignore does not name, but there is none",
                                     fmt::join(files, ", ")));
    if (track_set.malformed.count > 0 && track_set.malformed.count == track_set.rows)
      throw ProgramError(track_set.warnings.front());
    if (track_set.too_fast.count > 0)
      throw ProgramError(
          fmt::format("{}: expected an id with two samples that can be reached at --max-speed {}, "
                      "but there is none",
                      fmt::join(files, ", "), *options.max_speed));
    if (const auto time = only_time(raw))
      throw ProgramError(fmt::format("{}: expected samples at two times or more, but all are at {}",
                                     fmt::join(files, ", "),
                                     track_set.times.text(track_set.times.seconds(*time))));
    const std::string all_files = fmt::format("{}", fmt::join(files, ", "));
    if (options.is_plan)
      throw ProgramError(fmt::format("{}: expected an id with two waypoints, but there is none", all_files));
    throw ProgramError(fmt::format(
        "{}: expected an id with two samples at most {} s apart, but there is none: see --max-gap, "
        "and --plan where rows are waypoints",
        all_files, track_set.largest_max_gap));
  }
  return track_set;
}

}  // namespace

TrackSet parse_tracks(std::vector<NamedText> texts, const TrackOptions& options) {
  check(options);
  std::optional<TrackSet> found;
  ask_all(options.hints, [&](const ColumnHints& hints) {
    TrackOptions hinted = options;
    hinted.hints = hints;
    found.emplace(parse_once(texts, hinted));
  });
  return std::move(*found);
}

std::vector<NamedText> read_texts(const std::vector<std::string>& files) {
  std::vector<NamedText> texts;
  texts.reserve(files.size());
  for (const std::string& file : files)
    texts.push_back({file == "-" ? "standard input" : file, read_input(file)});
  return texts;
}

TrackSet read_tracks(const std::vector<std::string>& files, const TrackOptions& options) {
  return parse_tracks(read_texts(files), options);
}

}  // namespace kinesphere::program
