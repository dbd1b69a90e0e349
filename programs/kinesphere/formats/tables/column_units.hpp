// Units of the numbers in columns, by names, options and what is usual.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Sets the unit of a column; returns false if the measure has none of this name.
bool set_unit(Column& column, std::string_view unit, Quantity quantity);
/// Returns the unit of a column in its name or in the row of units; empty if there is none.
std::string unit_of_column(const TableHead& head, std::size_t place, Quantity quantity);
/// Sets the unit of a column that its name or the row of units says.
void take_unit_of_column(const TableHead& head, Quantity quantity, Column& column);
/// Gives a unit to lengths and speeds without one. Asks where only some have one.
void understand_lengths(const TableHead& head, const ColumnHints& hints, TableColumns& columns);
/// Asks for the unit of heights of aircraft, which are in feet as transponders send them, and of speeds of
/// aircraft and ships, which are in knots.
void ask_for_units_of_craft(const TableHead& head, const TableColumns& columns);

}  // namespace kinesphere::program
