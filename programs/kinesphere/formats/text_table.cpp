// Reads tables in text files: any separator, quoted or not, with or without a header.
#include "formats/text_table.hpp"

#include <fmt/format.h>

#include <utility>

#include "ascii_text.hpp"
#include "formats/file_kind.hpp"
#include "program_error.hpp"

namespace kinesphere::program {

TextTable::TextTable(std::string text, std::string file) : text_(std::move(text)), reader_(std::move(file)) {
  rows_.begin(text_);
  if (const std::string other = other_file_kind(text_); !other.empty())
    throw ProgramError(fmt::format("{}: expected a table in a text file, but it is {}", this->file(), other));
  if (text_.starts_with("\xEF\xBB\xBF")) rows_.begin(std::string_view(text_).substr(3));
  if (text_.find('\0') != std::string::npos)
    throw ProgramError(fmt::format("{}: expected a text file, but it has zero bytes", this->file()));
  bool is_complete = false;
  while (!is_complete && skip_to_row()) {
    if (columns_ == 0) {
      rows_.set_separator(separator_of(rows_.rest()));
      reader_.set_separator(rows_.separator());
    }
    read_row(first_);
    columns_ = first_.fields.size();
    is_complete = reader_.row(first_.fields);
  }
  if (!is_complete)
    throw ProgramError(fmt::format("{}: expected rows of numbers, but found none", this->file()));
  first_unquoted_ = rows_.take_unquoted();
}

bool TextTable::next(TableRow& row) {
  if (std::exchange(first_is_ahead_, false)) {
    row = first_;
    return true;
  }
  if (!skip_to_row()) return false;
  read_row(row);
  return true;
}

bool TextTable::skip_to_row() {
  while (!rows_.rest().empty()) {
    const std::string_view content = trimmed(rows_.line_ahead());
    if (!content.empty() && !content.starts_with('#')) return true;
    if (!content.empty() && first_is_ahead_) reader_.comment(content.substr(1));
    rows_.skip_line();
  }
  return false;
}

void TextTable::read_row(TableRow& row) {
  row.line = rows_.line();
  try {
    rows_.read(row.fields);
  } catch (const WrongInput& error) {
    throw ProgramError(fmt::format("{}:{}: {}", file(), row.line, error.what()));
  }
  if (columns_ != 0 && row.fields.size() != columns_)
    throw ProgramError(
        fmt::format("{}:{}: expected {} columns, but got {}", file(), row.line, columns_, row.fields.size()));
}

}  // namespace kinesphere::program
