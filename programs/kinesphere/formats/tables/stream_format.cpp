// Recognises the format of a stream by its beginning.
#include "formats/tables/stream_format.hpp"

#include <algorithm>
#include <iterator>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/tables/column_names.hpp"

namespace kinesphere::program {
namespace {

/// Returns true if the outermost object that begins with `line` has this key.
bool has_key(std::string_view line, std::string_view key) {
  int depth = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (c != '"') continue;
    const std::size_t begin = at + 1;
    for (at = begin; at < line.size() && line[at] != '"'; ++at)
      if (line[at] == '\\') ++at;
    if (at >= line.size()) return false;
    if (depth == 1 && line.substr(begin, at - begin) == key) {
      const std::size_t next = line.find_first_not_of(" \t", at + 1);
      if (next != std::string_view::npos && line[next] == ':') return true;
    }
  }
  return false;
}

/// True for the two dates and clocks of a message of BaseStation, with which a stream may begin if it is
/// joined in the middle of a line.
bool has_times_of_sbs(std::string_view line) {
  constexpr std::string_view form = ",0000/00/00,00:00:00.000,0000/00/00,00:00:00.000,";
  const auto fits = [&](std::string_view part) {
    return std::ranges::equal(part, form,
                              [](char c, char of) { return of == '0' ? c >= '0' && c <= '9' : c == of; });
  };
  for (std::size_t at = 0; at + form.size() <= line.size(); ++at)
    if (fits(line.substr(at, form.size()))) return true;
  return false;
}

/// True for a message of BaseStation. The third field is the number of a session, which no header has.
bool is_sbs(std::string_view line) {
  if (line.starts_with("MSG,") || has_times_of_sbs(line)) return true;
  constexpr std::string_view types[] = {"SEL,", "ID,", "AIR,", "STA,", "CLK,"};
  if (std::none_of(std::begin(types), std::end(types), [line](auto type) { return line.starts_with(type); }))
    return false;
  for (int field = 0; field < 2; ++field) line.remove_prefix(std::min(line.find(',') + 1, line.size()));
  return line.empty() || parse_number(line.substr(0, line.find(','))) || line.starts_with(',');
}

/// True for state vectors of OpenSky. `line` is the first line of `text`; a document over several lines may
/// have its time alone in it.
bool is_opensky(std::string_view line, std::string_view text) {
  if (has_key(line, "states")) return true;
  if (!has_key(line, "time")) return false;
  return text.find("\"states\"") != std::string_view::npos ||
         (text.size() <= line.size() + 2 && trimmed(line).ends_with(','));
}

/// True for a header with the number of a ship, a longitude and a latitude.
bool is_table_of_ships(std::string_view header) {
  bool has_number = false, has_longitude = false, has_latitude = false;
  while (!header.empty()) {
    std::string_view field = trimmed(header.substr(0, header.find_first_of(",;\t|")));
    header.remove_prefix(std::min(header.find_first_of(",;\t|"), header.size() - 1) + 1);
    if (field.size() >= 2 && field.starts_with('"')) field = field.substr(1, field.size() - 2);
    const auto meaning = meaning_of(field);
    has_number = has_number || plain_name(field).ends_with("mmsi");
    has_longitude = has_longitude || (meaning && meaning->quantity == Quantity::longitude);
    has_latitude = has_latitude || (meaning && meaning->quantity == Quantity::latitude);
  }
  return has_number && has_longitude && has_latitude;
}

/// True for the names of an id, a time and two coordinates between blanks.
bool has_blank_separated_names(std::string_view line) {
  bool has_id = false, has_time = false;
  int coordinates = 0;
  for (const std::string_view name : words_of(line)) {
    const auto meaning = meaning_of(name);
    if (!meaning) continue;
    const Measure measure = measure_of(meaning->quantity);
    has_id = has_id || meaning->quantity == Quantity::id;
    has_time = has_time || meaning->quantity == Quantity::time || meaning->quantity == Quantity::frame;
    coordinates += measure == Measure::length || measure == Measure::angle ? 1 : 0;
  }
  return has_id && has_time && coordinates >= 2;
}

}  // namespace

std::string_view first_line(std::string_view beginning) {
  for (;;) {
    beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
    const std::string_view line = beginning.substr(0, beginning.find('\n'));
    // A comment with separators may be the header of a table.
    const bool is_comment = line.starts_with('#') || line.starts_with('%') || line.starts_with("//");
    if (!is_comment || line.size() == beginning.size() ||
        line.find_first_of(",;\t|") != std::string_view::npos)
      break;
    beginning.remove_prefix(line.size());
  }
  std::size_t begin = 0;
  if (beginning.starts_with('{')) begin = beginning.find('"');
  const std::size_t end = begin < beginning.size() ? beginning.find('\n', begin) : std::string_view::npos;
  return end == std::string_view::npos ? std::string_view() : beginning.substr(0, end);
}

std::optional<StreamFormat> recognised_format(std::string_view beginning) {
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  std::string_view line = first_line(beginning);
  if (line.empty()) line = beginning.substr(first);
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (!line.starts_with('{') && (looks_like_nmea(line) || has_ais_sentence(beginning.substr(0, 4096))))
    return StreamFormat::nmea;
  if (is_sbs(line)) return StreamFormat::sbs;
  if (line.starts_with('{')) {
    if (has_key(line, "aircraft") || has_key(line, "ac") || has_key(line, "now")) return StreamFormat::readsb;
    if (is_opensky(line, beginning.substr(static_cast<std::size_t>(line.data() - beginning.data()))))
      return StreamFormat::opensky;
    if (has_key(line, "stamp")) return StreamFormat::jsonl;
    return std::nullopt;
  }
  if (is_table_of_ships(line)) return StreamFormat::ais;
  if (has_blank_separated_names(line)) return StreamFormat::csv;
  // A header consists of names.
  const bool has_letters =
      std::any_of(line.begin(), line.end(), [](char c) { return ('a' <= (c | 32) && (c | 32) <= 'z'); });
  if (has_letters && line.find_first_of(",;\t|") != std::string_view::npos && !line.starts_with('!') &&
      !line.starts_with('[') && !line.starts_with('$') && !line.starts_with('\\'))
    return StreamFormat::csv;
  return std::nullopt;
}

}  // namespace kinesphere::program
