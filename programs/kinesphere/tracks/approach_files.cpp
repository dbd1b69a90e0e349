#include "tracks/approach_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "base/program_error.hpp"
#include "number/infinity.hpp"
#include "simulation/tracks/rectangle_conflicts.hpp"
#include "tracks/sample_steps.hpp"
#include "tracks/track_cells.hpp"
#include "tracks/track_scene.hpp"

namespace kinesphere::program {

double horizontal_distance(const ClosestApproach& closest) {
  const Vec3 way = closest.second - closest.first;
  return std::hypot(way.x, way.y);
}

double vertical_distance(const ClosestApproach& closest) {
  return std::abs(closest.second.z - closest.first.z);
}

namespace {

/// The columns of the table with the positions, which maps have as points.
constexpr std::size_t first_of_positions = 8, behind_positions = 14;

std::vector<std::string> approach_columns(const TrackSet& track_set, const ApproachColumns& chosen) {
  const auto with_unit = [&](std::string_view name, Measure measure = Measure::length) {
    return name_with_unit(name, measure, track_set);
  };
  std::vector<std::string> columns{"begin",
                                   "end",
                                   "first",
                                   "second",
                                   "begins_with_track",
                                   "ends_with_track",
                                   "closest_time",
                                   with_unit("distance"),
                                   "first_x",
                                   "first_y",
                                   "first_z",
                                   "second_x",
                                   "second_y",
                                   "second_z",
                                   with_unit("relative_speed", Measure::speed)};
  if (chosen.by_cylinder)
    columns.insert(columns.end(), {with_unit("horizontal_distance"), with_unit("vertical_distance")});
  columns.insert(columns.end(), {"first_before", "first_after", "second_before", "second_after",
                                 with_unit("samples_apart", Measure::time)});
  if (chosen.has_errors) columns.emplace_back("certain");
  return columns;
}

std::vector<Cell> approach_cells(const Approach& approach, const TrackSet& track_set,
                                 const ApproachColumns& chosen) {
  const ClosestApproach& closest = approach.closest;
  std::vector<Cell> cells{time_cell(track_set.times, approach.begin),
                          time_cell(track_set.times, approach.end),
                          track_set.tracks[approach.first].id,
                          track_set.tracks[approach.second].id,
                          approach.begins_with_track,
                          approach.ends_with_track,
                          time_cell(track_set.times, closest.time),
                          closest.distance};
  add_position(cells, closest.first, track_set);
  add_position(cells, closest.second, track_set);
  cells.emplace_back(closest.relative_speed);
  if (chosen.by_cylinder)
    cells.insert(cells.end(), {horizontal_distance(closest), vertical_distance(closest)});
  const ApproachSteps steps = steps_of(approach, track_set);
  for (const SampleStep& step : {steps.first, steps.second})
    for (const std::optional<double>& time : {step.before, step.after})
      cells.push_back(time ? time_cell(track_set.times, *time) : Cell());
  cells.push_back(steps.longest() ? Cell(*steps.longest()) : Cell());
  if (chosen.has_errors) cells.emplace_back(approach.is_certain);
  return cells;
}

}  // namespace

ApproachFile::ApproachFile(const std::string& path, const ApproachColumns& chosen)
    : chosen_(chosen), map_format_(map_format_of(path)) {
  if (map_format_) {
    map_.emplace(path);
    return;
  }
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".csv" && ending != ".jsonl")
    throw ProgramError(
        fmt::format("{}: expected a name that ends in .csv, .jsonl, .geojson, .gpx or .kml", path));
  table_.emplace(path);
}

void ApproachFile::check(const TrackSet& track_set) const {
  if (!map_) return;
  const Vec3& somewhere = track_set.tracks.front().samples.front().position;
  if (track_set.coordinates.geographic(somewhere)) return;
  throw ProgramError(fmt::format(
      "{}: expected longitudes and latitudes for a {} file (--positions lonlat, or --positions utm with its "
      "zone), but positions are plain coordinates: write .csv or .jsonl",
      map_->path(), std::filesystem::path(map_->path()).extension().string()));
}

void ApproachFile::write(const std::vector<Approach>& approaches, const TrackSet& track_set) {
  const std::vector<std::string> columns = approach_columns(track_set, chosen_);
  if (table_) {
    table_->begin(columns);
    for (const Approach& approach : approaches) table_->write(approach_cells(approach, track_set, chosen_));
    return;
  }
  map_->write(map_begin(*map_format_));
  bool is_first = true;
  for (const Approach& approach : approaches) {
    const std::vector<Cell> cells = approach_cells(approach, track_set, chosen_);
    MapProperties properties;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (k < first_of_positions || k >= behind_positions) properties.emplace_back(columns[k], cells[k]);
    // The ids come first.
    std::rotate(properties.begin(), properties.begin() + 2, properties.begin() + 4);
    map_->write(map_feature(*map_format_, approach, properties, track_set, std::exchange(is_first, false)));
  }
  map_->write(map_end(*map_format_));
}

