// Exports of motion capture: Vicon Nexus, Qualisys (TSV), OptiTrack Motive, and TRC.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/body_columns.hpp"

namespace kinesphere::program {
namespace {

using CaptureFields = std::vector<std::string_view>;

/// Adds a body for each name that is not empty, from a column on; its coordinates begin there.
void add_named_triples(const CaptureFields& names, std::size_t first, BodyLayout& layout) {
  for (std::size_t column = first; column < names.size(); ++column)
    if (!names[column].empty())
      layout.bodies.push_back({std::string(names[column]), {column, column + 1, column + 2}});
}

std::string_view field_at(const CaptureFields& fields, std::size_t place) {
  return place < fields.size() ? fields[place] : std::string_view();
}

BodyLayout capture_layout(std::string_view format, char separator) {
  return {.format = std::string(format), .separator = separator, .names = {"x", "y", "z"}};
}

/// Trajectories, the rate, names, Frame and Sub Frame, units.
BodyLayout vicon_header(LineCutter& lines) {
  BodyLayout layout = capture_layout("Vicon Nexus", ',');
  const auto next_fields = [&] {
    lines.next();
    return fields_of(lines.whole(), ',');
  };
  next_fields();
  layout.frame_rate = parse_number(next_fields()[0]);
  layout.frame = 0;
  add_named_triples(next_fields(), 2, layout);
  next_fields();
  layout.unit = field_at(next_fields(), 2);
  return layout;
}

/// PathFileType, names of values, their values, names of markers, their axes.
BodyLayout trc_header(LineCutter& lines) {
  BodyLayout layout = capture_layout("TRC", '\t');
  const auto next_fields = [&] {
    lines.next();
    return fields_of(lines.whole(), '\t');
  };
  next_fields();
  const CaptureFields keys = next_fields(), values = next_fields();
  const auto unit = static_cast<std::size_t>(std::ranges::find(keys, "Units") - keys.begin());
  layout.unit = field_at(values, unit);
  layout.frame_rate = parse_number(field_at(values, 0));
  layout.time = 1;
  add_named_triples(next_fields(), 2, layout);
  next_fields();
  return layout;
}

/// Lines of a key and its values; the last is that of the names of markers, or names columns.
BodyLayout qualisys_header(LineCutter& lines) {
  BodyLayout layout = capture_layout("Qualisys", '\t');
  layout.unit = "mm";
  layout.zero_is_missing = true;
  CaptureFields names;
  LineCutter ahead = lines;
  while (ahead.next() && !parse_number(fields_of(ahead.whole(), '\t')[0])) {
    lines = ahead;
    const CaptureFields fields = fields_of(ahead.whole(), '\t');
    if (fields[0] == "FREQUENCY") layout.frame_rate = parse_number(field_at(fields, 1));
    if (fields[0] == "MARKER_NAMES") names.assign(fields.begin() + 1, fields.end());
  }
  std::erase(names, "");
  const std::size_t columns = fields_of(ahead.whole(), '\t').size();
  const std::size_t first = columns >= 3 * names.size() + 2 ? 2 : 0;
  if (first > 0) layout.time = 1;
  for (std::size_t k = 0; k < names.size(); ++k)
    layout.bodies.push_back({std::string(names[k]), {first + 3 * k, first + 3 * k + 1, first + 3 * k + 2}});
  return layout;
}

/// Keys and values, then rows of types, names and kinds above that of the axes, which begins with Frame.
/// Where there are rigid bodies, their markers do not count.
BodyLayout optitrack_header(LineCutter& lines) {
  BodyLayout layout = capture_layout("OptiTrack Motive", ',');
  const auto keys = fields_of(lines.next().value_or(""), ',');
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    if (keys[k] == "Length Units") layout.unit = keys[k + 1];
  }
  for (char& c : layout.unit) c = lower_case(c);
  layout.time = 1;
  CaptureFields types, names, kinds, row;
  while (lines.next()) {
    kinds = std::exchange(row, fields_of(lines.whole(), ','));
    // Names stand below types.
    if (kinds == types) names = row;
    if (std::ranges::count(row, "Rigid Body") + std::ranges::count(row, "Marker") > 0) types = row;
    if (row[0] == "Frame") break;
  }
  const bool has_rigid_bodies = std::ranges::count(types, "Rigid Body") > 0;
  for (std::size_t column = 2; column + 2 < row.size(); ++column) {
    const bool is_body = !has_rigid_bodies || field_at(types, column) == "Rigid Body";
    if (is_body && field_at(kinds, column) == "Position" && row[column] == "X" && row[column + 1] == "Y" &&
        row[column + 2] == "Z")
      layout.bodies.push_back({std::string(field_at(names, column)), {column, column + 1, column + 2}});
  }
  return layout;
}

using CaptureHeader = BodyLayout (*)(LineCutter&);

/// Returns the reader of the header of a text; null for another format.
CaptureHeader capture_header(std::string_view text) {
  constexpr std::pair<std::string_view, CaptureHeader> headers[] = {{"Trajectories\n", vicon_header},
                                                                    {"Trajectories\r\n", vicon_header},
                                                                    {"PathFileType\t", trc_header},
                                                                    {"NO_OF_FRAMES\t", qualisys_header},
                                                                    {"Format Version,", optitrack_header}};
  const auto* const found =
      std::ranges::find_if(headers, [&](const auto& header) { return text.starts_with(header.first); });
  return found == std::end(headers) ? nullptr : found->second;
}

}  // namespace

bool is_motion_capture(std::string_view text) { return capture_header(text) != nullptr; }

RowTable read_motion_capture(const RecordingText& recording) {
  LineCutter lines(recording.text);
  const BodyLayout layout = capture_header(recording.text)(lines);
  return read_body_rows(layout, lines, recording.file);
}

}  // namespace kinesphere::program
