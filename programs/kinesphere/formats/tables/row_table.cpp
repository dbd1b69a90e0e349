// A recording as rows of named fields, each row with its line in the file.
#include "formats/tables/row_table.hpp"

namespace kinesphere::program {

void RowTable::read(std::size_t row, std::vector<std::string_view>& fields) const {
  fields.assign(names_.size(), {});
  const std::size_t end = row + 1 < rows_.size() ? rows_[row + 1].first : fields_.size();
  for (std::size_t k = rows_[row].first; k < end; ++k) {
    const std::size_t begin = k == 0 ? 0 : fields_[k - 1].end;
    if (fields_[k].column < fields.size())
      fields[fields_[k].column] = std::string_view(text_).substr(begin, fields_[k].end - begin);
  }
}

std::size_t RowTable::column_of(std::string_view name) {
  const auto [place, is_new] = columns_.emplace(name, names_.size());
  if (is_new) names_.emplace_back(name);
  return place->second;
}

void RowTable::use_heights_of_all(const std::string& file) {
  std::vector<std::string_view> fields;
  std::size_t with_height = 0;
  for (std::size_t row = 0; row < size(); ++row) {
    read(row, fields);
    with_height += fields.back().empty() ? 0 : 1;
  }
  if (with_height == size()) return;
  if (with_height > 0)
    warnings.push_back(
        fmt::format("{}: some points have no height ({}), so that none is used", file, names_.back()));
  columns_.erase(names_.back());
  names_.pop_back();
}

void RowTable::forget(std::size_t count) {
  rows_.clear();
  fields_.clear();
  text_.clear();
  for (; names_.size() > count; names_.pop_back()) columns_.erase(names_.back());
}

}  // namespace kinesphere::program
