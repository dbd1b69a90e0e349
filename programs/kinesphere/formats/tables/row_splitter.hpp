// Splits text into rows of fields.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "formats/fields/wrong_input.hpp"

namespace kinesphere::program {

/// Returns the first of ; , tab | outside quotes in the first row of `text`, else a blank.
char separator_of(std::string_view text);

/// Splits rows. Fields are quoted as in RFC 4180: separators and line ends in quotes belong to the field, and
/// two quotes in a row are one. Blanks around fields are dropped. Lines end with LF or CRLF.
class RowSplitter {
 public:
  /// Begins with this text, which must outlive the fields.
  void begin(std::string_view text);
  void set_separator(char separator) { separator_ = separator; }
  char separator() const { return separator_; }
  /// Reads a row. Its fields are valid until the next call of read() or begin(). Throws WrongInput for wrong
  /// quotes: unclosed, inside an unquoted field, or followed by text.
  void read(std::vector<std::string_view>& fields);

 private:
  /// Returns the next line without its end; empty at the end of the text.
  std::string_view line_ahead() const { return rest_.substr(0, rest_.find('\n')); }
  /// Returns where the field at the beginning of `line` ends.
  std::size_t end_of_field(std::string_view line) const;
  std::string_view read_field(std::size_t column);
  std::string_view read_quoted(std::size_t column);

  std::string_view rest_;
  char separator_ = ' ';
  std::deque<std::string> unquoted_;  ///< fields that had doubled quotes
};

}  // namespace kinesphere::program
