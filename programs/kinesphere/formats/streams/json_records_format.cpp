// JSON records as they come, an object in each line: rows of a table whose columns are their keys.
#include <algorithm>
#include <utility>
#include <vector>

#include "formats/streams/row_reports.hpp"
#include "formats/tables/json_rows.hpp"

namespace kinesphere::program {
namespace {

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

}  // namespace

std::unique_ptr<ReportFormat> make_json_records_format(const FormatChoices& choices) {
  return std::make_unique<JsonRecordsFormat>(choices);
}

}  // namespace kinesphere::program
