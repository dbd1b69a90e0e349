// Rows of a table as reports.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "formats/streams/report_format.hpp"
#include "formats/tables/row_table.hpp"
#include "formats/tables/table_head.hpp"

namespace kinesphere::program {

/// Makes reports of rows, as their columns say, whichever file they come from.
class RowReports {
 public:
  virtual ~RowReports() = default;
  /// Passes the reports of a row of values to `sink`; its fields live until the next call. Throws WrongInput,
  /// ProgramError for a question, and UnusableStream.
  virtual void read(const std::vector<std::string_view>& fields, std::size_t line, ReportSink& sink) = 0;
  /// Call it at the end. Throws UnusableStream, and ProgramError for a question.
  virtual void finish() const = 0;
  /// Returns the reader of the rows; null before the first of them.
  virtual const RowReader* rows() const = 0;
  /// Writes the state from earlier rows, without the head of the table.
  virtual void save(ByteWriter& state) const = 0;
  /// Restores the state of save(). Precondition: the head is as it was then.
  virtual void restore(ByteReader& state) = 0;
};

/// `head` must outlive it, and is complete with the first row. `is_ais`: the tracks are ships. `recording`:
/// the rows are those of this one, which must outlive it; null for a table.
std::unique_ptr<RowReports> make_row_reports(const TableHead& head, const FormatChoices& choices,
                                             bool is_ais = false, const RowTable* recording = nullptr);

}  // namespace kinesphere::program
