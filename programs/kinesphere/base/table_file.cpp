// Rows of named values, as CSV or as JSON lines, by the ending of the file's name.
#include "base/table_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/escaped_text.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

std::string quoted_for_csv(const std::string& text) {
  if (text.find_first_of(",;\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// Returns the cell as text. `empty` is the format's spelling of a missing value, and of NaN and infinity in
/// JSON.
std::string text_of(const Cell& cell, std::string_view empty, std::string (*quoted)(const std::string&)) {
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::isfinite(*number) ? fmt::format("{}", *number) : std::string(empty);
  }
  if (const auto* count = std::get_if<std::uint64_t>(&cell)) return fmt::format("{}", *count);
  if (const auto* flag = std::get_if<bool>(&cell)) return *flag ? "true" : "false";
  if (const auto* decimal = std::get_if<DecimalText>(&cell)) return decimal->digits;
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  return std::string(empty);
}

}  // namespace

TableFormat table_format_of(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".csv") return TableFormat::csv;
  if (ending == ".jsonl") return TableFormat::json_lines;
  throw ProgramError(fmt::format("{}: expected a name that ends in .csv or .jsonl", path));
}

TableFile::TableFile(const std::string& path, std::vector<std::string> columns)
    : TableFile(table_format_of(path), {path}, std::move(columns)) {}

TableFile::TableFile(const std::string& path) : format_(table_format_of(path)), file_(path) {}

TableFile::TableFile(TableFormat format, OutputPlace place, std::vector<std::string> columns)
    : format_(format), file_(std::move(place)) {
  begin(std::move(columns));
}

void TableFile::begin(std::vector<std::string> columns) {
  columns_ = std::move(columns);
  if (format_ == TableFormat::csv && file_.length() == 0)
    file_.write(fmt::format("{}\n", fmt::join(columns_, ",")));
}

void TableFile::write(std::span<const Cell> cells) {
  assert(cells.size() == columns_.size());
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (format_ == TableFormat::csv) {
      line += k == 0 ? "" : ",";
      line += text_of(cells[k], "", quoted_for_csv);
    } else {
      line += k == 0 ? "{" : ", ";
      line += json_text(columns_[k]) + ": " + text_of(cells[k], "null", json_text);
    }
  }
  line += format_ == TableFormat::csv ? "\n" : "}\n";
  file_.write(line);
}

}  // namespace kinesphere::program
