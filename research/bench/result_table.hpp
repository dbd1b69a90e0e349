// A table of results: aligned on the terminal, and as a CSV file.
#pragma once

#include <string>
#include <vector>

#include "base/table_file.hpp"

namespace kinesphere::program {

class ResultTable {
 public:
  /// `columns` has the names in the CSV file; on the terminal underscores become blanks.
  explicit ResultTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Adds a row. Precondition: there is one cell for each column.
  void row(std::vector<Cell> cells);

  /// Returns the table with numbers of four digits on the right and text on the left.
  std::string text() const;
  /// Saves the table as a CSV file. Throws ProgramError.
  void save(const std::string& path) const;

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace kinesphere::program
