// The steps by which find_columns() understands the columns of a table.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/program_error.hpp"
#include "formats/tables/presets.hpp"
#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Throws ProgramError that names the table: a question about it, or what is wrong with it.
template <class... Values>
[[noreturn]] void refuse(const TableHead& head, fmt::format_string<Values...> text, Values&&... values) {
  throw ProgramError(fmt::format("{}: {}", head.file, fmt::format(text, std::forward<Values>(values)...)));
}

// Columns as the option --columns takes them and messages say them: said_columns.cpp.

/// Returns the only column of that name, or the only one if case is ignored.
std::optional<std::size_t> column_named(const TableHead& head, std::string_view name);
/// Returns a column by its name in the header or its number from 1; nothing if there is none.
std::optional<std::size_t> place_of(const TableHead& head, std::string_view name);
/// Returns "column 'x'", or "column 3" where there is no header.
std::string column_text(const TableHead& head, std::size_t place);
/// Returns the column's name as --columns takes it: its number where a comma would end it, or others have it.
std::string column_word(const TableHead& head, std::size_t place);
/// Returns "id=mmsi,time=t,lon=lon,lat=lat" of the columns found, with a unit behind that of `quantity`, and
/// without the column `without`.
std::string columns_text(const TableHead& head, const TableColumns& columns,
                         std::optional<Quantity> quantity = {}, std::string_view unit = {},
                         std::optional<Quantity> without = {});
/// Returns the option --columns with this list.
std::string columns_option(std::string_view list);

// Units of the numbers in columns, by names, options and what is usual: column_units.cpp.

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

// Columns by their names: usual_columns.cpp.

/// Adds columns that may be meant, for messages: vessel_mmsi, OSD.latitude, field.pose.position.x. Of several
/// that are alike it adds none.
void add_likely_columns(const TableHead& head, TableColumns& columns);
/// Returns the option --columns with these columns and those that are likely, and with id=..., time=... and
/// x=...,y=... for what is none of them.
std::string whole_columns_option(const TableHead& head, TableColumns columns);

/// Returns the columns of entries KEY=COLUMN[:UNIT], those of --columns or of a preset. Throws ProgramError.
TableColumns said_columns(const TableHead& head, std::string_view list, const Preset* preset);
/// Returns the columns of a preset. Throws ProgramError for a table without them.
TableColumns preset_columns(const TableHead& head, const Preset& preset);

/// True for what is read with these hints.
bool is_used(Quantity quantity, const ColumnHints& hints, ColumnUse use);
/// Returns the columns with usual names. Throws ProgramError where two may be meant.
TableColumns usual_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use);

/// Finds a pair of columns for each body: x1, y1, x2, y2, as idtracker.ai writes them, or lon1, lat1 and so
/// on; or three, with z or alt.
void find_pairs(const TableHead& head, const ColumnHints& hints, TableColumns& columns);

/// Finds the nanoseconds beside whole seconds, as ROS has them, and asks about other parts of the time, such
/// as minutes, or weeks, as GPS has. Of columns that are given, those of whole seconds without a unit count.
void find_parts_of_time(const TableHead& head, TableColumns& columns);
/// Derives the unit of times from the time column's name, or from its absence.
void understand_time(const TableHead& head, ColumnUse use, TableColumns& columns);
/// Sets the unit of times that the hints say. Throws ProgramError for hints that contradict each other.
void apply_time_hints(const ColumnHints& hints, TableColumns& columns);

}  // namespace kinesphere::program
