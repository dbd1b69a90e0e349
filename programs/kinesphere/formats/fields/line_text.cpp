// Cuts texts into lines, words and fields.
#include "formats/fields/line_text.hpp"

#include <algorithm>
#include <charconv>

namespace kinesphere::program {

std::optional<std::string_view> LineCutter::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t all = rest_.size();
  const std::string_view line = take_part(rest_, '\n');
  has_end_ = line.size() < all;
  ++line_;
  return trimmed(line);
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    if (line.empty()) return words;
    words.push_back(line.substr(0, line.find_first_of(blanks)));
    line.remove_prefix(words.back().size());
  }
}

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  if (separator == ' ') {
    fields = words_of(line);
    if (fields.empty()) fields.emplace_back();
    return fields;
  }
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::optional<std::size_t> count_in(std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return count;
}

}  // namespace kinesphere::program
