// The column of times, and the unit of its numbers.
#pragma once

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Asks about a second column of the time: nanoseconds, as ROS has them, or weeks, as GPS has. Of columns
/// that are given, those of whole seconds without a unit are asked about.
void ask_for_parts_of_time(const TableHead& head, const TableColumns& columns);
/// Derives the unit of times from the time column's name, or from its absence.
void understand_time(const TableHead& head, ColumnUse use, TableColumns& columns);
/// Sets the unit of times that the hints say. Throws ProgramError for hints that contradict each other.
void apply_time_hints(const ColumnHints& hints, TableColumns& columns);

}  // namespace kinesphere::program
