// Splits text into rows of fields.
#include "formats/tables/row_splitter.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"

namespace kinesphere::program {
namespace {

[[noreturn]] void fail_in(std::size_t column, std::string_view reason) {
  throw WrongInput(fmt::format("{} (column {})", reason, column));
}

}  // namespace

char separator_of(std::string_view text) {
  std::string outside;  // the text outside quotes
  bool quoted = false;
  for (char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '\n') break;
    outside += c;
  }
  for (char separator : {';', ',', '\t', '|'})
    if (trimmed(outside).find(separator) != std::string_view::npos) return separator;
  return ' ';
}

void RowSplitter::begin(std::string_view text) {
  rest_ = text;
  unquoted_.clear();
}

/// A row ends at a line end outside quotes.
void RowSplitter::read(std::vector<std::string_view>& fields) {
  fields.clear();
  unquoted_.clear();
  std::string_view line = line_ahead();
  if (separator_ != ' ' && line.find('"') == std::string_view::npos) {
    for (std::size_t end = line.find(separator_); end != std::string_view::npos;
         end = line.find(separator_)) {
      fields.push_back(trimmed(line.substr(0, end)));
      line.remove_prefix(end + 1);
    }
    fields.push_back(trimmed(line));
    return;
  }
  for (;;) {
    fields.push_back(read_field(fields.size() + 1));
    const std::string_view ahead = line_ahead();
    const bool more = separator_ == ' ' ? !trimmed(ahead).empty() : !ahead.empty();
    if (!more) break;
    if (separator_ != ' ') rest_.remove_prefix(1);
  }
}

std::size_t RowSplitter::end_of_field(std::string_view line) const {
  return std::min(separator_ == ' ' ? line.find_first_of(blanks) : line.find(separator_), line.size());
}

/// Reads up to the separator or the end of the line.
std::string_view RowSplitter::read_field(std::size_t column) {
  std::string_view ahead = line_ahead();
  const std::size_t blank =
      std::min(ahead.find_first_not_of(separator_ == '\t' ? " \r" : blanks), ahead.size());
  if (ahead.substr(blank).starts_with('"')) {
    rest_.remove_prefix(blank + 1);
    return read_quoted(column);
  }
  if (separator_ == ' ') {
    rest_.remove_prefix(blank);
    ahead.remove_prefix(blank);
  }
  const std::size_t end = end_of_field(ahead);
  const std::string_view field = trimmed(ahead.substr(0, end));
  if (separator_ != ' ' && field.find('"') != std::string_view::npos)
    fail_in(column, "expected quotes only around a whole field");
  rest_.remove_prefix(end);
  return field;
}

/// Reads from behind the opening quote to behind the blanks after the closing one.
std::string_view RowSplitter::read_quoted(std::size_t column) {
  const std::string_view begin = rest_;
  std::size_t at = 0;
  std::string* doubled = nullptr;  // the field without its doubled quotes; null if it has none
  std::size_t copied = 0;
  for (;;) {
    at = begin.find('"', at);
    if (at == std::string_view::npos) fail_in(column, "expected a quote that ends the quoted field");
    if (!begin.substr(at + 1).starts_with('"')) break;
    if (doubled == nullptr) doubled = &unquoted_.emplace_back();
    doubled->append(begin.substr(copied, at + 1 - copied));
    copied = at += 2;
  }
  std::string_view field = begin.substr(0, at);
  if (doubled != nullptr) field = doubled->append(begin.substr(copied, at - copied));
  rest_.remove_prefix(at + 1);
  const std::string_view after = line_ahead();
  const std::size_t end = end_of_field(after);
  if (!trimmed(after.substr(0, end)).empty()) fail_in(column, "expected a separator after the quoted field");
  rest_.remove_prefix(end);
  return field;
}

}  // namespace kinesphere::program
