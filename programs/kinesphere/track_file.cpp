// Recorded motion from text files: who was where at which times.
#include "track_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "input_file.hpp"
#include "program_error.hpp"
#include "text_table.hpp"

namespace kinesphere::program {
namespace {

struct Sample {
  int line;
  TrackSample sample;
};

/// All samples of one id.
struct Group {
  std::string id;
  std::vector<Sample> samples;
};

double number_in(const TextTable& table, const TextTable::Row& row, std::size_t column,
                 std::string_view what) {
  const std::string_view field = row.fields[column];
  if (const auto number = parse_number(field)) return *number;
  throw ProgramError(fmt::format("{}:{}: expected a number as {} (column {}), but got '{}'", table.file,
                                 row.line, what, column + 1, field));
}

std::string id_in(const TextTable& table, const TextTable::Row& row, std::size_t column) {
  const std::string_view field = row.fields[column];
  if (field.empty()) {
    throw ProgramError(
        fmt::format("{}:{}: expected an id (column {}), but got nothing", table.file, row.line, column + 1));
  }
  const auto number = field.find('.') != std::string_view::npos ? parse_number(field) : std::nullopt;
  const bool whole = number && std::floor(*number) == *number && std::abs(*number) < 1e15;
  return whole ? fmt::format("{}", static_cast<long long>(*number)) : std::string(field);
}

std::vector<Group> group_by_id(const TextTable& table, const TrackColumns& columns) {
  std::vector<Group> groups;
  std::unordered_map<std::string, std::size_t> group_of;
  for (const TextTable::Row& row : table.rows) {
    const std::string id = id_in(table, row, columns.id);
    const double time = number_in(table, row, columns.time, "time") / columns.frame_rate;
    const Vec3 position{number_in(table, row, columns.x, "x"), number_in(table, row, columns.y, "y"),
                        columns.z ? number_in(table, row, *columns.z, "z") : 0.0};
    const auto [place, is_new] = group_of.emplace(id, groups.size());
    if (is_new) groups.push_back({id, {}});
    groups[place->second].samples.push_back({row.line, {time, position}});
  }
  return groups;
}

void sort_by_time(Group& group, const std::string& file) {
  const auto earlier = [](const Sample& a, const Sample& b) { return a.sample.time < b.sample.time; };
  std::stable_sort(group.samples.begin(), group.samples.end(), earlier);
  for (std::size_t k = 1; k < group.samples.size(); ++k) {
    const Sample& before = group.samples[k - 1];
    const Sample& after = group.samples[k];
    if (before.sample.time < after.sample.time) continue;
    throw ProgramError(
        fmt::format("{}:{}: expected one sample of id '{}' at time {}, but line {} has one too", file,
                    after.line, group.id, after.sample.time, before.line));
  }
}

/// Zero when no id has two samples.
double median_interval(const std::vector<Group>& groups) {
  std::vector<double> intervals;
  for (const Group& group : groups) {
    for (std::size_t k = 1; k < group.samples.size(); ++k) {
      intervals.push_back(group.samples[k].sample.time - group.samples[k - 1].sample.time);
    }
  }
  if (intervals.empty()) return 0.0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

/// Cuts the group's samples wherever the gap is too long.
void add_tracks(const Group& group, Recording& recording) {
  std::vector<TrackSample> track;
  for (std::size_t k = 0; k < group.samples.size(); ++k) {
    track.push_back(group.samples[k].sample);
    const bool last = k + 1 == group.samples.size();
    if (!last && group.samples[k + 1].sample.time - track.back().time <= recording.max_gap) continue;
    if (track.size() == 1) {
      ++recording.left_out;
    } else {
      recording.samples += track.size();
      recording.tracks.push_back({group.id, std::move(track)});
    }
    track.clear();
  }
}

}  // namespace

Recording parse_tracks(std::string text, const std::string& file, const TrackOptions& options) {
  const TextTable table = parse_table(std::move(text), file);
  Recording recording;
  recording.columns = find_columns(table, options.hints);
  std::vector<Group> groups = group_by_id(table, recording.columns);
  for (Group& group : groups) sort_by_time(group, file);
  recording.ids = groups.size();
  recording.sample_interval = median_interval(groups);
  recording.max_gap = options.max_gap.value_or(2.5 * recording.sample_interval);
  if (!(recording.max_gap >= 0)) {
    throw ProgramError(fmt::format("--max-gap: expected a number >= 0, but got {}", recording.max_gap));
  }
  for (const Group& group : groups) add_tracks(group, recording);
  if (recording.tracks.empty()) {
    throw ProgramError(fmt::format("{}: expected an id with two samples at most {} apart, but there is none",
                                   file, recording.max_gap));
  }
  return recording;
}

Recording read_tracks(const std::string& file, const TrackOptions& options) {
  return parse_tracks(read_input(file), file, options);
}

}  // namespace kinesphere::program
