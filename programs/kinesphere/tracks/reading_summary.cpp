// A summary of what was read.
#include "tracks/reading_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tracks/coverage_summary.hpp"

namespace kinesphere::program {
namespace {

/// Share of all rows above which dropped rows cause a warning.
constexpr double large_part = 0.03;

std::string format_text(const TrackSet& track_set) {
  std::string text = fmt::format("{}, {}", track_set.format, track_set.is_plane ? "2D" : "3D");
  if (track_set.frame_rate > 0) text += fmt::format(", {} frames/s", track_set.frame_rate);
  if (track_set.times.kind() == TimeKind::utc) text += ", dates with a zone";
  if (track_set.times.kind() == TimeKind::date) text += ", dates without a zone";
  return text;
}

/// Names the first columns, on one line.
std::string unused_text(const TrackSet& track_set) {
  constexpr std::size_t most = 12;
  const auto& names = track_set.unused;
  const std::size_t shown = std::min(most, names.size());
  return fmt::format("columns {}{}",
                     fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "");
}

std::string gap_text(const TrackSet& track_set) {
  if (std::isinf(track_set.smallest_max_gap)) return "not cut at gaps";
  const std::string smallest = number(track_set.smallest_max_gap);
  const std::string largest = number(track_set.largest_max_gap);
  return smallest == largest ? fmt::format("cut at gaps over {} s", smallest)
                             : fmt::format("cut at gaps over {} s to {} s, by id", smallest, largest);
}

std::string first_places(const Tally& tally) {
  return fmt::format("{}{}", fmt::join(tally.first_places, ", "),
                     tally.count > tally.first_places.size() ? ", ..." : "");
}

void add_tally(Summary& summary, const std::string& label, const Tally& tally) {
  if (tally.count > 0) summary.row(label, grouped(tally.count), first_places(tally));
}

}  // namespace

void add_track_set(Summary& summary, const std::vector<std::string>& files, const TrackSet& track_set,
                   const TrackScene& scene, const Coverage& coverage) {
  summary.row(files.size() == 1 ? "file" : "files", fmt::format("{}", fmt::join(files, ", ")));
  summary.row("format", format_text(track_set));
  if (!track_set.unused.empty()) summary.row("not used", unused_text(track_set));
  if (const std::string projection = track_set.coordinates.description(); !projection.empty())
    summary.row("projection", projection);
  summary.row("tracks", grouped(track_set.tracks.size()),
              fmt::format("of {} ids, {}", grouped(track_set.presences.size()), gap_text(track_set)));
  summary.row(
      "samples", grouped(track_set.samples),
      fmt::format("every {} s, of {} rows", number(track_set.sample_interval), grouped(track_set.rows)));
  if (track_set.has_sizes) {
    const auto is_sized = [](const RecordedTrack& track) { return track.radius > 0.0; };
    const auto smaller = [](const RecordedTrack& a, const RecordedTrack& b) { return a.radius < b.radius; };
    const auto& tracks = track_set.tracks;
    summary.row("sizes",
                grouped(static_cast<std::uint64_t>(std::count_if(tracks.begin(), tracks.end(), is_sized))),
                fmt::format("of the tracks, the largest of radius {}; the others are points",
                            number(std::max_element(tracks.begin(), tracks.end(), smaller)->radius)));
    if (track_set.has_rectangles) {
      const auto is_turned = [](const RecordedTrack& track) { return track.shape.length > 0.0; };
      const auto turned = std::count_if(tracks.begin(), tracks.end(), is_turned);
      const auto sized = std::count_if(tracks.begin(), tracks.end(), is_sized);
      summary.row("headings", grouped(static_cast<std::uint64_t>(turned)),
                  track_set.headings +
                      (turned == sized ? "" : "; bodies that do not move, and have none, are discs"));
    }
  }
  if (!track_set.filter.empty())
    summary.row("left out", grouped(track_set.filtered.count),
                fmt::format("rows for which not: {}", track_set.filter));
  add_tally(summary, "ignored ids", track_set.ignored);
  if (track_set.on_ground.count > 0)
    summary.row("on the ground", grouped(track_set.on_ground.count),
                track_set.ground.empty() ? fmt::format("without a height, left out: {} (see --ground)",
                                                       first_places(track_set.on_ground))
                                         : fmt::format("without a height, taken at {}", track_set.ground));
  add_tally(summary, "missing values", track_set.missing);
  add_tally(summary, "malformed", track_set.malformed);
  add_tally(summary, "repeated", track_set.repeated);
  add_tally(summary, "duplicates", track_set.duplicates);
  add_tally(summary, "heard twice", track_set.echoes);
  add_tally(summary, "too fast", track_set.too_fast);
  if (track_set.left_out > 0) {
    summary.row(
        "alone", grouped(track_set.left_out),
        fmt::format("samples between two gaps, left out: {} of the rows",
                    percent(static_cast<double>(track_set.left_out), static_cast<double>(track_set.rows))));
  }
  add_coverage(summary, coverage, track_set);
  const Scene& run = scene.scene;
  summary.row("span", fmt::format("{} s", number(run.end_time - run.world.start_time)),
              fmt::format("from {} to {}", track_set.times.text(run.world.start_time),
                          track_set.times.text(run.end_time)));
}

std::vector<std::string> warnings_of(const TrackSet& track_set) {
  std::vector<std::string> warnings = track_set.warnings;
  const auto add = [&](std::size_t part, std::string_view what) {
    const auto rows = static_cast<double>(track_set.rows);
    if (static_cast<double>(part) > large_part * rows)
      warnings.push_back(fmt::format("{} of {} rows ({}) {}", grouped(part), grouped(track_set.rows),
                                     percent(static_cast<double>(part), rows), what));
  };
  add(track_set.left_out, "were left out, alone between two gaps: a longer --max-gap keeps them");
  if (track_set.ground.empty())
    add(track_set.on_ground.count,
        "are of aircraft on the ground and left out: --ground gives them a height");
  add(track_set.missing.count, "have no time or no position");
  add(track_set.malformed.count, "are malformed");
  add(track_set.duplicates.count, "repeat a time of their id");
  add(track_set.echoes.count,
      "repeat a place of their id a little later, as from a second receiver, and are left out");
  add(track_set.too_fast.count, "were left out by --max-speed");
  return warnings;
}

std::vector<std::string> warnings_of(const TrackSet& track_set, const TrackScene& scene) {
  std::vector<std::string> warnings = warnings_of(track_set);
  const Overshoots& overshoots = scene.overshoots;
  if (overshoots.straightened > 0)
    warnings.push_back(
        fmt::format("the splines of {} tracks swing out farther than all of their samples are apart, by up "
                    "to {} (id '{}' "
                    "after {}), and are replaced by straight lines from sample to sample: see --max-speed "
                    "and --interpolate "
                    "linear",
                    grouped(overshoots.straightened), number(overshoots.most_absurd.size),
                    overshoots.most_absurd.id, track_set.times.text(overshoots.most_absurd.time)));
  if (overshoots.tracks > 0) {
    warnings.push_back(fmt::format(
        "the splines of {} tracks swing out far beyond their samples, by up to {} (id '{}' after {}): see "
        "--max-speed and --interpolate linear",
        grouped(overshoots.tracks), number(overshoots.largest.size), overshoots.largest.id,
        track_set.times.text(overshoots.largest.time)));
  }
  return warnings;
}

}  // namespace kinesphere::program
