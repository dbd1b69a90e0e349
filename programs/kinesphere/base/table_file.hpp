// Rows of named values, as CSV or as JSON lines, by the ending of the file's name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/output_file.hpp"

namespace kinesphere::program {

/// A decimal number that is written with exactly these digits.
struct DecimalText {
  std::string digits;
};

/// One value of a row; std::monostate is an empty field (CSV) or null (JSON).
using Cell = std::variant<std::monostate, double, std::uint64_t, bool, std::string, DecimalText>;

enum class TableFormat { csv, json_lines };

/// Throws ProgramError if the name ends in neither .csv nor .jsonl.
TableFormat table_format_of(const std::string& path);

/// Writes rows. Numbers have the fewest digits that read back as the same double. Throws ProgramError like
/// OutputFile and table_format_of().
class TableFile {
 public:
  TableFile(const std::string& path, std::vector<std::string> columns);
  /// For a table whose columns are not known yet, so that a wrong path fails before a long run: call begin()
  /// before write().
  explicit TableFile(const std::string& path);
  /// For names with other endings, and for tables that an earlier run began.
  TableFile(TableFormat format, OutputPlace place, std::vector<std::string> columns);

  /// Writes the names of the columns, but not to a table that an earlier run began.
  void begin(std::vector<std::string> columns);
  /// Writes a row. Precondition: one cell for each column.
  void write(std::span<const Cell> cells);
  /// Calls OutputFile::sync().
  std::uint64_t sync() { return file_.sync(); }
  void commit() { file_.commit(); }

 private:
  TableFormat format_;
  std::vector<std::string> columns_;
  OutputFile file_;
};

}  // namespace kinesphere::program
