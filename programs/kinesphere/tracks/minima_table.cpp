// A table of all local minima of distance.
#include "tracks/minima_table.hpp"

#include <fmt/format.h>

#include <initializer_list>

#include "tracks/own_frame.hpp"
#include "tracks/track_cells.hpp"

namespace kinesphere::program {
namespace {

/// Adds a vector's components in the frame of a body; those that the frame does not have are empty.
void add_in_frame(std::vector<Cell>& cells, const Vec3& vector, const std::optional<OwnFrame>& frame,
                  bool is_plane) {
  const auto component = [&](const std::optional<Vec3>& axis) {
    return axis ? Cell(dot(vector, *axis)) : Cell();
  };
  if (!frame) {
    cells.insert(cells.end(), 3, Cell());
    return;
  }
  cells.push_back(component(frame->along));
  cells.push_back(component(frame->right));
  cells.push_back(is_plane ? Cell() : component(frame->up));
}

std::vector<Cell> minimum_row(const DistanceMinimum& minimum, const Approach& approach,
                              const TrackSet& track_set) {
  const ClosestApproach& closest = minimum.closest;
  std::vector<Cell> cells{std::uint64_t{minimum.approach + 1},
                          time_cell(track_set.times, closest.time),
                          track_set.tracks[approach.first].id,
                          track_set.tracks[approach.second].id,
                          closest.distance,
                          closest.relative_speed,
                          minimum.is_cut_off};
  add_position(cells, closest.first, track_set);
  add_position(cells, closest.second, track_set);
  const Vec3 way = closest.second - closest.first;
  const Vec3 velocity = minimum.second_velocity - minimum.first_velocity;
  const LocalAxes axes = track_set.coordinates.axes_at(closest.first);
  add_components(cells, axes.components(way), track_set);
  add_components(cells, axes.components(velocity), track_set);
  const auto add_view = [&](const Vec3& own_velocity, const Vec3& place, double sign) {
    const Vec3 vertical = track_set.coordinates.axes_at(place).z;
    const auto frame = own_frame(own_velocity, vertical, closest.relative_speed);
    add_in_frame(cells, sign * way, frame, track_set.is_plane);
    add_in_frame(cells, sign * velocity, frame, track_set.is_plane);
  };
  add_view(minimum.first_velocity, closest.first, 1.0);
  add_view(minimum.second_velocity, closest.second, -1.0);
  return cells;
}

std::vector<std::string> minima_columns(const TrackSet& track_set) {
  const std::string distance = name_with_unit("distance", Measure::length, track_set);
  const std::string speed = name_with_unit("relative_speed", Measure::speed, track_set);
  std::vector<std::string> columns{"approach", "time", "first", "second", distance, speed, "cut_off"};
  const auto add = [&](std::string_view prefix, std::initializer_list<std::string_view> names,
                       Measure measure = Measure::none) {
    for (const std::string_view name : names) {
      const std::string whole = fmt::format("{}{}", prefix, name);
      columns.push_back(measure == Measure::none ? whole : name_with_unit(whole, measure, track_set));
    }
  };
  add("first_", {"x", "y", "z"});
  add("second_", {"x", "y", "z"});
  add("relative_", {"x", "y", "z"}, Measure::length);
  add("relative_", {"vx", "vy", "vz"}, Measure::speed);
  for (const std::string_view prefix : {"from_first_", "from_second_"}) {
    add(prefix, {"along", "right", "up"}, Measure::length);
    add(prefix, {"v_along", "v_right", "v_up"}, Measure::speed);
  }
  return columns;
}

}  // namespace

void write_minima(TableFile& table, const std::vector<DistanceMinimum>& minima,
                  const std::vector<Approach>& approaches, const TrackSet& track_set) {
  table.begin(minima_columns(track_set));
  for (const DistanceMinimum& minimum : minima)
    table.write(minimum_row(minimum, approaches[minimum.approach], track_set));
}

}  // namespace kinesphere::program
