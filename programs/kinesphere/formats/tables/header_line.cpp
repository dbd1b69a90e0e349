// Finds the header of a table below other lines.
#include "formats/tables/header_line.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/ascii_text.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/row_splitter.hpp"

namespace kinesphere::program {
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
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
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
