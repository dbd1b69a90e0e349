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

/// Numbers are written with as few digits as bring back the same bits. Throws ProgramError as OutputFile
/// does, and when the name ends in neither .csv nor .jsonl.
class TableFile {
 public:
  TableFile(const std::string& path, std::vector<std::string> columns);

  /// One cell for each column.
  void write(std::span<const Cell> cells);
  void commit() { file_.commit(); }

 private:
  enum class Format { csv, json_lines };
  static Format format_of(const std::string& path);

  Format format_;
  std::vector<std::string> columns_;
  OutputFile file_;
};

}  // namespace kinesphere::program
