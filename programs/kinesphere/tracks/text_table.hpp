// Reads tables in text files: any separator, quoted or not, with or without a header.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kinesphere::program {

/// One row of a table. Its fields are valid until the next row is read.
struct TableRow {
  int line = 0;  ///< first line, counted from 1
  std::vector<std::string_view> fields;
};

/// Reads a table row by row.
/// The separator is the first of ; , tab outside quotes in the first row, else blanks. Fields are quoted as
/// in RFC 4180: separators and line ends in quotes belong to the field, and two quotes in a row are one.
/// Blanks around fields are dropped. Lines end with LF or CRLF; a byte order mark, empty lines, and lines
/// that begin with # are skipped. The first row is the header if no field of it is a number. Without one, the
/// last comment before it is the header if it has one word, or field, for each column.
class TextTable {
 public:
  /// Reads up to the first row of values. Throws ProgramError naming file and line as next() does, and if
  /// there is no row of values.
  TextTable(std::string text, std::string file);
  TextTable(const TextTable&) = delete;
  TextTable& operator=(const TextTable&) = delete;

  const std::string& file() const { return file_; }
  /// Lines that begin with #, without it, before the first row.
  const std::vector<std::string_view>& comments() const { return comments_; }
  /// Names of the columns; empty if the file has no header.
  const std::vector<std::string>& header() const { return header_; }
  std::size_t columns() const { return columns_; }
  const TableRow& first_row() const { return first_; }

  /// Reads the next row, beginning with the first; returns false after the last. Throws ProgramError naming
  /// file, line and column if a row has more or fewer fields than the first, or for wrong quotes: unclosed,
  /// inside an unquoted field, or followed by text.
  bool next(TableRow& row);

 private:
  /// Throws ProgramError for the current field.
  [[noreturn]] void fail(int line, std::size_t column, std::string_view reason) const;
  /// Returns the next line, comments included, without its end; empty at the end of the text.
  std::string_view line_ahead() const;
  void skip_line();
  /// Skips to the next line that is a row; returns false at the end.
  bool skip_to_row();
  bool read_row(TableRow& row);
  std::string_view read_field(int line, std::size_t column);
  std::string_view read_quoted(int line, std::size_t column);
  void read_header();

  std::string text_;
  std::string file_;
  std::string_view rest_;
  int line_ = 1;
  char separator_ = ' ';
  std::size_t columns_ = 0;
  std::vector<std::string_view> comments_;
  std::vector<std::string> header_;
  TableRow first_;
  bool first_is_ahead_ = true;
  std::deque<std::string> unquoted_;        ///< fields of the current row that had doubled quotes
  std::deque<std::string> first_unquoted_;  ///< unquoted fields of the first row, which is kept
};

}  // namespace kinesphere::program
