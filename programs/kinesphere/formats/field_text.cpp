// The text of one field: numbers, missing values, its form in messages.
#include "formats/field_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ascii_text.hpp"
#include "number_text.hpp"

namespace kinesphere::program {

std::string_view with_decimal_point(std::string_view text, std::string& buffer) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find_first_not_of("0123456789,+-eE") != std::string_view::npos)
    return text;
  buffer.assign(text);
  buffer[comma] = '.';
  return buffer;
}

std::optional<double> number_field(std::string_view text, bool decimal_comma) {
  if (const auto number = parse_number(text); number || !decimal_comma) return number;
  std::string buffer;
  return parse_number(with_decimal_point(text, buffer));
}

bool is_missing(std::string_view field) {
  constexpr std::string_view names[] = {"",          "nan",  "-nan", "inf",  "-inf", "+inf", "infinity",
                                        "-infinity", "na",   "n/a",  "#n/a", "<na>", "nat",  "null",
                                        "nil",       "none", "\\N",  "-",    "--",   "?"};
  return std::any_of(std::begin(names), std::end(names),
                     [field](std::string_view name) { return same_name(field, name); });
}

std::string shown_field(std::string_view field) {
  if (field.empty()) return "nothing";
  constexpr std::size_t most = 60;
  std::string text(field.substr(0, most));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return fmt::format("'{}{}'", text, field.size() > most ? "..." : "");
}

}  // namespace kinesphere::program
