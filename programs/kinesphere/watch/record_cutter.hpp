// Cuts the text of a stream into records: lines, or JSON documents that may go over several lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kinesphere::program {

struct Record {
  std::string_view text;   ///< valid until the next call; without the end of its line
  std::size_t line = 0;    ///< where it begins, from 1
  bool is_whole = true;    ///< otherwise it ends too early, or is longer than what is read
  std::size_t behind = 0;  ///< so many bytes have been fed since it began
};

/// Of JSON, each object that is not inside of another is a record, whatever stands between it and the next: a
/// line's end or nothing. One that is cut off does not take what follows along: no text goes on behind a
/// line's end, and a line that begins with {"now" or {"time" begins a document.
class RecordCutter {
 public:
  enum class Kind { lines, documents };
  /// Longer ones are not kept: bytes.
  static constexpr std::size_t longest_line = std::size_t{1} << 20;
  static constexpr std::size_t longest_document = std::size_t{1} << 26;

  explicit RecordCutter(Kind kind = Kind::lines) : kind_(kind) {}

  void feed(std::string_view text);
  /// The next one that has come in whole.
  std::optional<Record> next();
  /// When there is no more text: what is left, once next() has nothing.
  std::optional<Record> rest();
  /// Text that has come in, and has not been cut yet.
  std::string_view waiting() const { return std::string_view(text_).substr(begin_); }
  /// Where waiting() begins.
  struct Line {
    std::size_t number = 1;
    bool is_passed_over = false;  ///< it is too long, and has begun before
  };
  Line line() const { return {line_, skips_line_}; }
  /// To be set before the first record is cut: when text is fed from there on.
  void begin_at(const Line& line) {
    line_ = line.number;
    skips_line_ = line.is_passed_over;
  }
  /// To be set before the first record is cut.
  void set_kind(Kind kind) { kind_ = kind; }

 private:
  std::optional<Record> next_line();
  std::optional<Record> next_document();
  /// What begins at begin_ and ends before `end`; what follows begins at `next`.
  Record cut(std::size_t end, std::size_t next, bool is_whole = true);
  bool begins_document(std::size_t at, bool& unknown) const;

  Kind kind_;
  std::string text_;
  std::size_t begin_ = 0;  ///< of the record
  std::size_t at_ = 0;     ///< what lies before has been looked at
  std::size_t line_ = 1;   ///< of begin_
  bool skips_line_ = false;
  // Of a document.
  int depth_ = 0;
  bool in_text_ = false;
  bool escaped_ = false;
};

}  // namespace kinesphere::program
