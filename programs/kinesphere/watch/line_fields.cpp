// Splits a line into fields.
#include "watch/line_fields.hpp"

#include <algorithm>

namespace kinesphere::program {
namespace {

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

}  // namespace

char field_separator_of(std::string_view line) {
  for (const char separator : {';', ',', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

bool split_fields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t at = 0;
  for (;;) {
    while (at < line.size() && line[at] == ' ') ++at;
    if (separator == ' ' && at == line.size()) return true;
    if (at < line.size() && line[at] == '"') {
      std::size_t end = line.find('"', at + 1);
      // Two quotes in a row are one quote of the text.
      while (end != std::string_view::npos && line.substr(end + 1).starts_with('"'))
        end = line.find('"', end + 2);
      if (end == std::string_view::npos) return false;
      fields.push_back(line.substr(at + 1, end - at - 1));
      at = std::min(line.find(separator, end + 1), line.size());
    } else {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      fields.push_back(without_blanks(line.substr(at, end - at)));
      at = end;
    }
    if (at == line.size()) return true;
    ++at;
  }
}

std::optional<TimeField> time_field(std::string_view text) {
  if (const auto number = parse_decimal_time(text)) return TimeField{*number, TimeKind::number};
  if (const auto date = parse_date_time(text))
    return TimeField{date->time, date->has_offset ? TimeKind::utc : TimeKind::date};
  return std::nullopt;
}

}  // namespace kinesphere::program
