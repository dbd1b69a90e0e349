// Runs benchmarks and reads the tables that they have written.
#pragma once

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "program/support.hpp"

namespace kinesphere::program {

using BenchRows = std::vector<std::vector<std::string>>;

/// Returns the fields by row, the headings first.
inline BenchRows csv_rows(const std::string& csv) {
  BenchRows rows;
  std::istringstream stream(csv);
  for (std::string line; std::getline(stream, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ',');
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// Returns a field; row 0 is the first below the headings.
inline std::string csv_cell(const BenchRows& table, std::size_t row, const std::string& column) {
  const auto at = std::find(table[0].begin(), table[0].end(), column);
  if (at == table[0].end()) return "no column " + column;
  return table[row + 1][static_cast<std::size_t>(at - table[0].begin())];
}

inline double csv_number(const BenchRows& table, std::size_t row, const std::string& column) {
  return std::stod(csv_cell(table, row, column));
}

class BenchTest : public ProgramTest {
 protected:
  /// Runs a benchmark with tiny sizes.
  ProgramRun bench(const std::string& arguments) const {
    ProgramRun result = run(arguments + " --quick --output '" + path("out") + "-bench'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result;
  }
  std::string read(const std::string& name) const { return read_text(path("out-bench/" + name)); }
  BenchRows table(const std::string& name) const { return csv_rows(read(name)); }
};

}  // namespace kinesphere::program
