// Dumps of LAMMPS in text: ITEM: TIMESTEP, NUMBER OF ATOMS, BOX BOUNDS, ATOMS.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/unwrapper.hpp"

namespace kinesphere::program {
namespace {

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
          fmt::format("{}:{}: expected unwrapped positions, xu yu zu, in a tilted box: dump these, "
                      "as in: dump 1 all custom 100 FILE id xu yu zu",
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

RowTable read_lammps(const RecordingText& recording) { return LammpsReader(recording).read(); }

}  // namespace kinesphere::program
