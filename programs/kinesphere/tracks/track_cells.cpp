#include "tracks/track_cells.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/escaped_text.hpp"

namespace kinesphere::program {

std::string name_with_unit(std::string_view name, Measure measure, const TrackSet& track_set) {
  const std::string_view unit = measure == Measure::time     ? "_s"
                                : !track_set.in_metres       ? ""
                                : measure == Measure::length ? "_m"
                                : measure == Measure::speed  ? "_mps"
                                                             : "_mps2";
  return fmt::format("{}{}", name, unit);
}

Cell time_cell(const TimeScale& times, double time) {
  std::string text = times.text(time);
  if (times.is_number()) return DecimalText{std::move(text)};
  return text;
}

std::string json_of_time(const TimeScale& times, double time) {
  const std::string text = times.text(time);
  return times.is_number() ? text : json_text(text);
}

void add_position(std::vector<Cell>& cells, const Vec3& local, const TrackSet& track_set) {
  add_components(cells, track_set.coordinates.as_in_file(local), track_set);
}

void add_components(std::vector<Cell>& cells, const Vec3& vector, const TrackSet& track_set) {
  cells.insert(cells.end(), {vector.x, vector.y});
  cells.push_back(track_set.is_plane ? Cell() : Cell(vector.z));
}

}  // namespace kinesphere::program
