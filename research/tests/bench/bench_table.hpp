// Reads tables that a benchmark has written.
#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace kinesphere::program {

/// Returns the fields by row, the headings first.
inline std::vector<std::vector<std::string>> csv_rows(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream stream(csv);
  for (std::string line; std::getline(stream, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ',');
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// Returns a field; row 0 is the first below the headings.
inline std::string csv_cell(const std::vector<std::vector<std::string>>& table, std::size_t row,
                            const std::string& column) {
  const auto at = std::find(table[0].begin(), table[0].end(), column);
  if (at == table[0].end()) return "no column " + column;
  return table[row + 1][static_cast<std::size_t>(at - table[0].begin())];
}

}  // namespace kinesphere::program
