// Formats whose reports are rows of a table: text with a row in each line, or AIS as it is published so; JSON
// records as they come; and recordings that are read as a whole, for a stream in the order of their times.
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "formats/recordings/recording_kinds.hpp"
#include "formats/streams/row_reports.hpp"
#include "formats/tables/json_rows.hpp"
#include "formats/tables/text_table.hpp"

namespace kinesphere::program {
namespace {

class CsvFormat final : public ReportFormat {
 public:
  CsvFormat(const FormatChoices& choices, bool is_ais)
      : table_(choices.source.empty() ? "the stream" : choices.source, choices.is_recording),
        reports_(make_row_reports(table_.head(), choices, is_ais)) {}

  void read(const Record& record, ReportSink& sink) override {
    if (const auto* const fields = table_.read(record)) reports_->read(*fields, record.line, sink);
  }
  void finish(ReportSink& /*sink*/) override { reports_->finish(); }
  const RowReader* rows() const override { return reports_->rows(); }

  void save(ByteWriter& state) const override {
    state(table_.beginning());
    reports_->save(state);
  }
  void restore(ByteReader& state) override {
    std::vector<std::string> lines;
    state(lines);
    for (const std::string& line : lines) table_.read({.text = line});
    reports_->restore(state);
  }

 private:
  TextTable table_;
  std::unique_ptr<RowReports> reports_;
};

/// Rows whose names of columns are known before, with a head of their own.
class NamedRows {
 public:
  NamedRows(const RowTable& table, const FormatChoices& choices)
      : head_(choices.source), reports_(make_row_reports(head_.head(), choices, false, &table)) {
    head_.set_separator(',');
    head_.row({table.names().begin(), table.names().end()});
  }
  NamedRows(const NamedRows&) = delete;
  NamedRows& operator=(const NamedRows&) = delete;

  void read(const std::vector<std::string_view>& fields, std::size_t line, ReportSink& sink) {
    if (head_.row(fields)) reports_->read(fields, line, sink);
  }
  /// Takes the first row of values, of which nothing is reported.
  void take_first(const std::vector<std::string_view>& fields) { head_.row(fields); }
  const TableHead& head() const { return head_.head(); }
  RowReports& reports() const { return *reports_; }

 private:
  TableHeadReader head_;
  std::unique_ptr<RowReports> reports_;
};

/// An object in each line, or a list of them, whose keys are the columns.
class JsonRecordsFormat final : public ReportFormat {
 public:
  explicit JsonRecordsFormat(FormatChoices choices) : choices_(std::move(choices)) {
    if (choices_.hints.format == "json") choices_.hints.format.clear();
    question_ = choices_.source + ": expected JSON objects that have an id, a time and a position";
  }

  void read(const Record& record, ReportSink& sink) override {
    if (!record.is_whole) throw MalformedRecord("expected a whole line, but it is too long or cut off");
    if (record.text.find_first_not_of(" \t\r") == std::string_view::npos) return;
    const std::size_t known = rows_.table.names().size();
    try {
      std::string_view text = record.text;
      if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
      ondemand::document document = reader_.open(text);
      rows_.add_document(document, record.line);
      if (rows_.table.names().size() > known)
        take_new_names(record, sink);
      else if (table_)
        read_rows(*table_, record, sink);
      else
        pass_without_columns(sink);
      rows_.table.forget(rows_.table.names().size());
    } catch (const simdjson::simdjson_error& error) {
      rows_.table.forget(known);
      throw MalformedRecord(std::string("expected a JSON object: ") + error.what());
    } catch (const WrongInput&) {
      rows_.table.forget(table_ ? names_taken_ : known);
      throw;
    }
  }
  void finish(ReportSink& /*sink*/) override {
    if (table_) return table_->reports().finish();
    if (without_columns_ > 0) throw ProgramError(question_);
  }
  const RowReader* rows() const override { return table_ ? table_->reports().rows() : nullptr; }

  void save(ByteWriter& state) const override {
    state(rows_.table.names(), table_ != nullptr);
    if (!table_) return;
    state(table_->head().first);
    table_->reports().save(state);
  }
  void restore(ByteReader& state) override {
    std::vector<std::string> names, first;
    bool has_table = false;
    state(names, has_table);
    for (const std::string& name : names) rows_.table.column_of(name);
    names_taken_ = rows_.table.names().size();
    if (!has_table) return;
    state(first);
    table_ = std::make_unique<NamedRows>(rows_.table, choices_);
    table_->take_first({first.begin(), first.end()});
    table_->reports().restore(state);
  }

 private:
  /// A row of a list that is wrong does not take the others along.
  void read_rows(NamedRows& table, const Record& record, ReportSink& sink) {
    for (std::size_t row = 0; row < rows_.table.size(); ++row) {
      rows_.table.read(row, fields_);
      try {
        table.read(fields_, record.line, sink);
      } catch (const WrongInput& error) {
        sink.refuse(record.line, error.what());
      }
    }
  }

  /// The first records may be of another kind, without positions.
  void pass_without_columns(ReportSink& sink) {
    constexpr std::size_t most_without_columns = 20;
    if (++without_columns_ == most_without_columns) throw ProgramError(question_);
    sink.pass_over(Passed::no_position);
  }

  /// Begins the table anew with a header that has the new names. A later record whose names make it unclear
  /// what the columns are is malformed.
  void take_new_names(const Record& record, ReportSink& sink) {
    auto table = std::make_unique<NamedRows>(rows_.table, choices_);
    try {
      read_rows(*table, record, sink);
    } catch (const ProgramError& error) {
      if (table_) throw MalformedRecord(error.what());
      // An option is missing.
      if (table->reports().rows() != nullptr) throw;
      question_ = error.what();
      return pass_without_columns(sink);
    }
    names_taken_ = rows_.table.names().size();
    if (table_) retired_.push_back(std::move(table_));
    table_ = std::move(table);
  }

  FormatChoices choices_;
  JsonDocumentReader reader_;
  JsonRows rows_;
  std::size_t names_taken_ = 0;  ///< of rows_, those that are columns of the table
  // Before there is a table.
  std::size_t without_columns_ = 0;
  std::string question_;
  std::unique_ptr<NamedRows> table_;
  std::vector<std::string_view> fields_;  ///< of the row
  /// Earlier tables, to whose texts reports refer that a sink has kept. There are no more than names.
  std::vector<std::unique_ptr<NamedRows>> retired_;
};

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

std::unique_ptr<ReportFormat> make_csv_format(const FormatChoices& choices) {
  return std::make_unique<CsvFormat>(choices, false);
}

std::unique_ptr<ReportFormat> make_ais_format(const FormatChoices& choices) {
  return std::make_unique<CsvFormat>(choices, true);
}

std::unique_ptr<ReportFormat> make_json_records_format(const FormatChoices& choices) {
  return std::make_unique<JsonRecordsFormat>(choices);
}

std::unique_ptr<ReportFormat> make_recording_format(const FormatChoices& choices) {
  return std::make_unique<RecordingFormat>(choices);
}

}  // namespace kinesphere::program
