// The formats of streams: names, recognition and defaults.
#include "watch/report_format.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "ascii_text.hpp"
#include "watch/ais/nmea_line.hpp"
#include "watch/class_rules.hpp"
#include "watch/measures.hpp"

namespace kinesphere::program {
namespace {

constexpr std::pair<std::string_view, StreamFormat> stream_formats[] = {
    {"readsb", StreamFormat::readsb}, {"sbs", StreamFormat::sbs},   {"opensky", StreamFormat::opensky},
    {"ais", StreamFormat::ais},       {"nmea", StreamFormat::nmea}, {"csv", StreamFormat::csv},
    {"jsonl", StreamFormat::jsonl}};

/// 92.6 m and 10 m/s (95 % of errors) are the requirements of 14 CFR 91.227 and (EU) 1207/2011 for mandatory
/// ADS-B (NACp 8, NACv 1); 75 m is the altimeter error that ICAO Doc 9574 allows, and half of 25 ft is the
/// resolution of height reports.
FormatDefaults of_aircraft() {
  constexpr double declared = 2.5;
  const MotionLimits limits = motion_class(MotionPreset::airliner).limits;
  return {.acceleration = limits.acceleration,
          .largest_speed = limits.largest_speed,
          .position_error = declared * 92.6,
          .height_error = 75.0 + 12.5 * foot,
          .velocity_error = declared * 10.0,
          .climb_error = declared * 50.0 * foot,
          .stamp_error = 0.6,
          .velocity_age = 2.0,
          .silence = 15.0,
          .forget = 60.0,
          .window = 1.0,
          .look_ahead = 60.0};
}

FormatDefaults of_vessels() {
  constexpr double declared = 2.5;
  const MotionLimits limits = motion_class(MotionPreset::vessel).limits;
  return {.dimensions = 2,
          .acceleration = limits.acceleration,
          .largest_speed = limits.largest_speed,
          .position_error = declared * 10.0,
          .height_error = 0.0,
          .velocity_error = declared * 0.5,
          .climb_error = 0.0,
          .stamp_error = 1.0,
          .silence = 210.0,
          .forget = 600.0,
          .window = 16.0,
          .look_ahead = 60.0};
}

/// Sentences of AIS say whether a position is within 10 m or worse. 100 m (95 %) is what IMO MSC.112(73) asks
/// of ships' receivers of GPS; since GPS is no longer degraded on purpose it is declared to contain all
/// errors.
FormatDefaults of_stations() {
  FormatDefaults defaults = of_vessels();
  defaults.position_error = 100.0;
  return defaults;
}

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

std::unique_ptr<ReportFormat> without_columns(StreamFormat format, const FormatChoices& choices) {
  if (format == StreamFormat::readsb) return make_readsb_format(choices);
  if (format == StreamFormat::sbs) return make_sbs_format(choices);
  if (format == StreamFormat::opensky) return make_opensky_format(choices);
  if (format == StreamFormat::nmea) return make_nmea_format(choices);
  return make_json_lines_format(choices);
}

bool has_column(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    std::string_view field = header.substr(0, header.find(','));
    header.remove_prefix(std::min(field.size() + 1, header.size()));
    if (same_name(field, name)) return true;
  }
  return false;
}

}  // namespace

nlohmann::json ReportFormat::save() const { return nullptr; }
void ReportFormat::restore(const nlohmann::json&) {}
void ReportFormat::finish(ReportSink&) {}

std::string_view name_of(StreamFormat format) {
  for (const auto& [name, each] : stream_formats)
    if (each == format) return name;
  return "unknown";
}

std::optional<StreamFormat> stream_format_named(std::string_view name) {
  for (const auto& [each, format] : stream_formats)
    if (each == name) return format;
  return std::nullopt;
}

FormatDefaults defaults_of(StreamFormat format) {
  switch (format) {
    case StreamFormat::readsb:
    case StreamFormat::sbs:
      return of_aircraft();
    case StreamFormat::opensky: {
      FormatDefaults defaults = of_aircraft();
      // Timestamps are whole seconds, of snapshots about ten seconds apart.
      defaults.stamp_error = 1.0;
      defaults.silence = 30.0;
      defaults.forget = 120.0;
      defaults.window = 8.0;
      return defaults;
    }
    case StreamFormat::ais:
      return of_vessels();
    case StreamFormat::nmea:
      return of_stations();
    case StreamFormat::csv:
    case StreamFormat::jsonl:
      break;
  }
  return {.geographic = false};
}

RecordCutter::Kind records_of(StreamFormat format) {
  return format == StreamFormat::readsb || format == StreamFormat::opensky ? RecordCutter::Kind::documents
                                                                           : RecordCutter::Kind::lines;
}

std::string_view first_line(std::string_view beginning) {
  beginning.remove_prefix(std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size()));
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
  if (looks_like_nmea(line) || (!line.starts_with('{') && has_ais_sentence(beginning.substr(0, 4096))))
    return StreamFormat::nmea;
  for (const std::string_view type : {"MSG,", "SEL,", "ID,", "AIR,", "STA,", "CLK,"})
    if (line.starts_with(type)) return StreamFormat::sbs;
  if (line.starts_with('{')) {
    if (has_key(line, "aircraft") || has_key(line, "ac") || has_key(line, "now")) return StreamFormat::readsb;
    if (has_key(line, "states") || (has_key(line, "time") && !has_key(line, "id")))
      return StreamFormat::opensky;
    if (has_key(line, "stamp")) return StreamFormat::jsonl;
    return std::nullopt;
  }
  if (has_column(line, "MMSI") && (has_column(line, "BaseDateTime") || has_column(line, "base_date_time") ||
                                   has_column(line, "Type of mobile")))
    return StreamFormat::ais;
  // A header consists of names.
  const bool has_letters =
      std::any_of(line.begin(), line.end(), [](char c) { return ('a' <= (c | 32) && (c | 32) <= 'z'); });
  if (has_letters && line.find_first_of(",;\t") != std::string_view::npos && !line.starts_with('!') &&
      !line.starts_with('[') && !line.starts_with('$') && !line.starts_with('\\'))
    return StreamFormat::csv;
  return std::nullopt;
}

std::unique_ptr<ReportFormat> make_format(StreamFormat format, const FormatChoices& choices) {
  // Tables have their own columns for expressions.
  if (format == StreamFormat::ais) return make_ais_format(choices);
  if (format == StreamFormat::csv) return make_csv_format(choices);
  auto made = without_columns(format, choices);
  if (choices.class_rules.empty()) return made;
  return make_ruled_format(std::move(made), choices.class_rules);
}

}  // namespace kinesphere::program
