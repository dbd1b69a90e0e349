// GRO files of GROMACS: frames of a title, a count, a line for each atom, and the box.
#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/molecule_frames.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/unwrapper.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t first_gro_number = 20;  ///< characters before the numbers

/// Returns the width of the numbers of a line, which have as many decimals as its writer likes; 0 for a line
/// of another kind. The first two points are one width apart.
std::size_t gro_width(std::string_view line) {
  const std::size_t one = line.find('.', first_gro_number);
  const std::size_t two = one == std::string_view::npos ? one : line.find('.', one + 1);
  return two == std::string_view::npos ? 0 : two - one;
}

/// Returns the vectors of a box in its line, XX YY ZZ and perhaps XY XZ YX YZ ZX ZY, where the second letter
/// is that of the axis; nothing for other text.
std::optional<Unwrapper::Cell> gro_cell(std::string_view line) {
  const auto words = words_of(line);
  std::array<double, 9> numbers{};
  if (words.size() != 3 && words.size() != 9) return std::nullopt;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const auto number = parse_number(words[k]);
    if (!number) return std::nullopt;
    numbers[k] = *number;
  }
  const auto [xx, yy, zz, xy, xz, yx, yz, zx, zy] = numbers;
  if (xy != 0.0 || xz != 0.0 || yz != 0.0) return std::nullopt;
  return Unwrapper::Cell{{{xx, 0.0, 0.0}, {yx, yy, 0.0}, {zx, zy, zz}}};
}

}  // namespace

bool is_gro(std::string_view text) {
  LineCutter lines(text);
  lines.next();
  const auto count = lines.next();
  if (!count || !count_in(*count) || !lines.next()) return false;
  const std::string_view atom = lines.whole();
  return atom.size() > first_gro_number && gro_width(atom) > 0 && count_in(trimmed(atom.substr(0, 5))) &&
         count_in(trimmed(atom.substr(15, 5)));
}

RowTable read_gro(const RecordingText& recording) {
  MoleculeFrames frames(recording, "GRO (lengths in nm, times in ps)");
  while (frames.next()) {
    if (trimmed(frames.line()).empty()) continue;
    frames.begin_frame(frames.line());
    if (!frames.next()) break;
    const auto count = count_in(trimmed(frames.line()));
    if (!count) frames.fail("a number of atoms");
    if (const auto cell = gro_cell(frames.line_ahead(*count + 1))) frames.set_cell(*cell);
    std::array<ColumnRange, 3> columns{};
    for (std::size_t k = 0; k < *count; ++k) {
      // A program that still writes leaves the last frame unfinished.
      if (!frames.next()) return frames.table();
      const std::size_t width = k == 0 ? gro_width(frames.line()) : columns[0].last - first_gro_number;
      if (width == 0 || !frames.line_is_whole()) frames.fail("a whole line of an atom");
      for (std::size_t axis = 0; axis < 3; ++axis)
        columns[axis] = {first_gro_number + axis * width + 1, first_gro_number + (axis + 1) * width};
      frames.add_atom(columns);
    }
    if (frames.next() && !gro_cell(frames.line()))
      frames.fail("the 3 or 9 numbers of a box whose first vector is along x, and the second at z = 0");
  }
  return frames.table();
}

}  // namespace kinesphere::program
