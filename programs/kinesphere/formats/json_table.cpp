// JSON that is a table: records, as pandas and jq write them, and traces of tar1090.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "ascii_text.hpp"
#include "formats/converted_table.hpp"
#include "formats/json_reading.hpp"
#include "formats/report_format.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// Gathers objects as rows. Objects and short lists in them become several columns, with . between the names.
class JsonRows {
 public:
  void add(ondemand::object object, std::size_t line) {
    rows_.push_back({line, {}});
    add_fields("", object);
  }

  /// Returns the table; nothing where no column was found.
  std::optional<ConvertedTable> table() const {
    if (names_.empty()) return std::nullopt;
    ConvertedTable table{.format = "JSON records"};
    for (const std::string& name : names_) table.text += (table.text.empty() ? "" : ",") + quoted(name);
    table.text += '\n';
    table.lines_before = 1;
    std::size_t row_line = 1;
    for (const Row& row : rows_) {
      for (; row_line < row.line; ++row_line) table.text += '\n';
      for (std::size_t column = 0; column < names_.size(); ++column)
        table.text += (column == 0 ? "" : ",") + (column < row.fields.size() ? row.fields[column] : "");
      table.text += '\n';
      ++row_line;
    }
    return table;
  }

 private:
  struct Row {
    std::size_t line;
    std::vector<std::string> fields;  ///< by column
  };

  static std::string quoted(std::string_view text) {
    std::string field = "\"";
    for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c == '\n' || c == '\r' ? ' ' : c);
    return field + '"';
  }

  void add_fields(const std::string& prefix, ondemand::object object) {
    for (auto field : object) {
      const std::string name = prefix + std::string(std::string_view(field.unescaped_key()));
      add_value(name, field.value());
    }
  }
  void add_value(const std::string& name, ondemand::value value) {
    switch (value.type()) {
      case ondemand::json_type::object:
        return add_fields(name + '.', value.get_object());
      case ondemand::json_type::array: {
        // Longer lists are no positions.
        constexpr std::size_t longest = 3;
        ondemand::array list = value.get_array();
        if (list.count_elements() > longest) return;
        std::size_t place = 0;
        for (ondemand::value element : list) add_value(fmt::format("{}.{}", name, place++), element);
        return;
      }
      case ondemand::json_type::string:
        return set(name, quoted(value.get_string()));
      case ondemand::json_type::null:
        return set(name, "");
      default:
        // Numbers keep all their digits.
        return set(name, std::string(trimmed(value.raw_json_token())));
    }
  }
  void set(const std::string& name, std::string field) {
    const auto [place, is_new] = columns_.emplace(name, names_.size());
    if (is_new) names_.push_back(name);
    // Objects whose keys are ids or times would need memory for each of them in each row.
    constexpr std::size_t most_columns = 1000;
    if (names_.size() > most_columns)
      throw MalformedRecord(fmt::format("expected records of at most {} names, but got more", most_columns));
    auto& fields = rows_.back().fields;
    if (fields.size() <= place->second) fields.resize(place->second + 1);
    fields[place->second] = std::move(field);
  }

  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> columns_;
  std::vector<Row> rows_;
};

/// Calls `read`; throws ProgramError naming file and line of JSON that is none.
template <class Action>
void read_json(const std::string& file, const std::size_t& line, Action read) {
  try {
    read();
  } catch (const simdjson::simdjson_error& error) {
    throw ProgramError(fmt::format("{}:{}: expected JSON records: {}", file, line, error.what()));
  } catch (const MalformedRecord& error) {
    throw ProgramError(fmt::format("{}:{}: {}", file, line, error.what()));
  }
}

/// [{...}, {...}]
std::optional<ConvertedTable> table_of_list(std::string_view text, const std::string& file) {
  JsonDocumentReader reader;
  JsonRows rows;
  std::size_t line = 1;
  read_json(file, line, [&] {
    ondemand::document document = reader.open(text);
    const char *at = document.current_location(), *next = nullptr;
    for (ondemand::value value : document.get_array()) {
      if (!document.current_location().get(next))
        line += static_cast<std::size_t>(std::count(at, next, '\n'));
      if (next != nullptr) at = next;
      rows.add(value.get_object(), line);
    }
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
