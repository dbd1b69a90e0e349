// Lines of a text, and the words and fields of a line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/ascii_text.hpp"

namespace kinesphere::program {

/// Cuts lines off the front of a text and counts them.
class LineCutter {
 public:
  explicit LineCutter(std::string_view text) : rest_(text) {}

  /// Returns the next line without its end; nothing at the end of the text.
  std::optional<std::string_view> next();
  /// Line of the last result of next(), from 1.
  std::size_t line() const { return line_; }
  /// True if the last line had an end: a file that was cut off may lack it.
  bool has_end() const { return has_end_; }

 private:
  std::string_view rest_;
  std::size_t line_ = 0;
  bool has_end_ = true;
};

/// Returns the part before the next separator, and cuts both off the front of a text.
inline std::string_view take_part(std::string_view& rest, char separator) {
  const std::string_view part = rest.substr(0, rest.find(separator));
  rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  return part;
}
/// True if a word, in any case, is one of those in a list, between blanks.
inline bool is_word_of(std::string_view word, std::string_view words) {
  while (!words.empty())
    if (same_name(take_part(words, ' '), word)) return true;
  return false;
}
/// Returns the parts between blanks.
std::vector<std::string_view> words_of(std::string_view line);
/// Returns the parts between separators, without blanks around them; between blanks as words_of(), but at
/// least one.
std::vector<std::string_view> fields_of(std::string_view line, char separator);
/// Returns "3" as a count; nothing for other text.
std::optional<std::size_t> count_in(std::string_view text);

}  // namespace kinesphere::program