void ApproachFile::commit() {
  if (table_) table_->commit();
  if (map_) map_->commit();
}

namespace {

/// Adds how near to a collision two rectangles came during an approach.
void add_conflict(PairSummary& pair, const Approach& approach, const Motion& motion,
                  const std::vector<RectangleBody>& shapes) {
  const CollisionCourse course = collision_course(motion, approach, shapes);
  if (course.least.seconds < pair.to_collision.seconds) pair.to_collision = course.least;
  if (course.deceleration > pair.deceleration) {
    pair.deceleration = course.deceleration;
    pair.time_of_deceleration = course.at;
  }
  const PostEncroachment entry = post_encroachment(motion, approach, shapes);
  if (entry.seconds < pair.encroachment.seconds) pair.encroachment = entry;
}

}  // namespace

std::vector<PairSummary> pairs_in(const std::vector<Approach>& approaches, const TrackSet& track_set,
                                  const Motion& motion) {
  const std::vector<double> radii = radii_of(track_set);
  std::vector<RectangleBody> shapes = shapes_of(track_set);
  // Two whose heights are not known come upon each other where they do so seen from above.
  for (RectangleBody& shape : shapes)
    if (shape.height == 0.0) shape.height = infinity;
  std::vector<PairSummary> pairs;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const Approach& approach : approaches) {
    const std::string& first = track_set.tracks[approach.first].id;
    const std::string& second = track_set.tracks[approach.second].id;
    const auto [at, is_new] = known.try_emplace(std::minmax(first, second), pairs.size());
    if (is_new)
      pairs.push_back({.first = first,
                       .second = second,
                       .closest = approach.closest,
                       .to_collision = {approach.closest.time, infinity}});
    PairSummary& pair = pairs[at->second];
    ++pair.approaches;
    pair.duration += approach.end - approach.begin;
    if (track_set.has_rectangles) add_conflict(pair, approach, motion, shapes);
    if (track_set.has_sizes && !track_set.has_rectangles) {
      const LeastTimeToCollision least = least_time_to_collision(motion, approach, radii);
      if (least.seconds < pair.to_collision.seconds) pair.to_collision = least;
      const PostEncroachment entry = post_encroachment(motion, approach, radii);
      if (entry.seconds < pair.encroachment.seconds) pair.encroachment = entry;
    }
    if (approach.closest.distance < pair.closest.distance) pair.closest = approach.closest;
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const PairSummary& a, const PairSummary& b) {
    return a.closest.distance < b.closest.distance;
  });
  return pairs;
}

void write_pairs(TableFile& table, const std::vector<PairSummary>& pairs, const TrackSet& track_set) {
  const auto with_unit = [&](std::string_view name, Measure measure) {
    return name_with_unit(name, measure, track_set);
  };
  std::vector<std::string> columns{"first",
                                   "second",
                                   "approaches",
                                   with_unit("duration", Measure::time),
                                   with_unit("least_distance", Measure::length),
                                   "closest_time"};
  if (track_set.has_sizes)
    columns.insert(columns.end(), {with_unit("least_time_to_collision", Measure::time), "time_of_that",
                                   with_unit("post_encroachment_time", Measure::time), "time_of_entry"});
  if (track_set.has_rectangles)
    columns.insert(columns.end(),
                   {with_unit("deceleration_to_avoid_crash", Measure::acceleration), "time_of_deceleration"});
  table.begin(std::move(columns));
  for (const PairSummary& pair : pairs) {
    std::vector<Cell> cells{
        pair.first,    pair.second,           pair.approaches,
        pair.duration, pair.closest.distance, time_cell(track_set.times, pair.closest.time)};
    const auto add = [&](double seconds, double at) {
      if (seconds < infinity)
        cells.insert(cells.end(), {seconds, time_cell(track_set.times, at)});
      else
        cells.insert(cells.end(), 2, Cell());
    };
    if (track_set.has_sizes) {
      add(pair.to_collision.seconds, pair.to_collision.at);
      add(pair.encroachment.seconds, pair.encroachment.at);
    }
    // None is needed, or none helps any more.
    if (track_set.has_rectangles)
      add(pair.deceleration > 0.0 ? pair.deceleration : infinity, pair.time_of_deceleration);
    table.write(cells);
  }
}

}  // namespace kinesphere::program
