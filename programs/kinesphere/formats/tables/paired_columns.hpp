// Tables in which each body has columns of its own.
#pragma once

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Finds a pair of columns for each body: x1, y1, x2, y2, as idtracker.ai writes them, or lon1, lat1 and so
/// on; or three, with z or alt.
void find_pairs(const TableHead& head, const ColumnHints& hints, TableColumns& columns);

}  // namespace kinesphere::program
