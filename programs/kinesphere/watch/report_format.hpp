// The formats of streams: what makes reports of records.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "kinesphere/monitor/report.hpp"
#include "watch/record_cutter.hpp"
#include "watch/source_report.hpp"

namespace kinesphere::program {

/// A record is not what its format says; the message says what was expected.
class MalformedRecord : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ReportFormat {
 public:
  virtual ~ReportFormat() = default;
  /// Hands over the reports of a record. Throws MalformedRecord; what has been handed over before holds.
  virtual void read(const Record& record, ReportSink& sink) = 0;
  /// What it keeps of the records before, for one that goes on behind them.
  virtual nlohmann::json save() const;
  /// Throws ProgramError as read() may, or an exception of nlohmann::json.
  virtual void restore(const nlohmann::json& state);
};

enum class StreamFormat { readsb, sbs, opensky, ais, csv, jsonl };

/// "readsb" and so on; with all names, separated by |, for help.
std::string_view name_of(StreamFormat format);
std::optional<StreamFormat> stream_format_named(std::string_view name);
inline constexpr const char* stream_format_names = "readsb|sbs|opensky|ais|csv|jsonl";

/// What is promised of tracks, and how far off reports are at most, where neither the stream nor an option
/// says it. Empty: it has to be said.
struct FormatDefaults {
  int dimensions = 3;
  bool geographic = true;  ///< always; otherwise the stream may have either
  std::optional<ErrorBound> acceleration{};
  std::optional<ErrorBound> largest_speed{};
  std::optional<double> position_error{}, height_error{}, velocity_error{}, climb_error{};
  double stamp_error = 0.0;
  double velocity_age = 0.0;
  double silence = 60.0, forget = 300.0;
  double window = 1.0;
};
/// docs/watch.md says where they come from.
FormatDefaults defaults_of(StreamFormat format);

struct FormatChoices {
  std::string columns;  ///< of csv: id=...,time=...
  enum class Altitude { barometric, geometric } altitude = Altitude::barometric;
  enum class PositionBound {
    containment_radius,
    accuracy
  } position_bound = PositionBound::containment_radius;
  /// So many times a 95 % accuracy is declared to contain all errors.
  double containment = 2.5;
  /// Positions that the aircraft has not told itself, but radar or receivers on the ground, have no bound
  /// unless one was said.
  bool position_error_is_said = false;
  double velocity_age = 5.0;  ///< sbs: an older velocity is not used (seconds)
};

/// Throws ProgramError naming an option that is wrong. `first_line` is that of the stream.
std::unique_ptr<ReportFormat> make_format(StreamFormat format, const FormatChoices& choices);
RecordCutter::Kind records_of(StreamFormat format);

/// What the beginning of a stream, its first line or a part of that, unmistakably is.
std::optional<StreamFormat> recognised_format(std::string_view beginning);

// One file each.
std::unique_ptr<ReportFormat> make_readsb_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_sbs_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_opensky_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_csv_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_ais_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_json_lines_format(const FormatChoices& choices);

}  // namespace kinesphere::program
