// A table of results: aligned on the terminal, and as a CSV file.
#pragma once

#include <string>
#include <vector>

#include "table_file.hpp"

namespace kinesphere::program {

class ResultTable {
 public:
  /// Columns by their names in the CSV file; on the terminal underscores are blanks.
  explicit ResultTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// One cell for each column.
  void row(std::vector<Cell> cells);

  /// Numbers with four digits and on the right, text on the left.
  std::string text() const;
  /// Throws ProgramError.
  void save(const std::string& path) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace kinesphere::program
