// Exports of motion capture: Vicon Nexus, Qualisys (TSV), OptiTrack Motive, and TRC. Under headers of several
// lines each marker or body has columns of its own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {
namespace {

using CaptureFields = std::vector<std::string_view>;

/// Where the columns of a table are, as its header says.
struct CaptureLayout {
  std::string format;
  char separator = ',';
  std::optional<std::size_t> time{}, frame{};  ///< columns; without both, rows are counted as frames
  std::optional<double> frame_rate{};          ///< frames per second
  std::string unit{};                          ///< of lengths: "mm"; empty if it is not known
  /// The name of each marker or body, and its column of x, behind which those of y and z stand.
  std::vector<std::pair<std::string, std::size_t>> bodies{};
  bool zero_is_missing = false;  ///< x = y = z = 0 stands for no position
};

/// Adds a body for each name that is not empty, from a column on; its coordinates begin there.
void add_named_triples(const CaptureFields& names, std::size_t first, CaptureLayout& layout) {
  for (std::size_t column = first; column < names.size(); ++column)
    if (!names[column].empty()) layout.bodies.emplace_back(names[column], column);
}

/// Returns the fields of the next line, whose first may be empty.
CaptureFields next_row(LineCutter& lines, char separator) {
  lines.next();
  return fields_of(lines.whole(), separator);
}

std::string_view field_at(const CaptureFields& fields, std::size_t place) {
  return place < fields.size() ? fields[place] : std::string_view();
}

/// Trajectories, the rate, names, Frame and Sub Frame, units.
CaptureLayout vicon_header(LineCutter& lines) {
  CaptureLayout layout{.format = "Vicon Nexus", .separator = ','};
  const auto next_fields = [&] { return next_row(lines, ','); };
  next_fields();
  layout.frame_rate = parse_number(next_fields()[0]);
  layout.frame = 0;
  add_named_triples(next_fields(), 2, layout);
  next_fields();
  layout.unit = field_at(next_fields(), 2);
  return layout;
}

/// PathFileType, names of values, their values, names of markers, their axes.
CaptureLayout trc_header(LineCutter& lines) {
  CaptureLayout layout{.format = "TRC", .separator = '\t'};
  const auto next_fields = [&] { return next_row(lines, '\t'); };
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
CaptureLayout qualisys_header(LineCutter& lines) {
  CaptureLayout layout{.format = "Qualisys", .separator = '\t'};
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
  for (std::size_t k = 0; k < names.size(); ++k) layout.bodies.emplace_back(names[k], first + 3 * k);
  return layout;
}

/// Keys and values, then rows of types, names and kinds above that of the axes, which begins with Frame.
/// Where there are rigid bodies, their markers do not count.
CaptureLayout optitrack_header(LineCutter& lines) {
  CaptureLayout layout{.format = "OptiTrack Motive", .separator = ','};
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
      layout.bodies.emplace_back(field_at(names, column), column);
  }
  return layout;
}

using CaptureHeader = CaptureLayout (*)(LineCutter&);

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

/// Reads the rows up to a blank line with another section behind it. The result has a row for each body.
class CaptureReader {
 public:
  /// `lines` stands behind the header.
  CaptureReader(const CaptureLayout& layout, LineCutter lines, const std::string& file)
      : layout_(layout), lines_(lines), file_(file), table_(layout.format, {"id"}) {
    if (layout.bodies.empty())
      throw ProgramError(fmt::format("{}:{}: expected columns of bodies in the header of {}, but found none",
                                     file, lines.line(), layout.format));
    if (layout.frame_rate) table_.comments.push_back(fmt::format("framerate: {} fps", *layout.frame_rate));
    table_.column_of(layout.time ? "time" : "frame");
    for (const char* name : {"x", "y", "z"})
      table_.column_of(layout.unit.empty() ? name : fmt::format("{}_{}", name, layout.unit));
    std::size_t last = std::max(layout.time.value_or(0), layout.frame.value_or(0));
    for (const auto& [id, column] : layout.bodies) last = std::max(last, column + 2);
    needed_ = last + 1;
  }

  RowTable read() {
    for (bool is_behind_blank = false; lines_.next();) {
      const std::string_view line = lines_.whole();
      const bool is_blank = line.find_first_not_of('\r') == std::string_view::npos;
      const auto fields = fields_of(line, layout_.separator);
      // Another section of the file.
      if (is_behind_blank && frames_ > 0 && !is_blank && !parse_number(fields[0])) break;
      if (!is_blank) add_rows(fields);
      is_behind_blank = is_blank;
    }
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::string_view what, std::size_t column, std::string_view got) const {
    throw ProgramError(fmt::format("{}:{}: expected a number as {} (column {}), but got {}", file_,
                                   lines_.line(), what, column + 1, shown_field(got)));
  }

  void add_rows(const CaptureFields& fields) {
    if (fields.size() < needed_)
      throw ProgramError(fmt::format("{}:{}: expected {} columns, but got {}", file_, lines_.line(), needed_,
                                     fields.size()));
    std::string time = fmt::format("{}", frames_++);
    if (const auto& column = layout_.time ? layout_.time : layout_.frame) {
      if (!parse_number(fields[*column])) fail(layout_.time ? "time" : "frame", *column, fields[*column]);
      time = fields[*column];
    }
    for (const auto& [id, first] : layout_.bodies) {
      bool is_zero = layout_.zero_is_missing;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto number = parse_number(fields[first + axis]);
        if (!number && !is_missing(fields[first + axis]))
          fail(fmt::format("{} of {}", "xyz"[axis], id), first + axis, fields[first + axis]);
        is_zero = is_zero && number == 0.0;
      }
      table_.add_row(lines_.line(), id, time);
      for (std::size_t axis = 0; axis < 3 && !is_zero; ++axis) table_.set(2 + axis, fields[first + axis]);
    }
  }

  const CaptureLayout& layout_;
  LineCutter lines_;
  const std::string& file_;
  RowTable table_;
  std::size_t needed_ = 0, frames_ = 0;
};

}  // namespace

bool is_motion_capture(std::string_view text) { return capture_header(text) != nullptr; }

RowTable read_motion_capture(const RecordingText& recording) {
  LineCutter lines(recording.text);
  const CaptureLayout layout = capture_header(recording.text)(lines);
  return CaptureReader(layout, lines, recording.file).read();
}

}  // namespace kinesphere::program
