// Tables with columns for each body, under headers of several lines: motion capture and trackers of parts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/fields/line_text.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {

struct BodyColumns {
  std::string id;
  std::vector<std::size_t> columns;  ///< of BodyLayout::names
};

/// Where the columns of a table are, as its header says.
struct BodyLayout {
  std::string format;
  char separator = ',';
  std::optional<std::size_t> time, frame;  ///< columns; without both, rows are counted as frames
  std::optional<double> frame_rate;        ///< frames per second
  std::vector<std::string> names;          ///< of the columns of a body: x, y, z and perhaps others
  std::string unit;                        ///< of lengths: "mm"; empty if it is not known
  std::vector<BodyColumns> bodies;
  bool zero_is_missing = false;  ///< x = y = z = 0 stands for no position
};

/// Reads the rows of a table up to a blank line with another section behind it; `lines` stands behind the
/// header. The result has a row for each body. Throws ProgramError naming the line, the body and the column
/// for what is no number.
RowTable read_body_rows(const BodyLayout& layout, LineCutter lines, const std::string& file);

}  // namespace kinesphere::program
