// The rows that count: --where 'EXPRESSION'.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/tables/table_head.hpp"

namespace kinesphere::program {

struct TableColumns;

/// Comparisons of columns with values, joined by `and`, `or`, `not` and brackets: visible != false and
/// (id > 0 or "v class" = 'car, red'). A column is named as in the header, by a key of --columns or by its
/// number from 1; names and values with other characters than letters, digits, _ - + . : are quoted.
/// Operators: = != < <= > >=. Two numbers are compared as numbers, texts without regard to case. An order of
/// what is no number is false.
class RowFilter {
 public:
  RowFilter() = default;
  /// Throws ProgramError naming `option` and what was expected. An empty text takes all rows.
  RowFilter(const std::string& text, const TableHead& head, const TableColumns& columns,
            std::string_view option = "--where");

  bool takes(const std::vector<std::string_view>& fields) const;
  /// True if the expression compares this column.
  bool mentions(std::size_t column) const;
  const std::string& text() const { return text_; }

 private:
  struct Node;
  class Parser;

  std::string text_;
  std::shared_ptr<const Node> root_;
  std::vector<std::size_t> mentioned_;
};

/// Returns the text as an expression between the single quotes of a shell has it: in double quotes where it
/// has other signs than those of a word.
std::string name_in_filter(const std::string& text);

}  // namespace kinesphere::program
