// Coordinates over time as GROMACS writes them for Grace (.xvg, by gmx traj -ox).
#include <fmt/format.h>

#include <algorithm>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/converted/body_columns.hpp"
#include "formats/fields/line_text.hpp"

namespace kinesphere::program {
namespace {

bool is_comment_of_xvg(std::string_view line) { return line.empty() || line[0] == '#' || line[0] == '@'; }

/// Returns "atom 74 X" of @ s0 legend "atom 74 X", in the order of the columns; empty for another line.
std::string_view legend_in(std::string_view line) {
  const auto words = words_of(line);
  const std::size_t begin = line.find('"'), end = line.rfind('"');
  const bool is_legend = words.size() > 3 && words[0] == "@" && words[1].starts_with('s') &&
                         count_in(words[1].substr(1)) && words[2] == "legend" && end > begin;
  return is_legend ? line.substr(begin + 1, end - begin - 1) : std::string_view();
}

/// Adds the axes of a body, which has a column each: those whose legends end with X, Y and Z.
void add_coordinate(std::string_view legend, std::size_t column, BodyLayout& layout) {
  const std::size_t blank = legend.rfind(' ');
  if (blank == std::string_view::npos) return;
  const std::string_view axis = legend.substr(blank + 1), body = legend.substr(0, blank);
  if (axis == "X") layout.bodies.push_back({std::string(body), {}});
  if (!layout.bodies.empty() && layout.bodies.back().id == body &&
      (axis == "X" || axis == "Y" || axis == "Z"))
    layout.bodies.back().columns.push_back(column);
}

}  // namespace

bool is_xvg(std::string_view text) {
  const std::string_view head = text.substr(0, 4096);
  return (head.starts_with('#') || head.starts_with('@')) && head.find("\n@") != std::string_view::npos &&
         head.find("axis  label \"") != std::string_view::npos;
}

std::optional<ConvertedTable> convert_xvg(std::string_view text, const std::string& file) {
  if (!is_xvg(text)) return std::nullopt;
  BodyLayout layout{.format = "coordinates of GROMACS (lengths in nm, times in ps)",
                    .separator = ' ',
                    .time = 0,
                    .names = {"x", "y"}};
  LineCutter lines(text);
  std::size_t columns = 0;
  for (LineCutter ahead = lines;; lines = ahead) {
    const auto line = ahead.next();
    if (!line || !is_comment_of_xvg(*line)) break;
    if (const std::string_view legend = legend_in(*line); !legend.empty())
      add_coordinate(legend, ++columns, layout);
  }
  const std::size_t axes = layout.bodies.empty() ? 0 : layout.bodies.front().columns.size();
  if (axes < 2 ||
      std::ranges::any_of(layout.bodies,
                          [&](const BodyColumns& body) { return body.columns.size() != axes; }) ||
      layout.bodies.size() * axes != columns)
    throw ProgramError(
        fmt::format("{}: expected coordinates X, Y and perhaps Z of each atom in its legends, as gmx traj "
                    "-ox writes them",
                    file));
  if (axes == 3) layout.names.emplace_back("z");
  ConvertedTable table = read_body_rows(layout, lines, file);
  table.warnings.push_back(
      fmt::format("{}: it does not say its box: positions must not jump at the faces of a periodic one (gmx "
                  "trjconv -pbc nojump)",
                  file));
  return table;
}

}  // namespace kinesphere::program
