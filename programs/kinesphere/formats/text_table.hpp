// Reads tables in text files: any separator, quoted or not, with or without a header.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/row_splitter.hpp"
#include "formats/table_head.hpp"

namespace kinesphere::program {

/// One row of a table. Its fields are valid until the next row is read.
struct TableRow {
  int line = 0;  ///< first line, counted from 1
  std::vector<std::string_view> fields;
};

/// Reads a table row by row, as RowSplitter splits rows and TableHeadReader finds the header. A byte order
/// mark, empty lines, and lines that begin with # are skipped.
class TextTable {
 public:
  /// Reads up to the first row of values. Throws ProgramError naming file and line as next() does, if there
  /// is no row of values, and if this is another kind of file.
  TextTable(std::string text, std::string file);
  TextTable(const TextTable&) = delete;
  TextTable& operator=(const TextTable&) = delete;

  const TableHead& head() const { return reader_.head(); }
  const std::string& file() const { return head().file; }
  /// Names of the columns; empty if the file has no header.
  const std::vector<std::string>& header() const { return head().names; }
  std::size_t columns() const { return columns_; }

  /// Reads the next row, beginning with the first; returns false after the last. Throws ProgramError naming
  /// file, line and column if a row has more or fewer fields than the first, or wrong quotes.
  bool next(TableRow& row);

 private:
  /// Skips to the next line that is a row; returns false at the end.
  bool skip_to_row();
  void read_row(TableRow& row);

  std::string text_;
  RowSplitter rows_;
  TableHeadReader reader_;
  std::size_t columns_ = 0;
  TableRow first_;
  bool first_is_ahead_ = true;
  std::deque<std::string> first_unquoted_;  ///< unquoted fields of the first row, which is kept
};

}  // namespace kinesphere::program
