// Columns in messages and as the option --columns takes them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

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

}  // namespace kinesphere::program
