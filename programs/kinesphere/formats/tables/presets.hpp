// Formats of known tools, as tables of names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// What a preset knows besides the names of columns.
struct PresetRules {
  double frame_rate = 0.0;  ///< frames per second; 0: unknown, or no frames
  DateOrder dates = DateOrder::unknown;
  std::string_view where{};  ///< rows that count
  TableColumns::Film film = TableColumns::Film::none;
  std::size_t least_columns = 0;  ///< of a table without a header
  bool has_own_heights = false;   ///< its heights are those of the bodies themselves, not of their places
  bool has_own_origin = false;    ///< times or places count from the start of each body
  TableColumns::Place place = TableColumns::Place::middle;
};

struct Preset {
  std::string_view name;   ///< of --format
  std::string_view title;  ///< in the summary
  /// Columns as --columns has them. `a|b` is the first that the table has, `key?=a` may be absent, `a*`
  /// begins with a, and `id=@file` is the name of the file, which has one body. Courses are clockwise from
  /// north, headings counterclockwise from the x axis.
  std::string_view columns;
  /// Names that the header must have to be recognised, separated by commas, as in `columns`; empty: the
  /// header does not tell.
  std::string_view header{};
  PresetRules rules{};
};

/// Returns the preset of --format; null for another name.
const Preset* preset_named(std::string_view name);
/// Returns the preset whose header the table has, or without a header one that its first row shows beyond
/// doubt; null if there is none.
const Preset* recognised_preset(const TableHead& head);
/// Returns the column of a preset's name; nothing if there is none.
std::optional<std::size_t> preset_column(const TableHead& head, std::string_view name);
/// Returns the names of all, and table, separated by |.
std::string preset_names();

}  // namespace kinesphere::program
