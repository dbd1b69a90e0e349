// A recording as rows of named fields, each row with its line in the file.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/tables/table_columns.hpp"

namespace kinesphere::program {

/// Gathers the fields of rows. A row has few of many columns, or all; the others are empty.
class RowTable {
 public:
  RowTable() = default;
  explicit RowTable(std::string title) : format(std::move(title)) {}
  RowTable(std::string title, std::initializer_list<std::string_view> columns) : format(std::move(title)) {
    for (const std::string_view name : columns) column_of(name);
  }

  std::string format;  ///< for the summary
  std::vector<std::string> warnings;
  bool is_one_body = false;  ///< all rows are of one body, called like the file
  TableColumns::Place place_on_body = TableColumns::Place::middle;  ///< where on a body its position is

  const std::vector<std::string>& names() const { return names_; }
  std::size_t size() const { return rows_.size(); }
  /// Returns the line of a row in the file, from 1.
  std::size_t line(std::size_t row) const { return rows_[row].line; }
  /// Returns the fields of a row, one for each name, valid until the table changes.
  void read(std::size_t row, std::vector<std::string_view>& fields) const;

  /// Returns the column of this name, which is added if there is none.
  std::size_t column_of(std::string_view name);
  void begin_row(std::size_t line) { rows_.push_back({line, fields_.size()}); }
  /// Sets what the last row has in a column: a text, on one line, or a number, with all its digits. The last
  /// text of a column counts.
  template <class Value>
  void set(std::size_t column, const Value& value) {
    const auto begin = static_cast<std::ptrdiff_t>(text_.size());
    if constexpr (std::is_convertible_v<const Value&, std::string_view>)
      text_.append(std::string_view(value));
    else
      fmt::format_to(std::back_inserter(text_), "{}", value);
    std::replace_if(
        text_.begin() + begin, text_.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    fields_.push_back({column, text_.size()});
  }
  /// Adds a row with the values of the first columns.
  template <class... Values>
  void add_row(std::size_t line, const Values&... values) {
    begin_row(line);
    std::size_t column = 0;
    (set(column++, values), ...);
  }
  /// Returns the name for its first track, and "name (2)" and so on for the next: two walks of a day may be
  /// called alike, at the same times or not.
  std::string label(const std::string& name) {
    const std::size_t count = ++labels_[name];
    return count == 1 ? name : fmt::format("{} ({})", name, count);
  }
  /// Leaves the column of heights, which has to be the last one, out unless all rows have one; if some have,
  /// a warning says so.
  void use_heights_of_all(const std::string& file);
  /// Forgets all rows, and the names behind the first `count`.
  void forget(std::size_t count);

 private:
  struct Row {
    std::size_t line, first;  ///< first of fields_
  };
  struct Field {
    std::size_t column, end;  ///< where its text ends; it begins where that of the field before ends
  };

  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> columns_;
  std::unordered_map<std::string, std::size_t> labels_;  ///< how many tracks have asked for each name
  std::vector<Row> rows_;
  std::vector<Field> fields_;
  std::string text_;
};

}  // namespace kinesphere::program
