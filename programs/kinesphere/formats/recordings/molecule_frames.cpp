// Frames of atoms in lines of fixed columns (GRO, PDB), as rows.
#include "formats/recordings/molecule_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/unwrapper.hpp"

namespace kinesphere::program {
namespace {

/// Returns the number behind "t=" in a title; empty if there is none.
std::string_view time_in_title(std::string_view title) {
  const auto words = words_of(title);
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (!words[k].starts_with("t=")) continue;
    const std::string_view time = words[k].size() > 2    ? words[k].substr(2)
                                  : k + 1 < words.size() ? words[k + 1]
                                                         : std::string_view();
    if (parse_number(time)) return time;
  }
  return {};
}

}  // namespace

std::string_view MoleculeFrames::line_ahead(std::size_t lines) const {
  LineCutter ahead = lines_;
  for (; lines > 0; --lines)
    if (!ahead.next()) return {};
  return ahead.whole();
}

void MoleculeFrames::begin_frame(std::string_view title) {
  const std::string_view time = time_in_title(title);
  timed_frames_ += time.empty() ? 0 : 1;
  time_ = time.empty() ? fmt::format("{}", frames_) : std::string(time);
  ++frames_;
  atoms_ = 0;
}

void MoleculeFrames::set_cell(const Unwrapper::Cell& cell) {
  unwrapper_.set_cell(cell);
  was_periodic_ = was_periodic_ || unwrapper_.is_periodic();
}

std::string_view MoleculeFrames::text_in(ColumnRange columns) const {
  const std::string_view text = line();
  return trimmed(text.substr(std::min(columns.first - 1, text.size()), columns.last + 1 - columns.first));
}

std::optional<double> MoleculeFrames::number(ColumnRange columns) const {
  return parse_number(text_in(columns));
}

void MoleculeFrames::add_atom(const std::array<ColumnRange, 3>& columns) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!number(columns[axis]))
      throw ProgramError(fmt::format("{}:{}: expected a number as {} (columns {} to {}), but got {}", file_,
                                     lines_.line(), "xyz"[axis], columns[axis].first, columns[axis].last,
                                     shown_field(text_in(columns[axis]))));
  unwrapper_.add_row(table_, lines_.line(), fmt::format("{}", ++atoms_), time_,
                     {text_in(columns[0]), text_in(columns[1]), text_in(columns[2])});
}

void MoleculeFrames::fail(std::string_view expected) const {
  throw ProgramError(
      fmt::format("{}:{}: expected {}, but got {}", file_, lines_.line(), expected, shown_field(line())));
}

RowTable MoleculeFrames::table() {
  if (timed_frames_ != 0 && timed_frames_ != frames_)
    throw ProgramError(
        fmt::format("{}: expected a time (t= in the title) for all frames or for none, but {} of {} "
                    "have one",
                    file_, timed_frames_, frames_));
  for (const char* name : {"id", timed_frames_ > 0 ? "time" : "frame", "x", "y", "z"}) table_.column_of(name);
  if (was_periodic_) table_.warnings.push_back(Unwrapper::warning(file_));
  return std::move(table_);
}

}  // namespace kinesphere::program
