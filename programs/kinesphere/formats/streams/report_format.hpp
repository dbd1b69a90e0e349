// The formats of recordings and streams, which turn records into reports.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "archive/archive.hpp"
#include "formats/streams/source_report.hpp"
#include "formats/tables/record_cutter.hpp"
#include "formats/tables/row_splitter.hpp"
#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Tables are `csv`, and `ais` where their tracks are ships. `json` are JSON records in lines, and
/// `recording` is what is read as a whole; both have rows of a table. The others are messages.
enum class StreamFormat { readsb, sbs, opensky, ais, nmea, csv, jsonl, json, recording };
/// True for what a file shows as a recording, and not as the text of a table.
constexpr bool is_read_whole(StreamFormat format) {
  return format == StreamFormat::json || format == StreamFormat::recording;
}
constexpr bool is_table(StreamFormat format) {
  return format == StreamFormat::csv || format == StreamFormat::ais || is_read_whole(format);
}

/// A stream has nothing that can be used; the message says what was expected, without the stream's name.
class UnusableStream : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class ReportFormat {
 public:
  virtual ~ReportFormat() = default;
  /// Passes the reports of a record to `sink`. Throws WrongInput, such as MalformedRecord; reports passed
  /// before that stay valid. Throws UnusableStream.
  virtual void read(const Record& record, ReportSink& sink) = 0;
  /// Of a table, the reader of its rows; null before the first of them, and for other formats.
  virtual const RowReader* rows() const { return nullptr; }
  /// Returns what kind of recording was read; empty for other formats.
  virtual std::string_view title() const { return {}; }
  /// Call it at the end of the stream. Throws UnusableStream.
  virtual void finish(ReportSink& /*sink*/) {}
  /// Writes the state from earlier records, for a run that continues behind them.
  virtual void save(ByteWriter& /*state*/) const {}
  /// Restores the state of save(); it has failed if it is none of this format. Throws ProgramError like
  /// read().
  virtual void restore(ByteReader& /*state*/) {}
};

/// A format that remembers the fields that its serialize() names.
template <class Format>
class RememberingFormat : public ReportFormat {
 public:
  void save(ByteWriter& state) const final { Format::serialize(static_cast<const Format&>(*this), state); }
  void restore(ByteReader& state) final { Format::serialize(static_cast<Format&>(*this), state); }
};

/// Returns "readsb" and so on.
std::string_view name_of(StreamFormat format);
/// Returns the format that --format says of a text with this beginning; nothing for an unknown name. Messages
/// and tables of OpenSky have one name: without a beginning they are messages.
std::optional<StreamFormat> format_named(std::string_view name, std::string_view beginning = {});
/// Returns the format of a text with this beginning, of some thousand bytes or the whole of it: as --format
/// says or, without it, as the text shows; of these recordings come first, then messages, and --columns
/// implies a table. Nothing if it is ambiguous: a table, or too little of a text.
std::optional<StreamFormat> format_of_text(std::string_view beginning, const ColumnHints& hints);
/// Returns the first line that says something, which comments of one column do not: of JSON over several
/// lines, the lines up to the first with a key. Empty if it has not ended yet.
std::string_view first_line(std::string_view beginning);
/// Returns the format of a stream that begins with this text, its first line or a part of it; nothing if it
/// is ambiguous.
std::optional<StreamFormat> recognised_format(std::string_view beginning);
/// Returns the names of all formats of messages and of all presets of tables, separated by |.
std::string format_names();

/// The command line's choices about a file or stream.
struct FormatChoices {
  ColumnHints hints;   ///< for tables, but for --format
  std::string source;  ///< the stream's name, for messages
  enum class Altitude { barometric, geometric } altitude = Altitude::barometric;
  enum class PositionBound {
    containment_radius,
    accuracy
  } position_bound = PositionBound::containment_radius;
  /// Multiple of a 95 % accuracy that is declared to contain all errors.
  double containment = 2.5;
  /// True if an option gave the position error; otherwise positions from radar or receivers on the ground
  /// have no bound.
  bool position_error_is_said = false;
  double velocity_age = 5.0;  ///< sbs: an older velocity is not used (seconds)
  /// The whole file is read: each row of a table has as many fields as the first, and what is asked about is
  /// never only a damaged line. Reports of tables then have no velocity, errors and kind.
  bool is_recording = false;
  /// nmea: if not empty, sentences RMC are reports of a track of this id, in place of VDO.
  std::string own_by_gps{};
  /// If not empty, asked between the rows of a recording; true ends it there.
  std::function<bool()> is_stopped{};
};

/// Throws ProgramError naming a wrong option, also for an option about tables that is given with messages.
std::unique_ptr<ReportFormat> make_format(StreamFormat format, const FormatChoices& choices);
RecordCutter::Kind records_of(StreamFormat format);

// One file each.
std::unique_ptr<ReportFormat> make_readsb_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_sbs_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_opensky_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_nmea_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_csv_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_ais_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_json_lines_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_json_records_format(const FormatChoices& choices);
std::unique_ptr<ReportFormat> make_recording_format(const FormatChoices& choices);

}  // namespace kinesphere::program
