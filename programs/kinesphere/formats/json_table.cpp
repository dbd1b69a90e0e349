// JSON that is a table: records, as pandas and jq write them, and traces of tar1090.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ascii_text.hpp"
#include "formats/converted_table.hpp"
#include "formats/json_rows.hpp"
#include "formats/report_format.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// [{...}, {...}]
std::optional<ConvertedTable> table_of_list(std::string_view text, const std::string& file) {
  JsonDocumentReader reader;
  JsonRows rows;
  std::size_t line = 1;
  read_json(file, line, [&] {
    ondemand::document document = reader.open(text);
    JsonLine place(document);
    for (ondemand::value value : document.get_array()) {
      line = place.now();
      rows.add(value.get_object(), line);
    }
    require_end(document, "one list of JSON records");
  });
  return rows.table();
}

/// An object in each line.
std::optional<ConvertedTable> table_of_lines(std::string_view text, const std::string& file) {
  JsonDocumentReader reader;
  JsonRows rows;
  LineCutter lines(text);
  std::size_t number = 0;
  read_json(file, number, [&] {
    while (const auto line = lines.next()) {
      number = lines.line();
      if (line->empty()) continue;
      ondemand::document document = reader.open(*line);
      rows.add(document.get_object(), number);
      require_end(document, "one JSON object in a line");
    }
  });
  return rows.table();
}

/// Returns a field of a table for a number, or nothing.
std::string number_field_of(ondemand::value value) {
  return value.type() == ondemand::json_type::number ? std::string(trimmed(value.raw_json_token())) : "";
}

/// trace: [[seconds since timestamp, latitude, longitude, barometric altitude in ft or "ground", speed,
/// course, flags, climb, details, source, geometric altitude, ...], ...]
ConvertedTable trace_table(ondemand::document& document, bool geometric) {
  enum at { seconds, latitude, longitude, barometric_height, geometric_height = 10, fields_read };
  const std::string id(std::string_view(document["icao"].get_string()));
  const double start = document["timestamp"].get_double();
  ConvertedTable table{
      .format = fmt::format("trace of tar1090 ({} altitude)", geometric ? "geometric" : "barometric"),
      .text = "icao24,time,lon,lat,alt_ft\n"};
  std::size_t without_height = 0;
  for (ondemand::array point : document["trace"].get_array()) {
    std::array<std::string, fields_read> fields;
    std::size_t place = 0;
    for (ondemand::value value : point)
      if (place < fields_read) fields[place++] = number_field_of(value);
    const std::string& height = fields[geometric ? geometric_height : barometric_height];
    const auto offset = parse_number(fields[seconds]);
    without_height += height.empty() ? 1 : 0;
    if (!offset || height.empty()) continue;
    table.text +=
        fmt::format("{},{:.3f},{},{},{}\n", id, start + *offset, fields[longitude], fields[latitude], height);
  }
  if (without_height > 0)
    table.warnings.push_back(
        fmt::format("{}: {} points on the ground, or without a height, are left out", id, without_height));
  return table;
}

}  // namespace

std::optional<ConvertedTable> convert_json_trace(std::string_view text, const std::string& file,
                                                 bool geometric) {
  const std::string_view begin = text.substr(0, 4096);
  if (!trimmed(begin).starts_with('{') || begin.find("\"icao\"") == std::string_view::npos ||
      begin.find("\"trace\"") == std::string_view::npos)
    return std::nullopt;
  JsonDocumentReader reader;
  std::optional<ConvertedTable> table;
  read_json(file, 1, [&] {
    ondemand::document document = reader.open(text);
    table = trace_table(document, geometric);
  });
  return table;
}

std::optional<ConvertedTable> convert_json_records(std::string_view text, const std::string& file) {
  if (recognised_format(text.substr(0, 4096))) return std::nullopt;
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with('[')) {
    const std::size_t first = text.find_first_not_of(" \t\r\n", 1);
    const bool is_list = first != std::string_view::npos && text[first] == '{';
    return is_list ? table_of_list(text, file) : std::nullopt;
  }
  const std::string_view line = trimmed(text.substr(0, text.find('\n')));
  const bool has_objects =
      line.starts_with('{') && line.ends_with('}') && line.find("\"features\"") == line.npos;
  return has_objects ? table_of_lines(text, file) : std::nullopt;
}

}  // namespace kinesphere::program
