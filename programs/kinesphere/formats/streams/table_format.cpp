// Tables as text with a report in each line: with a map of columns, or AIS as it is published in tables.
#include "formats/streams/row_reports.hpp"
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

}  // namespace

std::unique_ptr<ReportFormat> make_csv_format(const FormatChoices& choices) {
  return std::make_unique<CsvFormat>(choices, false);
}

std::unique_ptr<ReportFormat> make_ais_format(const FormatChoices& choices) {
  return std::make_unique<CsvFormat>(choices, true);
}

}  // namespace kinesphere::program
