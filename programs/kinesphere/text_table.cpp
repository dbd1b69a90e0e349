// Tables in text files: whatever separates their columns, with or without a header.
#include "text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "program_error.hpp"

namespace kinesphere::program {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

char separator_of(std::string_view line) {
  for (char separator : {';', ',', '\t'}) {
    if (trimmed(line).find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!(line = trimmed(line)).empty()) {
    words.push_back(line.substr(0, line.find_first_of(blanks)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  if (separator == ' ') return words_of(line);
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

bool is_header(const std::vector<std::string_view>& fields) {
  return std::none_of(fields.begin(), fields.end(),
                      [](std::string_view field) { return parse_number(field); });
}

}  // namespace

std::optional<double> parse_number(std::string_view field) {
  if (field.starts_with('+') && !field.starts_with("+-")) field.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(number))
    return std::nullopt;
  return number;
}

TextTable parse_table(std::string text, const std::string& file) {
  TextTable table;
  table.file = file;
  table.text = std::make_shared<const std::string>(std::move(text));
  std::string_view rest = *table.text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  std::optional<char> separator;
  std::size_t columns = 0;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::string_view content = trimmed(line);
    if (content.empty()) continue;
    if (content.starts_with('#')) {
      table.comments.push_back(trimmed(content.substr(1)));
      continue;
    }
    const bool first = !separator;
    if (first) separator = separator_of(line);
    std::vector<std::string_view> fields = split(line, *separator);
    if (first) columns = fields.size();
    if (fields.size() != columns) {
      throw ProgramError(
          fmt::format("{}:{}: expected {} columns, but got {}", file, line_number, columns, fields.size()));
    }
    if (first && is_header(fields)) {
      table.header = std::move(fields);
    } else {
      table.rows.push_back({line_number, std::move(fields)});
    }
  }
  if (table.rows.empty())
    throw ProgramError(fmt::format("{}: expected rows of numbers, but found none", file));
  if (table.header.empty() && !table.comments.empty()) {
    if (auto words = words_of(table.comments.back()); words.size() == columns)
      table.header = std::move(words);
  }
  return table;
}

}  // namespace kinesphere::program
