// Cuts text into records: lines, rows of a table or JSON documents, both of which may go over several lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

struct Record {
  std::string_view text;   ///< valid until the next call; without the end of its line
  std::size_t line = 0;    ///< first line, counted from 1
  bool is_whole = true;    ///< otherwise it ends too early, or is longer than what is read
  std::size_t behind = 0;  ///< bytes fed since its begin
  /// When it was read, if it came in then: for text that its sender writes while it is read. Unit: seconds
  /// since 1970.
  std::optional<FileTime> read_at{};
};

/// Cuts records. In JSON each outermost object is a record; a line end or nothing may separate two. A
/// truncated document does not swallow the next: no text continues after a line end, and a line that begins
/// with {"now", {"time", {"ac" or {"aircraft" begins a document. Rows go on behind line ends in quotes, which
/// a stream, where one damaged quote would take all later lines along, does not allow. The whole text may be
/// one record.
class RecordCutter {
 public:
  enum class Kind { lines, rows, documents, whole };
  /// Bytes. Longer lines are dropped, but not longer rows.
  static constexpr std::size_t longest_line = std::size_t{1} << 20;
  static constexpr std::size_t longest_document = std::size_t{1} << 26;

  explicit RecordCutter(Kind kind = Kind::lines) : kind_(kind) {}

  void feed(std::string_view text);
  /// Returns the next complete record; nothing if more text is needed.
  std::optional<Record> next();
  /// Returns the remaining text as a record. Precondition: no later text continues it, and next() returned
  /// nothing.
  std::optional<Record> rest();
  /// Text that was fed and has not been cut.
  std::string_view waiting() const { return std::string_view(text_).substr(begin_); }
  /// The line in which waiting() begins.
  struct Line {
    std::size_t number = 1;
    bool is_passed_over = false;  ///< it is too long, and has begun before
  };
  Line line() const { return {line_, skips_line_}; }
  /// Sets the line of the next text. Precondition: no record has been cut.
  void begin_at(const Line& line) {
    line_ = line.number;
    skips_line_ = line.is_passed_over;
  }
  /// Precondition: no record has been cut.
  void set_kind(Kind kind) { kind_ = kind; }

 private:
  std::optional<Record> next_line();
  std::optional<Record> next_row();
  std::optional<Record> next_document();
  /// Returns the record from begin_ to `end`; the next one begins at `next`.
  Record cut(std::size_t end, std::size_t next, bool is_whole = true);
  bool begins_document(std::size_t at, bool& unknown) const;

  Kind kind_;
  std::string text_;
  std::size_t begin_ = 0;  ///< begin of the record
  std::size_t at_ = 0;     ///< end of the examined text
  std::size_t line_ = 1;   ///< line of begin_
  bool skips_line_ = false;
  // Depth of nested braces in a document.
  int depth_ = 0;
  bool in_text_ = false;  ///< in quotes
  bool escaped_ = false;
  std::optional<bool> has_quotes_;  ///< of rows: fields may be quoted, as those between blanks may not
};

}  // namespace kinesphere::program
