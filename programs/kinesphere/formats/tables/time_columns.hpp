// The column of times, and the unit of its numbers.
#pragma once

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Finds the nanoseconds beside whole seconds, as ROS has them, and asks about other parts of the time, such
/// as minutes, or weeks, as GPS has. Of columns that are given, those of whole seconds without a unit count.
void find_parts_of_time(const TableHead& head, TableColumns& columns);
/// Derives the unit of times from the time column's name, or from its absence.
void understand_time(const TableHead& head, ColumnUse use, TableColumns& columns);
/// Sets the unit of times that the hints say. Throws ProgramError for hints that contradict each other.
void apply_time_hints(const ColumnHints& hints, TableColumns& columns);

}  // namespace kinesphere::program
