// Which columns of a table hold a recorded motion.
#include "track_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "program_error.hpp"

namespace kinesphere::program {
namespace {

/// A format that its header gives away.
struct KnownHeader {
  std::string_view format, id, time, x, y;
  std::string_view z;  ///< used when the table has it; empty: plane motion
};

constexpr std::array known_headers{
    // "object" joins interrupted tracks and jumps where it does; "oldobject" does not.
    KnownHeader{"mosquito tracks", "oldobject", "time", "XSplined", "YSplined", "ZSplined"},
    // z is the person's height.
    KnownHeader{"PedPy", "id", "frame", "x/m", "y/m", ""},
    KnownHeader{"table", "id", "time", "x", "y", "z"},
    KnownHeader{"table", "id", "frame", "x", "y", "z"},
};

std::optional<std::size_t> column_named(const TextTable& table, std::string_view name) {
  const auto found = std::find(table.header.begin(), table.header.end(), name);
  if (found == table.header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.header.begin());
}

std::string names_in(const TextTable& table) {
  if (table.header.empty()) return "no header";
  return fmt::format("the columns {}", fmt::join(table.header, ", "));
}

/// One row per person and 10 frames: frame id x z(=0) y vx vz(=0) vy, and no header.
std::optional<TrackColumns> recognise_obsmat(const TextTable& table) {
  const auto& fields = table.rows.front().fields;
  if (!table.header.empty() || fields.size() != 8) return std::nullopt;
  if (parse_number(fields[3]) != 0.0 || parse_number(fields[6]) != 0.0) return std::nullopt;
  return TrackColumns{
      .format = "UCY obsmat", .id = 1, .time = 0, .x = 2, .y = 4, .z = {}, .frame_rate = 25.0};
}

std::optional<TrackColumns> recognise_header(const TextTable& table) {
  for (const KnownHeader& known : known_headers) {
    const auto id = column_named(table, known.id), time = column_named(table, known.time);
    const auto x = column_named(table, known.x), y = column_named(table, known.y);
    if (!id || !time || !x || !y) continue;
    const auto z = known.z.empty() ? std::nullopt : column_named(table, known.z);
    return TrackColumns{
        .format = std::string(known.format), .id = *id, .time = *time, .x = *x, .y = *y, .z = z};
  }
  return std::nullopt;
}

/// By its name in the header or its number from 1.
std::size_t column_of(const TextTable& table, std::string_view key, std::string_view name) {
  if (const auto column = column_named(table, name)) return *column;
  const std::size_t columns = table.rows.front().fields.size();
  const double number = parse_number(name).value_or(0.0);
  for (std::size_t column = 1; column <= columns; ++column) {
    if (number == static_cast<double>(column)) return column - 1;
  }
  throw ProgramError(fmt::format(
      "--columns: expected '{}' to be a column's name or number from 1 to {}, but got '{}': {} has {}", key,
      columns, name, table.file, names_in(table)));
}

TrackColumns columns_given(const TextTable& table, const std::string& given) {
  constexpr std::string_view keys[] = {"id", "time", "x", "y", "z"};
  const auto fail = [&] {
    throw ProgramError(fmt::format(
        "--columns: expected id=...,time=...,x=...,y=... and perhaps z=..., but got '{}'", given));
  };
  std::map<std::string_view, std::size_t> columns;
  for (std::string_view rest = given; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos) fail();
    const auto key = std::find(std::begin(keys), std::end(keys), entry.substr(0, equals));
    if (key == std::end(keys) || columns.count(*key) > 0) fail();
    columns[*key] = column_of(table, *key, entry.substr(equals + 1));
  }
  const bool plane = columns.count("z") == 0;
  if (columns.size() != (plane ? 4u : 5u)) fail();
  TrackColumns found;
  found.format = "columns as given";
  found.id = columns["id"];
  found.time = columns["time"];
  found.x = columns["x"];
  found.y = columns["y"];
  if (!plane) found.z = columns["z"];
  return found;
}

/// From a comment such as "framerate: 25 fps".
std::optional<double> frame_rate_in(const TextTable& table) {
  constexpr std::string_view label = "framerate:";
  for (std::string_view comment : table.comments) {
    if (!comment.starts_with(label)) continue;
    comment.remove_prefix(std::min(comment.find_first_not_of(' ', label.size()), comment.size()));
    const auto rate = parse_number(comment.substr(0, comment.find(' ')));
    if (rate && *rate > 0) return rate;
  }
  return std::nullopt;
}

double frame_rate_of(const TextTable& table, const TrackColumns& columns, const TrackHints& hints) {
  if (hints.frame_rate) {
    if (*hints.frame_rate > 0) return *hints.frame_rate;
    throw ProgramError(fmt::format("--frame-rate: expected a number > 0, but got {}", *hints.frame_rate));
  }
  if (table.header.empty() || table.header[columns.time] != "frame") return columns.frame_rate;
  if (const auto rate = frame_rate_in(table)) return *rate;
  throw ProgramError(
      fmt::format("{}: expected --frame-rate, because column 'frame' counts frames", table.file));
}

}  // namespace

TrackColumns find_columns(const TextTable& table, const TrackHints& hints) {
  std::optional<TrackColumns> columns;
  if (!hints.columns.empty()) {
    columns = columns_given(table, hints.columns);
  } else {
    columns = recognise_obsmat(table);
    if (!columns) columns = recognise_header(table);
  }
  if (!columns) {
    throw ProgramError(
        fmt::format("{}: expected a UCY obsmat, PedPy or mosquito file, or columns id, time, x, y, or "
                    "--columns; it has {}",
                    table.file, names_in(table)));
  }
  columns->frame_rate = frame_rate_of(table, *columns, hints);
  return *columns;
}

}  // namespace kinesphere::program
