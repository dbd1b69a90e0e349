// Values of a track set as cells of a table, in the file's own times and coordinates.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/table_file.hpp"
#include "formats/fields/units.hpp"
#include "tracks/track_set.hpp"

namespace kinesphere::program {

/// Returns the name of a column with the unit of a length, speed, acceleration or duration behind it:
/// distance_m, relative_speed_mps, duration_s. Lengths of unknown unit, and speeds in these, have none.
std::string name_with_unit(std::string_view name, Measure measure, const TrackSet& track_set);
/// A number where the file has numbers, else a date.
Cell time_cell(const TimeScale& times, double time);
/// Returns that cell as JSON.
std::string json_of_time(const TimeScale& times, double time);
/// Adds x, y and z in the file's coordinates; z is empty if the file has none.
void add_position(std::vector<Cell>& cells, const Vec3& local, const TrackSet& track_set);
/// Adds three components; the third is empty in a plane.
void add_components(std::vector<Cell>& cells, const Vec3& vector, const TrackSet& track_set);

}  // namespace kinesphere::program
