// The names of the formats of recordings and streams, and their readers.
#include "formats/streams/report_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/recordings/recording_kinds.hpp"
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

}  // namespace

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
