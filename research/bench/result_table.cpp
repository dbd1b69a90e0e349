// A table of results: aligned on the terminal, and as a CSV file.
#include "research/bench/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "scenes/summary.hpp"

namespace kinesphere::program {
namespace {

std::string text_of(const Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return number(*value);
  if (const auto* count = std::get_if<std::uint64_t>(&cell)) return grouped(*count);
  if (const auto* flag = std::get_if<bool>(&cell)) return *flag ? "yes" : "NO";
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "-";
}

std::string heading_of(std::string column) {
  std::replace(column.begin(), column.end(), '_', ' ');
  return column;
}

}  // namespace

void ResultTable::row(std::vector<Cell> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

std::string ResultTable::text() const {
  std::vector<std::string> lines(rows_.size() + 1);
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    const std::string heading = heading_of(columns_[column]);
    std::size_t width = heading.size();
    bool on_the_left = !rows_.empty();
    for (const auto& row : rows_) {
      width = std::max(width, text_of(row[column]).size());
      on_the_left = on_the_left && std::holds_alternative<std::string>(row[column]);
    }
    const auto add = [&](std::string& line, const std::string& text) {
      line += column == 0 ? "" : "  ";
      line += on_the_left ? fmt::format("{:<{}}", text, width) : fmt::format("{:>{}}", text, width);
    };
    add(lines[0], heading);
    for (std::size_t row = 0; row < rows_.size(); ++row) add(lines[row + 1], text_of(rows_[row][column]));
  }
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

void ResultTable::save(const std::string& path) const {
  TableFile file(path, columns_);
  for (const auto& row : rows_) file.write(row);
  file.commit();
}

}  // namespace kinesphere::program
