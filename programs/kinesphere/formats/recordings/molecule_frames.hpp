// Frames of atoms in lines of fixed columns (GRO, PDB), as rows.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/unwrapper.hpp"

namespace kinesphere::program {

/// The first and last column of a number in its line, from 1.
struct ColumnRange {
  std::size_t first, last;
};

/// Reads the lines of a file, and makes a row of each atom. The id is the place of the atom in
/// its frame, from 1, since numbers of atoms begin again at 99,999.
class MoleculeFrames {
 public:
  MoleculeFrames(const RecordingText& recording, std::string format)
      : lines_(recording.text), file_(recording.file), table_(std::move(format)) {}

  /// Moves to the next line; false at the end.
  bool next() { return lines_.next().has_value(); }
  /// The line, with its leading blanks.
  std::string_view line() const { return lines_.whole(); }
  /// True if the line had an end: a file that was cut off may lack it.
  bool line_is_whole() const { return lines_.has_end(); }

  /// The line that comes so many lines later; empty behind the end.
  std::string_view line_ahead(std::size_t lines) const;

  /// Begins a frame. `title` may say its time, as GROMACS does: t= 1.0.
  void begin_frame(std::string_view title);
  void set_cell(const Unwrapper::Cell& cell);
  /// Makes a row of the line. Throws ProgramError naming the columns for what is no number.
  void add_atom(const std::array<ColumnRange, 3>& columns);
  /// Returns the number of the line in a range of columns; nothing for other text.
  std::optional<double> number(ColumnRange columns) const;
  /// Throws ProgramError: file, line, "expected ..., but got" the line.
  [[noreturn]] void fail(std::string_view expected) const;
  /// Returns the table. Throws ProgramError unless all frames have a time or none.
  RowTable table();

 private:
  std::string_view text_in(ColumnRange columns) const;

  LineCutter lines_;
  const std::string& file_;
  RowTable table_;
  std::size_t frames_ = 0, timed_frames_ = 0, atoms_ = 0;
  std::string time_;
  Unwrapper unwrapper_;
  bool was_periodic_ = false;
};

}  // namespace kinesphere::program
