// A summary of what was read.
#include "tracks/reading_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace kinesphere::program {
namespace {

/// Share of all rows above which dropped rows cause a warning.
constexpr double large_part = 0.03;

std::string format_text(const Recording& recording) {
  std::string text = fmt::format("{}, {}", recording.format, recording.is_plane ? "2D" : "3D");
  if (recording.frame_rate > 0) text += fmt::format(", {} frames/s", recording.frame_rate);
  if (recording.times.kind() == TimeKind::utc) text += ", dates with a zone";
  if (recording.times.kind() == TimeKind::date) text += ", dates without a zone";
  return text;
}

/// Names the first columns, on one line.
std::string unused_text(const Recording& recording) {
  constexpr std::size_t most = 12;
  const auto& names = recording.unused;
  const std::size_t shown = std::min(most, names.size());
  return fmt::format("columns {}{}",
                     fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "");
}

std::string gap_text(const Recording& recording) {
  const std::string smallest = number(recording.smallest_max_gap);
  const std::string largest = number(recording.largest_max_gap);
  return smallest == largest ? smallest + " s" : fmt::format("{} s to {} s, by id", smallest, largest);
}

std::string first_places(const Tally& tally) {
  return fmt::format("{}{}", fmt::join(tally.first_places, ", "),
                     tally.count > tally.first_places.size() ? ", ..." : "");
}

void add_tally(Summary& summary, const std::string& label, const Tally& tally) {
  if (tally.count > 0) summary.row(label, grouped(tally.count), first_places(tally));
}

}  // namespace

void add_recording(Summary& summary, const std::vector<std::string>& files, const Recording& recording,
                   const TrackScene& scene) {
  summary.row(files.size() == 1 ? "file" : "files", fmt::format("{}", fmt::join(files, ", ")));
  summary.row("format", format_text(recording));
  if (!recording.unused.empty()) summary.row("not used", unused_text(recording));
  if (const std::string projection = recording.coordinates.description(); !projection.empty())
    summary.row("projection", projection);
  summary.row("tracks", grouped(recording.tracks.size()),
              fmt::format("of {} ids, cut at gaps over {}", grouped(recording.ids), gap_text(recording)));
  summary.row(
      "samples", grouped(recording.samples),
      fmt::format("every {} s, of {} rows", number(recording.sample_interval), grouped(recording.rows)));
  if (recording.has_sizes) {
    const auto is_sized = [](const RecordedTrack& track) { return track.radius > 0.0; };
    const auto smaller = [](const RecordedTrack& a, const RecordedTrack& b) { return a.radius < b.radius; };
    const auto& tracks = recording.tracks;
    summary.row("sizes",
                grouped(static_cast<std::uint64_t>(std::count_if(tracks.begin(), tracks.end(), is_sized))),
                fmt::format("of the tracks, the largest of radius {}; the others are points",
                            number(std::max_element(tracks.begin(), tracks.end(), smaller)->radius)));
  }
  if (!recording.filter.empty())
    summary.row("left out", grouped(recording.filtered.count),
                fmt::format("rows for which not: {}", recording.filter));
  add_tally(summary, "missing values", recording.missing);
  add_tally(summary, "malformed", recording.malformed);
  add_tally(summary, "repeated", recording.repeated);
  add_tally(summary, "duplicates", recording.duplicates);
  add_tally(summary, "too fast", recording.too_fast);
  if (recording.left_out > 0) {
    summary.row(
        "alone", grouped(recording.left_out),
        fmt::format("samples between two gaps, left out: {} of the rows",
                    percent(static_cast<double>(recording.left_out), static_cast<double>(recording.rows))));
  }
  const Scene& run = scene.scene;
  summary.row("span", fmt::format("{} s", number(run.end_time - run.world.start_time)),
              fmt::format("from {} to {}", recording.times.text(run.world.start_time),
                          recording.times.text(run.end_time)));
}

std::vector<std::string> warnings_of(const Recording& recording) {
  std::vector<std::string> warnings = recording.warnings;
  const auto add = [&](std::size_t part, std::string_view what) {
    const auto rows = static_cast<double>(recording.rows);
    if (static_cast<double>(part) > large_part * rows)
      warnings.push_back(fmt::format("{} of {} rows ({}) {}", grouped(part), grouped(recording.rows),
                                     percent(static_cast<double>(part), rows), what));
  };
  add(recording.left_out, "were left out, alone between two gaps: a longer --max-gap keeps them");
  add(recording.missing.count, "have no time or no position");
  add(recording.malformed.count, "are malformed");
  add(recording.duplicates.count, "repeat a time of their id");
  add(recording.too_fast.count, "were left out by --max-speed");
  return warnings;
}

std::vector<std::string> warnings_of(const Recording& recording, const TrackScene& scene) {
  std::vector<std::string> warnings = warnings_of(recording);
  const Overshoots& overshoots = scene.overshoots;
  if (overshoots.tracks > 0) {
    warnings.push_back(fmt::format(
        "the splines of {} tracks swing out far beyond their samples, by up to {} (id '{}' after {}): see "
        "--max-speed and --interpolate linear",
        grouped(overshoots.tracks), number(overshoots.largest.size), overshoots.largest.id,
        recording.times.text(overshoots.largest.time)));
  }
  return warnings;
}

}  // namespace kinesphere::program
