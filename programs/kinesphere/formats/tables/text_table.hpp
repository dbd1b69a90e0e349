// Reads tables in text files: any separator, quoted or not, with or without a header.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/tables/record_cutter.hpp"
#include "formats/tables/row_splitter.hpp"
#include "formats/tables/table_head.hpp"

namespace kinesphere::program {

/// Reads a table record by record, as RowSplitter splits rows and TableHeadReader finds the header. A byte
/// order mark, blank lines, comments (lines that begin with #, % or //), the line "sep=;" of Excel, and
/// headers of files that were appended are passed over. So is an empty field behind the last name, and a name
/// of each row before the first becomes a column without a name.
class TextTable {
 public:
  /// `has_equal_rows`: each row has as many fields as the first.
  TextTable(std::string file, bool has_equal_rows)
      : head_(std::move(file)), has_equal_rows_(has_equal_rows) {}

  /// Returns the fields of a row of values, valid until the next call; null for another record. Throws
  /// WrongInput.
  const std::vector<std::string_view>* read(const Record& record);
  /// Complete with the first row of values.
  const TableHead& head() const { return head_.head(); }
  /// Returns the records up to the first row of values, from which another reader may begin.
  const std::vector<std::string>& beginning() const { return beginning_; }

 private:
  TableHeadReader head_;
  bool has_equal_rows_;
  std::size_t columns_ = 0;
  std::vector<std::string> beginning_;
  RowSplitter row_;
  std::vector<std::string_view> fields_;
};

}  // namespace kinesphere::program
