#include "tracks/approach_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "number/infinity.hpp"
#include "program_error.hpp"
#include "tracks/recording_cells.hpp"
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

std::vector<std::string> approach_columns(bool by_cylinder) {
  std::vector<std::string> columns{
      "begin",           "end",          "first",    "second",   "begins_with_track",
      "ends_with_track", "closest_time", "distance", "first_x",  "first_y",
      "first_z",         "second_x",     "second_y", "second_z", "relative_speed"};
  if (by_cylinder) columns.insert(columns.end(), {"horizontal_distance", "vertical_distance"});
  return columns;
}

/// Returns the values of an approach besides the positions, in the order of maps.
MapProperties map_properties(const Approach& approach, const Recording& recording, bool by_cylinder) {
  const ClosestApproach& closest = approach.closest;
  MapProperties properties{{"first", recording.tracks[approach.first].id},
                           {"second", recording.tracks[approach.second].id},
                           {"begin", time_cell(recording.times, approach.begin)},
                           {"end", time_cell(recording.times, approach.end)},
                           {"begins_with_track", approach.begins_with_track},
                           {"ends_with_track", approach.ends_with_track},
                           {"closest_time", time_cell(recording.times, closest.time)},
                           {"distance", closest.distance},
                           {"relative_speed", closest.relative_speed}};
  if (by_cylinder) {
    properties.emplace_back("horizontal_distance", horizontal_distance(closest));
    properties.emplace_back("vertical_distance", vertical_distance(closest));
  }
  return properties;
}

}  // namespace

ApproachFile::ApproachFile(const std::string& path, bool by_cylinder)
    : by_cylinder_(by_cylinder), map_format_(map_format_of(path)) {
  if (map_format_) {
    map_.emplace(path);
    return;
  }
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".csv" && ending != ".jsonl")
    throw ProgramError(
        fmt::format("{}: expected a name that ends in .csv, .jsonl, .geojson, .gpx or .kml", path));
  table_.emplace(path, approach_columns(by_cylinder));
}

void ApproachFile::check(const Recording& recording) const {
  if (!map_) return;
  const Vec3& somewhere = recording.tracks.front().samples.front().position;
  if (recording.coordinates.geographic(somewhere)) return;
  throw ProgramError(fmt::format(
      "{}: expected longitudes and latitudes for a {} file (--positions lonlat, or --positions utm with its "
      "zone), but positions are plain coordinates: write .csv or .jsonl",
      map_->path(), std::filesystem::path(map_->path()).extension().string()));
}

void ApproachFile::write(const std::vector<Approach>& approaches, const Recording& recording) {
  if (map_) return write_map(approaches, recording);
  for (const Approach& approach : approaches) {
    const ClosestApproach& closest = approach.closest;
    std::vector<Cell> cells{time_cell(recording.times, approach.begin),
                            time_cell(recording.times, approach.end),
                            recording.tracks[approach.first].id,
                            recording.tracks[approach.second].id,
                            approach.begins_with_track,
                            approach.ends_with_track,
                            time_cell(recording.times, closest.time),
                            closest.distance};
    add_position(cells, closest.first, recording);
    add_position(cells, closest.second, recording);
    cells.emplace_back(closest.relative_speed);
    if (by_cylinder_) cells.insert(cells.end(), {horizontal_distance(closest), vertical_distance(closest)});
    table_->write(cells);
  }
}

void ApproachFile::write_map(const std::vector<Approach>& approaches, const Recording& recording) {
  map_->write(map_begin(*map_format_));
  bool is_first = true;
  for (const Approach& approach : approaches) {
    map_->write(map_feature(*map_format_, approach, map_properties(approach, recording, by_cylinder_),
                            recording, is_first));
    is_first = false;
  }
  map_->write(map_end(*map_format_));
}

void ApproachFile::commit() {
  if (table_) table_->commit();
  if (map_) map_->commit();
}

std::vector<PairSummary> pairs_in(const std::vector<Approach>& approaches, const Recording& recording,
                                  const Motion& motion) {
  const std::vector<double> radii = radii_of(recording);
  std::vector<PairSummary> pairs;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const Approach& approach : approaches) {
    const std::string& first = recording.tracks[approach.first].id;
    const std::string& second = recording.tracks[approach.second].id;
    const auto [at, is_new] = known.try_emplace(std::minmax(first, second), pairs.size());
    if (is_new)
      pairs.push_back({.first = first,
                       .second = second,
                       .closest = approach.closest,
                       .to_collision = {approach.closest.time, infinity}});
    PairSummary& pair = pairs[at->second];
    ++pair.approaches;
    pair.duration += approach.end - approach.begin;
    if (recording.has_sizes) {
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

std::vector<std::string> pair_columns(bool with_sizes) {
  std::vector<std::string> columns{"first",    "second",         "approaches",
                                   "duration", "least_distance", "closest_time"};
  if (with_sizes)
    columns.insert(columns.end(),
                   {"least_time_to_collision", "time_of_that", "post_encroachment_time", "time_of_entry"});
  return columns;
}

void write_pairs(TableFile& table, const std::vector<PairSummary>& pairs, const Recording& recording) {
  for (const PairSummary& pair : pairs) {
    std::vector<Cell> cells{
        pair.first,    pair.second,           pair.approaches,
        pair.duration, pair.closest.distance, time_cell(recording.times, pair.closest.time)};
    const auto add = [&](double seconds, double at) {
      if (seconds < infinity)
        cells.insert(cells.end(), {seconds, time_cell(recording.times, at)});
      else
        cells.insert(cells.end(), 2, Cell());
    };
    if (recording.has_sizes) {
      add(pair.to_collision.seconds, pair.to_collision.at);
      add(pair.encroachment.seconds, pair.encroachment.at);
    }
    table.write(cells);
  }
}

}  // namespace kinesphere::program
