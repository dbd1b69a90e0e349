// Reads tables in text files: any separator, quoted or not, with or without a header.
#include "formats/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ascii_text.hpp"

namespace kinesphere::program {

const std::vector<std::string_view>* TextTable::read(const Record& record) {
  if (!record.is_whole) throw WrongInput("expected a line, but it is too long");
  std::string_view text = record.text;
  if (record.line == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::string_view content = trimmed(text);
  if (content.empty()) return nullptr;
  if (!has_begun_) beginning_.emplace_back(text);
  if (content.starts_with('#')) {
    if (!has_begun_) head_.comment(content.substr(1));
    return nullptr;
  }
  if (columns_ == 0) {
    row_.set_separator(separator_of(text));
    head_.set_separator(row_.separator());
  }
  row_.begin(text);
  row_.read(fields_);
  if (columns_ == 0) columns_ = fields_.size();
  if (has_equal_rows_ && fields_.size() != columns_)
    throw WrongInput(fmt::format("expected {} columns, but got {}", columns_, fields_.size()));
  if (!has_begun_) has_begun_ = head_.row(fields_);
  const auto& names = head().names;
  return has_begun_ && !std::equal(fields_.begin(), fields_.end(), names.begin(), names.end()) ? &fields_
                                                                                               : nullptr;
}

}  // namespace kinesphere::program
