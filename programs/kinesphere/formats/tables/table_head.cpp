// What stands before the rows of a table: comments, names of columns, their units.
#include "formats/tables/table_head.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/fields/time_text.hpp"
#include "formats/fields/units.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/row_splitter.hpp"

namespace kinesphere::program {
namespace {

/// Returns the parts of a comment; `separator` is that of the table.
std::vector<std::string> parts_of(std::string_view line, char separator) {
  std::vector<std::string> parts;
  const std::string_view between = separator == ' ' ? blanks : std::string_view(&separator, 1);
  while (!line.empty()) {
    const std::string_view part = line.substr(0, line.find_first_of(between));
    line.remove_prefix(std::min(part.size() + 1, line.size()));
    if (separator != ' ' || !part.empty()) parts.emplace_back(trimmed(part));
  }
  return parts;
}

}  // namespace

std::string TableHead::text() const {
  if (names.empty()) return fmt::format("no header and {} columns", columns());
  return fmt::format("the columns {}", fmt::join(names, ", "));
}

void TableHeadReader::comment(std::string_view line) { head_.comments.emplace_back(trimmed(line)); }

bool TableHeadReader::row(const std::vector<std::string_view>& fields) {
  is_complete_ = is_complete_ || completes_head(fields);
  return is_complete_ && !std::equal(fields.begin(), fields.end(), head_.names.begin(), head_.names.end());
}

bool TableHeadReader::completes_head(const std::vector<std::string_view>& fields) {
  const bool decimal_comma = has_decimal_commas(head_.separator);
  const bool has_number = std::any_of(fields.begin(), fields.end(), [&](std::string_view field) {
    return number_field(field, decimal_comma).has_value();
  });
  if (!has_number && head_.names.empty()) {
    head_.names.assign(fields.begin(), fields.end());
    for (std::string& name : head_.names)
      if (name.size() > 2 && name.front() == '\'' && name.back() == '\'')
        name = name.substr(1, name.size() - 2);
    // Messages contain the names, and are one line.
    for (std::string& name : head_.names)
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '\r' || c == '\n'; }, ' ');
    return false;
  }
  // Messages without numbers of their own, as of APRS, may share a word with the first of them.
  constexpr int most_below = 8;
  if (!has_number && rows_below_ < most_below && is_below_header(fields)) {
    ++rows_below_;
    if (std::any_of(fields.begin(), fields.end(), is_unit)) head_.units.assign(fields.begin(), fields.end());
    return false;
  }
  head_.first.assign(fields.begin(), fields.end());
  if (!head_.names.empty() || head_.comments.empty()) return true;
  for (char separator : {head_.separator, ' '}) {
    std::vector<std::string> parts = parts_of(head_.comments.back(), separator);
    if (parts.size() != fields.size()) continue;
    head_.names = std::move(parts);
    break;
  }
  return true;
}

bool TableHeadReader::is_below_header(const std::vector<std::string_view>& fields) const {
  if (fields.size() != head_.names.size()) return false;
  const auto is_value = [](std::string_view field) {
    return parse_date_time(field, DateOrder::any) || (!field.empty() && field != "-" && is_missing(field));
  };
  if (std::any_of(fields.begin(), fields.end(), is_value)) return false;
  for (std::size_t column = 0; column < fields.size(); ++column)
    if (is_unit(fields[column]) ||
        (!fields[column].empty() && same_name(fields[column], head_.names[column])))
      return true;
  return false;
}

namespace {

/// Returns the fields of a line; none for a line whose quotes are wrong.
std::vector<std::string> fields_of_line(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  RowSplitter row;
  row.set_separator(separator);
  row.begin(line);
  try {
    row.read(fields);
  } catch (const WrongInput&) {
    return {};
  }
  return {fields.begin(), fields.end()};
}

bool are_names_of_columns(const std::vector<std::string>& fields) {
  bool has_time = false;
  int coordinates = 0;
  for (const std::string& field : fields) {
    const auto meaning = meaning_of(field);
    if (!meaning) continue;
    const Quantity quantity = meaning->quantity;
    has_time = has_time || quantity == Quantity::time || quantity == Quantity::frame;
    const bool is_coordinate = quantity == Quantity::x || quantity == Quantity::y ||
                               quantity == Quantity::longitude || quantity == Quantity::latitude;
    coordinates += is_coordinate ? 1 : 0;
  }
  return has_time && coordinates == 2;
}

}  // namespace

std::optional<std::size_t> line_of_later_header(std::string_view text) {
  constexpr std::size_t most_lines = 200;
  for (std::size_t number = 1; number <= most_lines && !text.empty(); ++number) {
    const std::string_view line = take_part(text, '\n');
    const char separator = separator_of(line);
    const auto fields = fields_of_line(line, separator);
    if (!are_names_of_columns(fields)) continue;
    const auto next = fields_of_line(text.substr(0, text.find('\n')), separator);
    if (number == 1) return std::nullopt;
    if (next.size() == fields.size()) return number;
  }
  return std::nullopt;
}

}  // namespace kinesphere::program
