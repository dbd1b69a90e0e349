// A recording that is read as a whole (GPX, XYZ and others), as a stream: its reports in the order of their
// times.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "formats/converted/converted_table.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {
namespace {

/// Finds the time of each record; one without a time has that of the record before.
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
  explicit RecordingFormat(FormatChoices choices) : choices_(std::move(choices)) {
    if (choices_.hints.format == "recording") choices_.hints.format.clear();
  }

  /// `record` is the whole text.
  void read(const Record& record, ReportSink& sink) override {
    const bool geometric = choices_.altitude == FormatChoices::Altitude::geometric;
    const auto table = convert_to_table(record.text, choices_.source, geometric);
    if (!table)
      throw UnusableStream("expected a recording as tracks reads it, such as GPX or XYZ, but it is none");
    for (const std::string& warning : table->warnings) sink.warn(warning);
    choices_.title = table->format;
    table_ = make_csv_format(choices_);
    for (const Row& row : rows_in_order(*table)) {
      if (is_stopped()) break;
      try {
        table_->read(row.record, sink);
      } catch (const WrongInput& error) {
        sink.refuse(row.record.line, error.what());
      }
    }
    table_->finish(sink);
  }
  void finish(ReportSink& /*sink*/) override {
    if (!table_) throw UnusableStream("expected a recording, but it is empty");
  }
  const RowReader* rows() const override { return table_ ? table_->rows() : nullptr; }
  std::string_view title() const override { return choices_.title; }

 private:
  struct Row {
    Record record;
    FileTime time{};
  };

  bool is_stopped() const { return choices_.is_stopped && choices_.is_stopped(); }

  /// Returns the rows by time, those of one time as in the table. What is wrong is found when they are read.
  std::vector<Row> rows_in_order(const ConvertedTable& table) const {
    std::vector<Row> rows;
    const auto reader = make_csv_format(choices_);
    TimeSink times;
    LineCutter lines(table.text);
    std::ptrdiff_t header = 0;
    while (!is_stopped() && lines.next()) {
      if (lines.whole().empty()) continue;
      header += lines.line() <= std::max<std::size_t>(table.lines_before, 1) ? 1 : 0;
      Row row{{.text = lines.whole(), .line = table.line_in_file(lines.line())}};
      try {
        reader->read(row.record, times);
      } catch (const WrongInput&) {
      }
      row.time = times.time;
      rows.push_back(row);
    }
    std::stable_sort(rows.begin() + header, rows.end(),
                     [](const Row& a, const Row& b) { return is_earlier(a.time, b.time); });
    return rows;
  }

  FormatChoices choices_;
  std::unique_ptr<ReportFormat> table_;
};

}  // namespace

std::unique_ptr<ReportFormat> make_recording_format(const FormatChoices& choices) {
  return std::make_unique<RecordingFormat>(choices);
}

}  // namespace kinesphere::program
