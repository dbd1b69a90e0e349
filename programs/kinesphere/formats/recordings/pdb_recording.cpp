// PDB files: models of ATOM and HETATM records, with the box of CRYST1.
#include <cmath>
#include <string>
#include <utility>

#include "base/ascii_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/molecule_frames.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/unwrapper.hpp"

namespace kinesphere::program {
namespace {

constexpr std::array<ColumnRange, 3> pdb_position{{{31, 38}, {39, 46}, {47, 54}}};

/// Returns the vectors of the box that CRYST1 tells by lengths and angles; none for a box of 1, which stands
/// for no box.
Unwrapper::Cell pdb_cell(const MoleculeFrames& frames) {
  constexpr ColumnRange fields[] = {{7, 15}, {16, 24}, {25, 33}, {34, 40}, {41, 47}, {48, 54}};
  std::array<double, 6> numbers{};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto number = frames.number(fields[k]);
    if (!number) frames.fail("three lengths and three angles of the box (columns 7 to 54)");
    numbers[k] = *number;
  }
  const auto [a, b, c, alpha, beta, gamma] = numbers;
  if (!(a > 1.0 && b > 1.0 && c > 1.0)) return {};
  if (alpha == 90.0 && beta == 90.0 && gamma == 90.0) return {{{a, 0.0, 0.0}, {0.0, b, 0.0}, {0.0, 0.0, c}}};
  constexpr double degree = 3.14159265358979323846 / 180.0;
  const double cosine = std::cos(gamma * degree), sine = std::sin(gamma * degree);
  const double x = std::cos(beta * degree), y = (std::cos(alpha * degree) - x * cosine) / sine;
  const double z = std::sqrt(1.0 - x * x - y * y);
  if (!(sine > 0.0 && z > 0.0)) frames.fail("angles that a box can have (columns 34 to 54)");
  return {{{a, 0.0, 0.0}, {b * cosine, b * sine, 0.0}, {c * x, c * y, c * z}}};
}

bool is_record(std::string_view line, std::string_view name) { return trimmed(line.substr(0, 6)) == name; }

}  // namespace

bool is_pdb(std::string_view text) {
  LineCutter lines(text);
  constexpr int most = 1000;
  for (int k = 0; k < most && lines.next(); ++k) {
    const std::string_view line = lines.whole();
    if ((is_record(line, "ATOM") || is_record(line, "HETATM")) && line.size() >= 54 && line[34] == '.' &&
        line[42] == '.' && line[50] == '.')
      return true;
    if (!line.empty() && line.find_first_of(",;\t") < 6) return false;
  }
  return false;
}

RowTable read_pdb(const RecordingText& recording) {
  MoleculeFrames frames(recording, "PDB (lengths in Angstrom, times in ps)");
  std::string title;
  bool is_in_frame = false;
  while (frames.next()) {
    const std::string_view line = frames.line();
    // Programs write the time of a frame into the title above it.
    if (is_record(line, "TITLE") || is_record(line, "REMARK")) title += std::string(line) + ' ';
    if (is_record(line, "CRYST1")) frames.set_cell(pdb_cell(frames));
    const bool is_end = is_record(line, "ENDMDL") || is_record(line, "END") || is_record(line, "MODEL");
    if (is_end && std::exchange(is_in_frame, false)) title.clear();
    if (!is_record(line, "ATOM") && !is_record(line, "HETATM")) continue;
    if (line.size() < pdb_position[2].last) frames.fail("a whole line of an atom");
    if (!std::exchange(is_in_frame, true)) frames.begin_frame(title);
    frames.add_atom(pdb_position);
  }
  return frames.table();
}

}  // namespace kinesphere::program
