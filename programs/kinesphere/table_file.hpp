// Rows of named values, as CSV or as JSON lines, by the ending of the file's name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "output_file.hpp"

namespace kinesphere::program {

/// A decimal number with just these digits.
struct DecimalText {
  std::string digits;
};

/// One value of a row; std::monostate is an empty field (CSV) or null (JSON).
using Cell = std::variant<std::monostate, double, std::uint64_t, bool, std::string, DecimalText>;

enum class TableFormat { csv, json_lines };

/// Throws ProgramError when the name ends in neither .csv nor .jsonl.
TableFormat table_format_of(const std::string& path);

/// Numbers are written with as few digits as bring back the same bits. Throws ProgramError as OutputFile
/// does, and as table_format_of().
class TableFile {
 public:
  TableFile(const std::string& path, std::vector<std::string> columns);
  /// For names with other endings, and for tables that an earlier run has begun.
  TableFile(TableFormat format, OutputPlace place, std::vector<std::string> columns);

  /// One cell for each column.
  void write(std::span<const Cell> cells);
  /// As OutputFile::sync().
  std::uint64_t sync() { return file_.sync(); }
  void commit() { file_.commit(); }

 private:
  TableFormat format_;
  std::vector<std::string> columns_;
  OutputFile file_;
};

}  // namespace kinesphere::program
