// Columns that are said: by --columns, or by a preset.
#pragma once

#include <string_view>

#include "formats/tables/presets.hpp"
#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Returns the columns of entries KEY=COLUMN[:UNIT], those of --columns or of a preset. Throws ProgramError.
TableColumns said_columns(const TableHead& head, std::string_view list, const Preset* preset);
/// Returns the columns of a preset. Throws ProgramError for a table without them.
TableColumns preset_columns(const TableHead& head, const Preset& preset);

}  // namespace kinesphere::program
