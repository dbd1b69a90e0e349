// What stands before the rows of a table: comments, names of columns, their units.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinesphere::program {

struct TableHead {
  std::string file;                   ///< name of the table, for messages
  std::vector<std::string> comments;  ///< without the signs before them
  std::vector<std::string> names;     ///< of the columns; empty without a header
  std::vector<std::string> units;     ///< from a row of units below the header; empty, or one for each column
  std::vector<std::string> first;     ///< fields of the first row of values
  char separator = ' ';

  /// Columns that have a name, where there are names, and a value in the first row, which a stream may have
  /// longer or shorter than its header.
  std::size_t columns() const { return names.empty() ? first.size() : std::min(first.size(), names.size()); }
  /// Returns "the columns a, b, c", or "no header and 3 columns".
  std::string text() const;
};

/// Finds the head of a table. The first row is the header if no field of it is a number. Rows below it
/// without numbers and dates that repeat names or say units belong to it. Without such a header, the last
/// comment is the header if it has one field, or word, for each column.
class TableHeadReader {
 public:
  explicit TableHeadReader(std::string file) { head_.file = std::move(file); }

  void set_separator(char separator) { head_.separator = separator; }
  /// Takes a line that is a comment, without the sign before it.
  void comment(std::string_view line);
  /// The rows have a column more than the header, before its first.
  void add_row_names() { head_.names.insert(head_.names.begin(), ""); }
  /// Takes a row, and returns true if it has values: it is neither of the head, nor the header again.
  bool row(const std::vector<std::string_view>& fields);
  /// True from the first row of values on, with which the head is complete.
  bool is_complete() const { return is_complete_; }

  const TableHead& head() const { return head_; }

 private:
  bool completes_head(const std::vector<std::string_view>& fields);
  bool is_below_header(const std::vector<std::string_view>& fields) const;

  TableHead head_;
  bool is_complete_ = false;
  int rows_below_ = 0;  ///< of the header, that belong to it
};

/// Returns the number, from 1, of a line below the first whose fields are the usual names of a time or frame
/// and of two coordinates, as many as the next line has; instruments write what they know of a recording
/// above it. Nothing if there is none in the first 200 lines.
std::optional<std::size_t> line_of_later_header(std::string_view text);

}  // namespace kinesphere::program
