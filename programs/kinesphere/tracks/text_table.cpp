// Reads tables in text files: any separator, quoted or not, with or without a header.
#include "tracks/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ascii_text.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// Returns the separator of the first row of `text`.
char separator_of(std::string_view text) {
  std::string outside;  // the text outside quotes
  bool quoted = false;
  for (char c : text) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '\n') break;
    outside += c;
  }
  for (char separator : {';', ',', '\t'}) {
    if (trimmed(outside).find(separator) != std::string_view::npos) return separator;
  }
  return ' ';
}

/// Returns the parts of a comment; `separator` is that of the table.
std::vector<std::string> parts_of(std::string_view line, char separator) {
  std::vector<std::string> parts;
  const std::string_view between = separator == ' ' ? blanks : std::string_view(&separator, 1);
  while (!line.empty()) {
    const std::string_view part = line.substr(0, line.find_first_of(between));
    line.remove_prefix(std::min(part.size() + 1, line.size()));
    if (separator != ' ' || !part.empty()) parts.emplace_back(trimmed(part));
  }
  return parts;
}

}  // namespace

TextTable::TextTable(std::string text, std::string file)
    : text_(std::move(text)), file_(std::move(file)), rest_(text_) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  if (rest_.find('\0') != std::string_view::npos)
    throw ProgramError(fmt::format("{}: expected a text file, but it has zero bytes", file_));
  if (skip_to_row()) {
    separator_ = separator_of(rest_);
    columns_ = 0;
    read_row(first_);
    columns_ = first_.fields.size();
    read_header();
  }
  if (first_.fields.empty())
    throw ProgramError(fmt::format("{}: expected rows of numbers, but found none", file_));
  std::swap(first_unquoted_, unquoted_);
}

void TextTable::read_header() {
  const auto is_number = [](std::string_view field) { return parse_number(field).has_value(); };
  if (std::none_of(first_.fields.begin(), first_.fields.end(), is_number)) {
    header_.assign(first_.fields.begin(), first_.fields.end());
    // Errors contain the names, and are one line.
    for (std::string& name : header_)
      std::replace_if(
          name.begin(), name.end(), [](char c) { return c == '\r' || c == '\n'; }, ' ');
    first_.fields.clear();
    if (skip_to_row()) read_row(first_);
    return;
  }
  if (comments_.empty()) return;
  for (char separator : {' ', separator_}) {
    std::vector<std::string> parts = parts_of(comments_.back(), separator);
    if (parts.size() != columns_) continue;
    header_ = std::move(parts);
    return;
  }
}

bool TextTable::next(TableRow& row) {
  if (std::exchange(first_is_ahead_, false)) {
    row = first_;
    return true;
  }
  return skip_to_row() && read_row(row);
}

void TextTable::fail(int line, std::size_t column, std::string_view reason) const {
  throw ProgramError(fmt::format("{}:{}: {} (column {})", file_, line, reason, column));
}

std::string_view TextTable::line_ahead() const { return rest_.substr(0, rest_.find('\n')); }

void TextTable::skip_line() {
  rest_.remove_prefix(std::min(line_ahead().size() + 1, rest_.size()));
  ++line_;
}

bool TextTable::skip_to_row() {
  while (!rest_.empty()) {
    const std::string_view content = trimmed(line_ahead());
    if (!content.empty() && !content.starts_with('#')) return true;
    if (!content.empty() && first_is_ahead_) comments_.push_back(trimmed(content.substr(1)));
    skip_line();
  }
  return false;
}

/// A row ends at a line end outside quotes.
bool TextTable::read_row(TableRow& row) {
  row.line = line_;
  row.fields.clear();
  unquoted_.clear();
  for (;;) {
    row.fields.push_back(read_field(row.line, row.fields.size() + 1));
    const std::string_view ahead = line_ahead();
    const bool more = separator_ == ' ' ? !trimmed(ahead).empty() : !ahead.empty();
    if (!more) break;
    if (separator_ != ' ') rest_.remove_prefix(1);
  }
  skip_line();
  if (columns_ != 0 && row.fields.size() != columns_) {
    throw ProgramError(
        fmt::format("{}:{}: expected {} columns, but got {}", file_, row.line, columns_, row.fields.size()));
  }
  return true;
}

/// Reads up to the separator or the end of the line.
std::string_view TextTable::read_field(int line, std::size_t column) {
  std::string_view ahead = line_ahead();
  const std::size_t blank =
      std::min(ahead.find_first_not_of(separator_ == '\t' ? " \r" : blanks), ahead.size());
  if (ahead.substr(blank).starts_with('"') && separator_ != ' ') {
    rest_.remove_prefix(blank + 1);
    return read_quoted(line, column);
  }
  if (separator_ == ' ') {
    rest_.remove_prefix(blank);
    ahead.remove_prefix(blank);
  }
  const std::size_t end =
      std::min(separator_ == ' ' ? ahead.find_first_of(blanks) : ahead.find(separator_), ahead.size());
  const std::string_view field = trimmed(ahead.substr(0, end));
  if (separator_ != ' ' && field.find('"') != std::string_view::npos)
    fail(line, column, "expected quotes only around a whole field");
  rest_.remove_prefix(end);
  return field;
}

/// Reads from behind the opening quote to behind the blanks after the closing one.
std::string_view TextTable::read_quoted(int line, std::size_t column) {
  const std::string_view begin = rest_;
  std::size_t at = 0;
  std::string* doubled = nullptr;  // the field without its doubled quotes; null if it has none
  std::size_t copied = 0;
  for (;;) {
    at = begin.find('"', at);
    if (at == std::string_view::npos) fail(line, column, "expected a quote that ends the quoted field");
    if (!begin.substr(at + 1).starts_with('"')) break;
    if (doubled == nullptr) doubled = &unquoted_.emplace_back();
    doubled->append(begin.substr(copied, at + 1 - copied));
    copied = at += 2;
  }
  std::string_view field = begin.substr(0, at);
  if (doubled != nullptr) field = doubled->append(begin.substr(copied, at - copied));
  line_ += static_cast<int>(std::count(begin.begin(), begin.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  rest_.remove_prefix(at + 1);
  const std::string_view after = line_ahead();
  const std::size_t end = std::min(after.find(separator_), after.size());
  if (!trimmed(after.substr(0, end)).empty())
    fail(line, column, "expected a separator after the quoted field");
  rest_.remove_prefix(end);
  return field;
}

}  // namespace kinesphere::program
