// Values of a recording as cells of a table, in the file's own times and coordinates.
#pragma once

#include <vector>

#include "table_file.hpp"
#include "tracks/recording.hpp"

namespace kinesphere::program {

/// A number where the file has numbers, else a date.
Cell time_cell(const TimeScale& times, double time);
/// Adds x, y and z in the file's coordinates; z is empty if the file has none.
void add_position(std::vector<Cell>& cells, const Vec3& local, const Recording& recording);
/// Adds three components; the third is empty in a plane.
void add_components(std::vector<Cell>& cells, const Vec3& vector, const Recording& recording);

}  // namespace kinesphere::program
