#include "tracks/recording_cells.hpp"

#include <fmt/format.h>

#include <utility>

namespace kinesphere::program {

std::string name_with_unit(std::string_view name, Measure measure, const Recording& recording) {
  const std::string_view unit = measure == Measure::time     ? "_s"
                                : !recording.in_metres       ? ""
                                : measure == Measure::length ? "_m"
                                                             : "_mps";
  return fmt::format("{}{}", name, unit);
}

Cell time_cell(const TimeScale& times, double time) {
  std::string text = times.text(time);
  if (times.is_number()) return DecimalText{std::move(text)};
  return text;
}

void add_position(std::vector<Cell>& cells, const Vec3& local, const Recording& recording) {
  add_components(cells, recording.coordinates.as_in_file(local), recording);
}

void add_components(std::vector<Cell>& cells, const Vec3& vector, const Recording& recording) {
  cells.insert(cells.end(), {vector.x, vector.y});
  cells.push_back(recording.is_plane ? Cell() : Cell(vector.z));
}

}  // namespace kinesphere::program
