// The catalogue of what files and streams may be: names, how their beginnings tell them apart, and their
// readers.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/recordings/file_kind.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/streams/report_format.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/presets.hpp"

namespace kinesphere::program {
namespace {

struct FormatRow {
  std::string_view name;
  StreamFormat format;
  RecordCutter::Kind records;
  std::unique_ptr<ReportFormat> (*make)(const FormatChoices& choices);
};

/// In the order of StreamFormat.
constexpr FormatRow format_rows[] = {
    {"readsb", StreamFormat::readsb, RecordCutter::Kind::documents, make_readsb_format},
    {"sbs", StreamFormat::sbs, RecordCutter::Kind::lines, make_sbs_format},
    {"opensky", StreamFormat::opensky, RecordCutter::Kind::documents, make_opensky_format},
    {"ais", StreamFormat::ais, RecordCutter::Kind::lines, make_ais_format},
    {"nmea", StreamFormat::nmea, RecordCutter::Kind::lines, make_nmea_format},
    {"csv", StreamFormat::csv, RecordCutter::Kind::lines, make_csv_format},
    {"jsonl", StreamFormat::jsonl, RecordCutter::Kind::lines, make_json_lines_format},
    {"json", StreamFormat::json, RecordCutter::Kind::lines, make_json_records_format},
    {"recording", StreamFormat::recording, RecordCutter::Kind::whole, make_recording_format}};

const FormatRow& row_of(StreamFormat format) { return format_rows[static_cast<std::size_t>(format)]; }

/// Messages have no columns.
void refuse_table_options(const FormatChoices& choices) {
  const ColumnHints& hints = choices.hints;
  for (const auto& [option, is_given] :
       {std::pair("--columns", !hints.columns.empty()), std::pair("--where", !hints.where.empty()),
        std::pair("--positions", !hints.positions.empty()), std::pair("--unit", !hints.unit.empty()),
        std::pair("--time-unit", !hints.time_unit.empty()),
        std::pair("--frame-rate", hints.frame_rate.has_value()),
        std::pair("--dates", hints.dates != DateOrder::unknown), std::pair("--sizes", hints.sizes)})
    if (is_given)
      throw ProgramError(fmt::format("{}: expected a table, but {} has no columns", option, choices.source));
}

/// The first kind that a text is counts.
constexpr RecordingKind recording_kinds[] = {
    {"a trace of tar1090", is_json_trace, read_json_trace},
    {"GPX", [](std::string_view text) { return root_element(text) == "gpx"; }, read_gpx},
    {"the FCD output of SUMO", [](std::string_view text) { return root_element(text) == "fcd-export"; },
     read_fcd},
    {"a dump of LAMMPS", [](std::string_view text) { return text.starts_with("ITEM: "); }, read_lammps},
    {"XYZ", is_xyz, read_xyz},
    {"a log of a GPS receiver", is_gps_log, read_gps_log},
    {"an ephemeris (OEM)",
     [](std::string_view text) { return trimmed(text.substr(0, 100)).starts_with("CCSDS_OEM_VERS"); },
     read_oem},
    {"GeoJSON", is_geojson, read_geojson},
    {"a feed of GTFS-realtime", is_gtfs, read_gtfs},
    {"ASTERIX in JSON", is_asterix, read_asterix},
    {"a list of JSON records", is_json_list, read_json_list, true},
    {"JSON records in lines", are_json_lines, read_json_lines, true}};

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

const RecordingKind* recording_kind_of(std::string_view beginning, const ColumnHints& hints) {
  if (beginning.starts_with("\xEF\xBB\xBF")) beginning.remove_prefix(3);
  const bool is_said = !hints.columns.empty() || hints.format == "json";
  const auto* const found = std::ranges::find_if(recording_kinds, [&](const RecordingKind& kind) {
    return (kind.is_json_records || hints.format != "table") && kind.is_of_it(beginning);
  });
  if (found == std::end(recording_kinds)) return nullptr;
  constexpr std::size_t enough = 4096;
  const bool may_be_messages = found->read == read_json_lines && !is_said;
  return may_be_messages && recognised_format(beginning.substr(0, enough)) ? nullptr : found;
}

std::string_view name_of(StreamFormat format) { return row_of(format).name; }

std::optional<StreamFormat> format_named(std::string_view name, std::string_view beginning) {
  if (name == "opensky" && !beginning.empty() && !trimmed(beginning).starts_with('{'))
    return StreamFormat::csv;
  for (const FormatRow& row : format_rows)
    if (row.name == name) return row.format;
  if (name == "dma") return StreamFormat::ais;
  return name == "table" || preset_named(name) != nullptr ? std::optional(StreamFormat::csv) : std::nullopt;
}

std::optional<StreamFormat> format_of_text(std::string_view beginning, const ColumnHints& hints) {
  constexpr std::size_t enough = 4096;
  const auto said = format_named(hints.format, beginning.substr(0, enough));
  // Sentences are messages of AIS, or a log of one receiver.
  if (!said || is_table(*said) || *said == StreamFormat::nmea)
    if (const RecordingKind* const kind = recording_kind_of(beginning, hints))
      return kind->read == read_json_lines ? StreamFormat::json : StreamFormat::recording;
  if (said) return said;
  const auto shown = recognised_format(beginning.substr(0, enough));
  if (hints.columns.empty()) return shown;
  return shown == StreamFormat::ais ? StreamFormat::ais : StreamFormat::csv;
}

std::string format_names() {
  std::string names = preset_names();
  for (const FormatRow& row : format_rows)
    if (preset_named(row.name) == nullptr) names += fmt::format("|{}", row.name);
  return names;
}

RecordCutter::Kind records_of(StreamFormat format) { return row_of(format).records; }

std::unique_ptr<ReportFormat> make_format(StreamFormat format, const FormatChoices& choices) {
  if (!is_table(format)) refuse_table_options(choices);
  return row_of(format).make(choices);
}

}  // namespace kinesphere::program
