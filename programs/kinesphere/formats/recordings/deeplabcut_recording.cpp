// Tables of DeepLabCut, and of Lightning Pose: under a row of scorers rows of individuals (perhaps), parts of
// bodies and coordinates; then rows of a frame and x, y, likelihood of each part.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/body_columns.hpp"

namespace kinesphere::program {

bool is_deeplabcut(std::string_view text) {
  if (!text.starts_with("scorer,")) return false;
  // Other tables may have a column of scorers.
  text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.starts_with("bodyparts,") || text.starts_with("individuals,");
}

RowTable read_deeplabcut(const RecordingText& recording) {
  const std::string& file = recording.file;
  LineCutter lines(recording.text);
  const auto next_fields = [&] { return fields_of(lines.next().value_or(""), ','); };
  next_fields();
  auto parts = next_fields();
  std::vector<std::string_view> individuals;
  if (parts[0] == "individuals") individuals = std::exchange(parts, next_fields());
  const auto coordinates = next_fields();
  if (parts[0] != "bodyparts" || coordinates[0] != "coords" || parts.size() != coordinates.size() ||
      (!individuals.empty() && individuals.size() != parts.size()))
    throw ProgramError(fmt::format(
        "{}:{}: expected rows scorer, bodyparts and coords above the numbers, as DeepLabCut writes them",
        file, lines.line()));
  BodyLayout layout{.format = "DeepLabCut", .frame = 0, .names = {"x", "y"}};
  if (std::ranges::count(coordinates, "likelihood") > 0) layout.names.emplace_back("likelihood");
  for (std::size_t column = 1; column < parts.size(); column += layout.names.size()) {
    if (column + layout.names.size() > parts.size() ||
        !std::ranges::equal(layout.names, std::span(coordinates).subspan(column, layout.names.size())))
      throw ProgramError(fmt::format("{}:{}: expected {} of each part (column {})", file, lines.line(),
                                     fmt::join(layout.names, ", "), column + 1));
    BodyColumns part{.id = std::string(parts[column]), .columns = {}};
    if (!individuals.empty()) part.id = fmt::format("{} {}", individuals[column], part.id);
    for (std::size_t k = 0; k < layout.names.size(); ++k) part.columns.push_back(column + k);
    layout.bodies.push_back(std::move(part));
  }
  return read_body_rows(layout, lines, file);
}

}  // namespace kinesphere::program
