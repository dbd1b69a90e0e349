// Columns by their usual names.
#pragma once

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// True for what is read with these hints.
bool is_used(Quantity quantity, const ColumnHints& hints, ColumnUse use);
/// Returns the columns with usual names. Throws ProgramError where two may be meant.
TableColumns usual_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use);

}  // namespace kinesphere::program
