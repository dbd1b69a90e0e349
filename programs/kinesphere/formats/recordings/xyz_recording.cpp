// XYZ and extended XYZ: frames of a count, a comment and a line for each atom.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/unwrapper.hpp"

namespace kinesphere::program {
namespace {

/// Returns the value of a key in the comment of extended XYZ; empty if there is none.
std::string_view xyz_value(std::string_view comment, std::string_view key) {
  for (std::size_t at = 0; at < comment.size(); ++at) {
    const std::string_view rest = comment.substr(at);
    const bool begins_word = at == 0 || comment[at - 1] == ' ';
    if (begins_word && same_name(rest.substr(0, key.size()), key) &&
        rest.substr(key.size()).starts_with('=')) {
      const std::string_view value = rest.substr(key.size() + 1);
      return value.starts_with('"') ? value.substr(1, std::min(value.find('"', 1), value.size()) - 1)
                                    : value.substr(0, value.find(' '));
    }
    if (comment[at] == '"') at = std::min(comment.find('"', at + 1), comment.size());
  }
  return {};
}

/// Columns of the lines of atoms.
struct XyzColumns {
  std::optional<std::size_t> id;
  std::size_t x = 1;
  std::size_t count = 4;
};

/// Reads "species:S:1:id:I:1:pos:R:3".
XyzColumns columns_of_properties(std::string_view properties) {
  XyzColumns columns;
  if (properties.empty()) return columns;
  std::vector<std::string_view> parts;
  while (!properties.empty()) parts.push_back(take_part(properties, ':'));
  std::size_t column = 0;
  for (std::size_t k = 0; k + 2 < parts.size(); k += 3) {
    if (same_name(parts[k], "id")) columns.id = column;
    if (same_name(parts[k], "pos")) columns.x = column;
    constexpr std::size_t most = 1000;
    column += std::min(count_in(parts[k + 2]).value_or(1), most);
  }
  columns.count = std::max({column, columns.x + 3, columns.id.value_or(0) + 1});
  return columns;
}

/// Returns the vectors of the box, those of periodic axes alone.
Unwrapper::Cell periodic_cell(std::string_view comment, const std::string& file, std::size_t line) {
  Unwrapper::Cell cell{};
  const auto flags = words_of(xyz_value(comment, "pbc"));
  const auto lattice = words_of(xyz_value(comment, "Lattice"));
  // Without flags a lattice is periodic, as in ASE and OVITO.
  const auto is_periodic = [&](std::size_t axis) {
    return flags.size() == 3 ? flags[axis] == "T" || flags[axis] == "1"
                             : flags.empty() && lattice.size() == 9;
  };
  for (std::size_t k = 0; k < 9; ++k) {
    const std::size_t vector = k / 3, axis = k % 3;
    if (!is_periodic(vector)) continue;
    const double number = lattice.size() == 9 ? parse_number(lattice[k]).value_or(-1.0) : -1.0;
    if (axis == vector ? !(number > 0.0) : axis > vector && number != 0.0)
      throw ProgramError(
          fmt::format("{}:{}: expected Lattice=\"X 0 0 XY Y 0 XZ YZ Z\" of a periodic box, with numbers X, Y "
                      "and Z > 0: turn it so, or write positions that do not jump and pbc=\"F F F\"",
                      file, line));
    cell[vector][axis] = number;
  }
  return cell;
}

}  // namespace

bool is_xyz(std::string_view text) {
  LineCutter lines(text);
  const auto first = lines.next(), second = lines.next(), third = lines.next();
  if (!first || !second || !third || !count_in(*first)) return false;
  const auto atom = words_of(*third);
  // A table of one column of numbers is none of atoms.
  return atom.size() >= 4 && (!xyz_value(*second, "Properties").empty() || !parse_number(atom[0]));
}

RowTable read_xyz(const RecordingText& recording) {
  const std::string& file = recording.file;
  LineCutter lines(recording.text);
  lines.next();
  const bool has_times = !xyz_value(lines.next().value_or(""), "Time").empty();
  RowTable table("XYZ", {"id", has_times ? "time" : "frame", "x", "y", "z"});
  lines = LineCutter(recording.text);
  Unwrapper unwrapper;
  for (std::size_t frame = 0; const auto head = lines.next(); ++frame) {
    if (head->empty()) continue;
    const auto count = count_in(*head);
    if (!count)
      throw ProgramError(
          fmt::format("{}:{}: expected a number of atoms, but got '{}'", file, lines.line(), *head));
    const std::string comment(lines.next().value_or(""));
    unwrapper.set_cell(periodic_cell(comment, file, lines.line()));
    if (unwrapper.is_periodic() && table.warnings.empty()) table.warnings.push_back(Unwrapper::warning(file));
    const XyzColumns columns = columns_of_properties(xyz_value(comment, "Properties"));
    const std::string time = has_times ? std::string(xyz_value(comment, "Time")) : fmt::format("{}", frame);
    for (std::size_t k = 0; k < *count; ++k) {
      const auto line = lines.next();
      // A program that still writes leaves the last frame unfinished.
      if (!line) break;
      const auto words = words_of(*line);
      if (words.size() < columns.count || !lines.has_end())
        throw ProgramError(
            fmt::format("{}:{}: expected a whole line of an atom with {} columns or more, but got '{}'", file,
                        lines.line(), columns.count, line->substr(0, 60)));
      const std::string id = columns.id ? std::string(words[*columns.id]) : fmt::format("{}", k);
      unwrapper.add_row(table, lines.line(), id, time,
                        {words[columns.x], words[columns.x + 1], words[columns.x + 2]});
    }
  }
  return table;
}

}  // namespace kinesphere::program
