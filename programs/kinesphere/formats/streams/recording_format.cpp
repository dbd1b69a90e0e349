// A recording that is read as a whole (GPX, XYZ and others): its reports, for a stream in the order of their
// times.
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "formats/recordings/recording_kinds.hpp"
#include "formats/streams/row_reports.hpp"

namespace kinesphere::program {
namespace {

/// Finds the time of each row; one without a time has that of the row before.
class TimeSink final : public ReportSink {
 public:
  void take(const SourceReport& report) override { time = report.stamp; }
  void time_is(const FileTime&, TimeKind) override {}
  void pass_over(Passed) override {}
  void refuse(std::size_t, const std::string&) override {}

  FileTime time{};
};

class RecordingFormat final : public ReportFormat {
 public:
  explicit RecordingFormat(FormatChoices choices) : choices_(std::move(choices)) {}

  /// `record` is the whole text.
  void read(const Record& record, ReportSink& sink) override {
    const RecordingKind* const kind = recording_kind_of(record.text, choices_.hints);
    if (kind == nullptr)
      throw UnusableStream("expected a recording as tracks reads it, such as GPX or XYZ, but it is none");
    if (names_no_preset(choices_.hints.format)) choices_.hints.format.clear();
    const bool has_mark = record.text.starts_with("\xEF\xBB\xBF");
    table_ = kind->read({.text = record.text.substr(has_mark ? 3 : 0),
                         .file = choices_.source,
                         .geometric = choices_.altitude == FormatChoices::Altitude::geometric});
    for (const std::string& warning : table_.warnings) sink.warn(warning);
    rows_.emplace(table_, choices_);
    std::vector<std::string_view> fields;
    for (const std::size_t row : rows_in_order()) {
      if (is_stopped()) break;
      const std::size_t line = table_.line(row);
      table_.read(row, fields);
      sink.begin_row(line);
      try {
        rows_->read(fields, line, sink);
      } catch (const WrongInput& error) {
        sink.refuse(line, error.what());
      }
    }
    rows_->reports().finish();
  }
  void finish(ReportSink& /*sink*/) override {
    if (!rows_) throw UnusableStream("expected a recording, but it is empty");
  }
  const RowReader* rows() const override { return rows_ ? rows_->reports().rows() : nullptr; }
  std::string_view title() const override { return table_.format; }

 private:
  bool is_stopped() const { return choices_.is_stopped && choices_.is_stopped(); }
  /// True for a name of --format that is none of columns.
  static bool names_no_preset(std::string_view format) {
    return format == "recording" || format == "json" || format == "nmea";
  }

  /// Returns the rows as they are in the file or, for a stream, by time, those of one time as in the file.
  /// What is wrong is found when they are read.
  std::vector<std::size_t> rows_in_order() const {
    std::vector<std::size_t> rows(table_.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    if (choices_.is_recording) return rows;
    NamedRows reader(table_, choices_);
    TimeSink sink;
    std::vector<FileTime> times;
    std::vector<std::string_view> fields;
    for (const std::size_t row : rows) {
      if (is_stopped()) return rows;
      table_.read(row, fields);
      try {
        reader.read(fields, table_.line(row), sink);
      } catch (const WrongInput&) {
      }
      times.push_back(sink.time);
    }
    std::ranges::stable_sort(rows,
                             [&](std::size_t a, std::size_t b) { return is_earlier(times[a], times[b]); });
    return rows;
  }

  FormatChoices choices_;
  RowTable table_;
  std::optional<NamedRows> rows_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_recording_format(const FormatChoices& choices) {
  return std::make_unique<RecordingFormat>(choices);
}

}  // namespace kinesphere::program
