// Columns in messages and as the option --columns takes them.
#include "formats/tables/column_steps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {

std::optional<std::size_t> column_named(const TableHead& head, std::string_view name) {
  const auto& names = head.names;
  for (const bool exact : {true, false}) {
    const auto matches = [&](const std::string& each) {
      return exact ? each == name : same_name(each, name);
    };
    const auto found = std::find_if(names.begin(), names.end(), matches);
    if (found == names.end()) continue;
    if (std::count_if(names.begin(), names.end(), matches) > 1)
      throw ProgramError(
          fmt::format("{}: expected one column '{}', but it has {}", head.file, name, head.text()));
    return static_cast<std::size_t>(found - names.begin());
  }
  return std::nullopt;
}

std::optional<std::size_t> place_of(const TableHead& head, std::string_view name) {
  if (const auto place = column_named(head, name)) return place;
  const double number = parse_number(name).value_or(0.0);
  for (std::size_t place = 0; place < head.columns(); ++place)
    if (number == static_cast<double>(place + 1)) return place;
  return std::nullopt;
}

std::string column_text(const TableHead& head, std::size_t place) {
  return head.names.empty() ? fmt::format("column {}", place + 1)
                            : fmt::format("column '{}'", head.names[place]);
}

std::string column_word(const TableHead& head, std::size_t place) {
  const bool by_name = !head.names.empty() && head.names[place].find_first_of(",\"'") == std::string::npos &&
                       std::count(head.names.begin(), head.names.end(), head.names[place]) == 1;
  return by_name ? head.names[place] : fmt::format("{}", place + 1);
}

std::string columns_text(const TableHead& head, const TableColumns& columns, std::optional<Quantity> quantity,
                         std::string_view unit, std::optional<Quantity> without) {
  std::string text = columns.id_is_file ? "id=@file" : "";
  for (std::size_t k = 0; k < quantity_count; ++k) {
    const auto each = static_cast<Quantity>(k);
    if (!columns.of[k] || each == without) continue;
    const std::string said = columns.of[k]->said_unit.empty() ? "" : ":" + columns.of[k]->said_unit;
    text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", key_of(each),
                        column_word(head, columns.of[k]->place), each == quantity ? unit : said);
  }
  return text;
}

std::string columns_option(std::string_view list) { return "--columns " + shell_word(list); }

}  // namespace kinesphere::program
