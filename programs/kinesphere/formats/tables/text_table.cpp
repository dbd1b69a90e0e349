// Reads tables in text files: any separator, quoted or not, with or without a header.
#include "formats/tables/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"

namespace kinesphere::program {
namespace {

/// Returns what follows the sign of a comment; nothing for another line.
std::optional<std::string_view> comment_in(std::string_view line) {
  for (std::string_view sign : {"#", "%", "//"})
    if (line.starts_with(sign)) return line.substr(sign.size());
  return std::nullopt;
}

/// True for the line "sep=;", with which Excel is told the separator.
bool says_separator(std::string_view line) {
  return line.size() == 5 && same_name(line.substr(0, 4), "sep=");
}

/// True for a line that is drawn below a header, as psql and Markdown have it: ---+---, |:--|--:|.
bool is_rule(std::string_view line) {
  return line.find_first_not_of("-+|=: \t") == std::string_view::npos &&
         (line.find("--") != std::string_view::npos || line.find("==") != std::string_view::npos);
}

/// True for fields behind a quoted number of their row, for which the header has no name, as R's write.table
/// writes them.
bool have_row_name(const std::vector<std::string_view>& fields, std::string_view row, char separator) {
  return (separator == ' ' || separator == '\t') && row.starts_with('"') && parse_number(fields.front());
}

}  // namespace

const std::vector<std::string_view>* TextTable::read(const Record& record) {
  if (!record.is_whole) throw WrongInput("expected a whole line, but it is too long or cut off");
  std::string_view text = record.text;
  // Files that were put together have it in the middle, too.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::string_view content = trimmed(text);
  if (content.empty() || is_rule(content)) return nullptr;
  const bool has_begun = head_.is_complete();
  if (!has_begun) beginning_.emplace_back(text);
  if (const auto comment = comment_in(content)) {
    if (!has_begun) head_.comment(*comment);
    return nullptr;
  }
  if (columns_ == 0 && says_separator(content)) return nullptr;
  if (columns_ == 0) {
    row_.set_separator(separator_of(text));
    head_.set_separator(row_.separator());
  }
  row_.begin(text);
  row_.read(fields_);
  if (columns_ == 0) columns_ = fields_.size();
  if (fields_.size() == columns_ + 1 && !head().names.empty()) {
    if (fields_.back().empty()) {
      fields_.pop_back();
    } else if (!has_begun && have_row_name(fields_, content, row_.separator())) {
      head_.add_row_names();
      ++columns_;
    }
  }
  if (has_equal_rows_ && fields_.size() != columns_)
    throw WrongInput(fmt::format(
        "expected {} columns{}, but got {}{}", columns_, has_begun ? "" : " as in the first line",
        fields_.size(), has_begun ? "" : " (lines above the header have to be left out or begin with #)"));
  return head_.row(fields_) ? &fields_ : nullptr;
}

}  // namespace kinesphere::program
