// Records of Vissim (.fzp) and Viswalk (.pp): comments, names behind $VEHICLE: or $PEDESTRIAN:, rows.
#include <fmt/format.h>

#include <algorithm>

#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {

bool is_vissim(std::string_view text) {
  return text.starts_with("$VISION") || text.starts_with("$VEHICLE:") || text.starts_with("$PEDESTRIAN:");
}

/// All attributes are columns, of which the preset chooses; one with all coordinates between blanks is three.
RowTable read_vissim(const RecordingText& recording) {
  RowTable table("Vissim");
  LineCutter lines(recording.text);
  std::vector<std::size_t> columns;  // of each attribute
  std::vector<std::string> joint;    // names of those with all coordinates, empty for others
  while (const auto line = lines.next()) {
    if (line->starts_with("$VEHICLE:") || line->starts_with("$PEDESTRIAN:")) {
      columns.clear();
      joint.clear();
      for (const std::string_view name : fields_of(line->substr(line->find(':') + 1), ';')) {
        const bool is_joint = name == "COORDFRONT" || name == "COORDCENT" || name == "COORDREAR";
        joint.emplace_back(is_joint ? name : "");
        columns.push_back(table.column_of(is_joint ? joint.back() + 'X' : std::string(name)));
      }
    }
    if (line->empty() || line->starts_with('*') || line->starts_with('$')) continue;
    const auto fields = fields_of(*line, ';');
    if (fields.size() < columns.size() || columns.empty())
      throw ProgramError(
          fmt::format("{}:{}: expected {} fields as behind $VEHICLE: or $PEDESTRIAN:, but got {}",
                      recording.file, lines.line(), columns.size(), fields.size()));
    table.begin_row(lines.line());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (joint[k].empty()) {
        table.set(columns[k], fields[k]);
        continue;
      }
      const auto parts = words_of(fields[k]);
      for (std::size_t axis = 0; axis < std::min<std::size_t>(parts.size(), 3); ++axis)
        table.set(axis == 0 ? columns[k] : table.column_of(joint[k] + "XYZ"[axis]), parts[axis]);
    }
  }
  return table;
}

}  // namespace kinesphere::program
