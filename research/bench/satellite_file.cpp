#include "research/bench/satellite_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "columns/text_table.hpp"
#include "input_file.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

constexpr std::array<std::string_view, 6> state_columns{"x", "y", "z", "vx", "vy", "vz"};

}  // namespace

std::vector<State> read_satellites(const std::string& path) {
  TextTable table(read_input(path), path);
  std::array<std::size_t, state_columns.size()> places{};
  for (std::size_t k = 0; k < state_columns.size(); ++k) {
    const auto at = std::find(table.header().begin(), table.header().end(), state_columns[k]);
    if (at == table.header().end())
      throw ProgramError(fmt::format("{}: expected a column {}, but there is none", path, state_columns[k]));
    places[k] = static_cast<std::size_t>(at - table.header().begin());
  }
  std::vector<State> states;
  for (TableRow row; table.next(row);) {
    std::array<double, state_columns.size()> values{};
    for (std::size_t k = 0; k < state_columns.size(); ++k) {
      const std::string_view text = row.fields[places[k]];
      const auto value = parse_number(text);
      if (!value)
        throw ProgramError(fmt::format("{}: line {}: {}: expected a finite number, but got '{}'", path,
                                       row.line, state_columns[k], text));
      values[k] = *value;
    }
    const auto [x, y, z, vx, vy, vz] = values;
    states.push_back({{x, y, z}, {vx, vy, vz}});
  }
  return states;
}

}  // namespace kinesphere::program
