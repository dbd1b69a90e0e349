// Trajectories of molecules: XYZ, extended XYZ (frames of a count, a comment and a line for each atom), and
// dumps of LAMMPS in text (ITEM: TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS, ATOMS).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {
namespace {

/// Undoes the jumps of positions at the faces of a periodic box: each goes on from the last of its atom by
/// less than half of the box.
class Unwrapper {
 public:
  /// Vectors along x, in the plane of x and y, and any; 0 where the box is not periodic.
  using Cell = std::array<std::array<double, 3>, 3>;
  void set_cell(const Cell& cell) { cell_ = cell; }
  /// Size of a box with right angles on each axis; 0 where it is not periodic.
  void set_box(const std::array<double, 3>& sizes) {
    cell_ = {{{sizes[0], 0.0, 0.0}, {0.0, sizes[1], 0.0}, {0.0, 0.0, sizes[2]}}};
  }
  bool is_periodic() const { return cell_ != Cell{}; }
  /// Adds a row of id, time and position, whose texts stay as they are, unless it jumped. What is no number
  /// stays, too, and is refused by the reader of the rows.
  void add_row(RowTable& table, std::size_t line, const std::string& id, std::string_view time,
               const std::array<std::string_view, 3>& position) {
    const auto add_as_it_is = [&] { table.add_row(line, id, time, position[0], position[1], position[2]); };
    if (!is_periodic()) return add_as_it_is();
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto number = parse_number(position[axis]);
      if (!number) return add_as_it_is();
      place[axis] = *number;
    }
    const auto [last, is_new] = last_.try_emplace(id, place);
    bool has_jumped = false;
    // The last vector alone has a part along z, the first none but along x.
    for (std::size_t k = 3; !is_new && k-- > 0;) {
      const auto& vector = cell_[k];
      if (!(vector[k] > 0.0)) continue;
      const double jumps = std::round((place[k] - last->second[k]) / vector[k]);
      has_jumped = has_jumped || jumps != 0.0;
      for (std::size_t axis = 0; axis <= k; ++axis) place[axis] -= jumps * vector[axis];
    }
    last->second = place;
    if (!has_jumped) return add_as_it_is();
    table.add_row(line, id, time, place[0], place[1], place[2]);
  }
  /// Returns the warning that distances through the faces are not seen.
  static std::string warning(const std::string& file) {
    return fmt::format(
        "{}: its box is periodic: tracks go on through its faces, but distances through them are not seen",
        file);
  }

 private:
  Cell cell_{};
  std::unordered_map<std::string, std::array<double, 3>> last_;
};

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

class LammpsReader {
 public:
  explicit LammpsReader(const RecordingText& recording) : lines_(recording.text), file_(recording.file) {}

  RowTable read() {
    while (const auto line = lines_.next()) {
      if (line->starts_with("ITEM: ATOMS")) {
        read_atoms(words_of(line->substr(11)));
        continue;
      }
      if (line->starts_with("ITEM: BOX BOUNDS")) {
        read_box(words_of(line->substr(16)));
      } else if (line->starts_with("ITEM: ")) {
        const std::string_view value = lines_.next().value_or("");
        if (*line == "ITEM: TIMESTEP") step_ = value;
        if (*line == "ITEM: TIME") time_ = value;
        if (*line == "ITEM: NUMBER OF ATOMS") atoms_ = count_in(value).value_or(0);
      } else if (!line->empty()) {
        fail("a line that begins with ITEM:", *line);
      }
    }
    for (const char* name : {"id", time_.empty() ? "frame" : "time", "x", "y", "z"}) table_.column_of(name);
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::string_view expected, std::string_view line) const {
    throw ProgramError(
        fmt::format("{}:{}: expected {}, but got '{}'", file_, lines_.line(), expected, line.substr(0, 60)));
  }

  void read_box(const std::vector<std::string_view>& kinds) {
    std::array<double, 3> periods{};
    is_tilted_ = kinds.size() == 6;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto line = lines_.next();
      if (!line) return;
      const auto words = words_of(*line);
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      const double low = words.size() < 2 ? none : parse_number(words[0]).value_or(none);
      const double high = words.size() < 2 ? none : parse_number(words[1]).value_or(none);
      if (!(low <= high)) fail("two bounds of the box", *line);
      low_[axis] = low;
      size_[axis] = high - low;
      // Before the three kinds there are xy xz yz if the box is tilted.
      const std::size_t kind = axis + (kinds.size() == 6 ? 3 : 0);
      if (kind < kinds.size() && kinds[kind] == "pp") periods[axis] = size_[axis];
    }
    if (periods == std::array<double, 3>{}) return;
    if (!is_tilted_) unwrapper_.set_box(periods);
    if (table_.warnings.empty()) table_.warnings.push_back(Unwrapper::warning(file_));
  }

  void read_atoms(const std::vector<std::string_view>& names) {
    const auto column = [&](std::string_view name) -> std::optional<std::size_t> {
      const auto found = std::find(names.begin(), names.end(), name);
      return found == names.end() ? std::nullopt
                                  : std::optional(static_cast<std::size_t>(found - names.begin()));
    };
    const auto id = column("id");
    // Unwrapped positions first: they do not jump at the faces of the box.
    std::array<std::optional<std::size_t>, 3> places;
    bool is_scaled = false, is_unwrapped = false;
    for (const std::string_view suffix : {"u", "", "su", "s"}) {
      places = {column(fmt::format("x{}", suffix)), column(fmt::format("y{}", suffix)),
                column(fmt::format("z{}", suffix))};
      is_scaled = suffix.starts_with('s');
      is_unwrapped = suffix.ends_with('u');
      if (places[0] && places[1] && places[2]) break;
    }
    if (!id || !places[0] || !places[1] || !places[2])
      throw ProgramError(fmt::format("{}:{}: expected columns id and x y z, xu yu zu or xs ys zs of atoms",
                                     file_, lines_.line()));
    if (is_tilted_ && (is_scaled || !is_unwrapped))
      throw ProgramError(
          fmt::format("{}:{}: expected unwrapped positions, xu yu zu, in a tilted box: dump these, as in: "
                      "dump 1 all custom 100 FILE id xu yu zu",
                      file_, lines_.line()));
    for (std::size_t k = 0; k < atoms_; ++k) {
      const auto line = lines_.next();
      // A program that still writes leaves the last frame unfinished.
      if (!line) return;
      const auto words = words_of(*line);
      if (words.size() < names.size() || !lines_.has_end()) fail("a whole line of an atom", *line);
      const std::string atom(words[*id]);
      std::array<std::string, 3> position;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string_view word = words[*places[axis]];
        const auto part = is_scaled ? parse_number(word) : std::nullopt;
        if (is_scaled && !part) fail("a number as a position", word);
        position[axis] = part ? fmt::format("{}", low_[axis] + *part * size_[axis]) : std::string(word);
      }
      const auto& [x, y, z] = position;
      const std::string_view time = time_.empty() ? step_ : time_;
      if (is_unwrapped)
        table_.add_row(lines_.line(), atom, time, x, y, z);
      else
        unwrapper_.add_row(table_, lines_.line(), atom, time, {x, y, z});
    }
  }

  LineCutter lines_;
  const std::string& file_;
  RowTable table_{"LAMMPS dump"};
  std::string step_, time_;
  std::size_t atoms_ = 0;
  std::array<double, 3> low_{}, size_{};
  bool is_tilted_ = false;  ///< the box has no right angles
  Unwrapper unwrapper_;
};

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

RowTable read_lammps(const RecordingText& recording) { return LammpsReader(recording).read(); }

}  // namespace kinesphere::program
