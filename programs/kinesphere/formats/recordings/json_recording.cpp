// JSON that is a table: records, as pandas and jq write them, and traces of tar1090.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/file_kind.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/json_rows.hpp"

namespace kinesphere::program {
namespace {

/// Returns the rows. Throws ProgramError for records whose positions are in a list of each.
RowTable table_with_positions(JsonRows rows, const std::string& file, bool is_list) {
  const auto& names = rows.table.names();
  const bool has_position = std::ranges::any_of(names, [](const std::string& name) {
    const auto meaning = meaning_of_ending(name);
    return meaning && (meaning->quantity == Quantity::x || meaning->quantity == Quantity::longitude);
  });
  const std::string& list = rows.long_list();
  if (!list.empty() && !has_position && rows.has_several_lists())
    throw ProgramError(fmt::format(
        "{}: expected records with a position each, but they are in several lists, such as '{}': if each is "
        "of one body, say jq -c 'to_entries[] | {{id: .key}} + .value[]' FILE | kinesphere tracks -",
        file, list));
  if (!list.empty() && !has_position)
    throw ProgramError(
        fmt::format("{0}: expected records with a position each, but they are in a list '{1}': say jq -c "
                    "'{2}. + .{1}[] | del(.{1})' FILE | kinesphere tracks -",
                    file, list, is_list ? ".[] | " : ""));
  return std::move(rows.table);
}

/// [{...}, {...}]
RowTable table_of_list(const RecordingText& recording) {
  JsonDocumentReader reader;
  JsonRows rows;
  std::size_t line = 1;
  read_json(recording.file, line, [&] {
    ondemand::document document = reader.open(recording.text);
    JsonLine place(document);
    for (ondemand::value value : document.get_array()) {
      line = place.now();
      rows.add(value.get_object(), line);
    }
    require_end(document, "one list of JSON records");
  });
  return table_with_positions(std::move(rows), recording.file, true);
}

/// Returns a field of a table for a number, or nothing.
std::string number_field_of(ondemand::value value) {
  return value.type() == ondemand::json_type::number ? std::string(token_of(value)) : "";
}

/// trace: [[seconds since timestamp, latitude, longitude, barometric altitude in ft or "ground", speed,
/// course, flags, climb, details, source, geometric altitude, ...], ...]
RowTable trace_table(ondemand::document& document, bool geometric) {
  enum at {
    seconds,
    latitude,
    longitude,
    barometric_height,
    speed,
    course,
    climb = 7,
    geometric_height = 10,
    fields_read
  };
  JsonLine place_in_file(document);
  const std::string id(std::string_view(document["icao"].get_string()));
  const double start = document["timestamp"].get_double();
  RowTable table(fmt::format("trace of tar1090 ({} altitude)", geometric ? "geometric" : "barometric"),
                 {"icao24", "time", "lon", "lat", "alt_ft", "speed_kt", "course", "climb_fpm"});
  std::size_t without_height = 0;
  for (ondemand::array point : document["trace"].get_array()) {
    const std::size_t line = place_in_file.now();
    std::array<std::string, fields_read> fields;
    std::size_t place = 0;
    bool is_on_ground = false;
    for (ondemand::value value : point) {
      if (place == barometric_height && value.type() == ondemand::json_type::string)
        is_on_ground = std::string_view(value.get_string()) == "ground";
      if (place < fields_read) fields[place] = number_field_of(value);
      ++place;
    }
    std::string& height = fields[geometric ? geometric_height : barometric_height];
    if (height.empty() && is_on_ground) height = "ground";
    const auto offset = parse_number(fields[seconds]);
    without_height += height.empty() ? 1 : 0;
    if (!offset || height.empty()) continue;
    table.add_row(line, id, fmt::format("{:.3f}", start + *offset), fields[longitude], fields[latitude],
                  height, fields[speed], fields[course], fields[climb]);
  }
  if (without_height > 0)
    table.warnings.push_back(fmt::format("{}: {} points without a height are left out", id, without_height));
  return table;
}

}  // namespace

bool is_json_trace(std::string_view text) {
  const std::string_view begin = text.substr(0, 4096);
  return trimmed(begin).starts_with('{') && begin.find("\"icao\"") != std::string_view::npos &&
         begin.find("\"trace\"") != std::string_view::npos;
}

RowTable read_json_trace(const RecordingText& recording) {
  JsonDocumentReader reader;
  RowTable table;
  read_json(recording.file, 1, [&] {
    ondemand::document document = reader.open(recording.text);
    table = trace_table(document, recording.geometric);
  });
  return table;
}

bool is_json_list(std::string_view text) {
  if (has_orbital_elements(text)) return false;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const std::size_t second =
      first == std::string_view::npos ? first : text.find_first_not_of(" \t\r\n", first + 1);
  return second != std::string_view::npos && text[first] == '[' && text[second] == '{' &&
         !is_columnar_json(text) && !is_czml(text);
}

bool are_json_lines(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const std::string_view line = trimmed(text.substr(0, text.find('\n')));
  // A stream may have the beginning of a long line only.
  const bool may_be_whole = line.ends_with('}') || text.find('\n') == text.npos;
  return line.starts_with('{') && !line.starts_with("{'") && may_be_whole &&
         line.find("\"features\"") == line.npos && !is_columnar_json(text);
}

RowTable read_json_list(const RecordingText& recording) {
  // Lists that follow each other, as of a service that was asked again and again.
  const std::string_view text = recording.text.substr(recording.text.find_first_not_of(" \t\r\n"));
  const std::string_view first = text.substr(0, text.find('\n'));
  const bool are_lists =
      trimmed(first).ends_with(']') && text.find_first_not_of(" \t\r\n", first.size()) != text.npos;
  return are_lists ? read_json_lines(recording) : table_of_list(recording);
}

RowTable read_json_lines(const RecordingText& recording) {
  JsonDocumentReader reader;
  JsonRows rows;
  LineCutter lines(recording.text);
  std::size_t number = 0;
  read_json(recording.file, number, [&] {
    while (const auto line = lines.next()) {
      number = lines.line();
      if (line->empty()) continue;
      ondemand::document document = reader.open(*line);
      rows.add_document(document, number);
    }
  });
  return table_with_positions(std::move(rows), recording.file, false);
}

}  // namespace kinesphere::program
