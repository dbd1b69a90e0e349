// Finds the columns of a recording or stream in a table, and the units of their numbers.
#include "formats/tables/table_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/field_text.hpp"
#include "formats/fields/units.hpp"
#include "formats/tables/column_steps.hpp"
#include "formats/tables/presets.hpp"

namespace kinesphere::program {
namespace {

/// Leaves out what is not read.
void keep_used(const ColumnHints& hints, ColumnUse use, TableColumns& columns) {
  for (std::size_t k = 0; k < quantity_count; ++k)
    if (!is_used(static_cast<Quantity>(k), hints, use)) columns.of[k].reset();
}

void require_sizes(const TableHead& head, const TableColumns& columns) {
  if (!columns[Quantity::length] || !columns[Quantity::width])
    refuse(head,
           "expected columns of length and width for --sizes, by their names or --columns "
           "length=...,width=...; it has {}",
           head.text());
  if (columns.is_ais)
    refuse(head,
           "expected positions of the middle for --sizes, but those of AIS are of the antenna, anywhere on "
           "the ship");
}

/// Finds the columns of a quaternion, where no other says which way bodies point.
void find_rotation(const TableHead& head, TableColumns& columns) {
  if (columns[Quantity::heading] || columns[Quantity::course]) return;
  constexpr std::array<std::array<std::string_view, 4>, 2> names{
      {{"qw", "qx", "qy", "qz"}, {"rotation0", "rotation1", "rotation2", "rotation3"}}};
  for (const auto& four : names) {
    std::array<std::size_t, 4> places{};
    const bool has_all = std::ranges::all_of(four, [&](const std::string_view& name) {
      const auto found =
          std::ranges::find_if(head.names, [&](const std::string& each) { return plain_name(each) == name; });
      places[static_cast<std::size_t>(&name - four.data())] =
          static_cast<std::size_t>(found - head.names.begin());
      return found != head.names.end();
    });
    if (has_all) columns.rotation = places;
  }
}

/// True where a column of widths has the same name: height and width, bb_h and bb_w.
bool is_height_of_box(const TableHead& head, std::string_view name) {
  const std::string plain = plain_name(name);
  return std::any_of(head.names.begin(), head.names.end(), [&](const std::string& other) {
    std::string width = plain_name(other);
    if (const std::size_t at = width.find("width"); at != std::string::npos) {
      width.replace(at, 5, "height");
    } else if (width.ends_with('w')) {
      width.back() = 'h';
    }
    return width == plain && plain_name(other) != plain;
  });
}

/// Asks about a column that may be a height, where no column is known to be one.
void ask_for_heights(const TableHead& head, const TableColumns& columns) {
  if (columns.z()) return;
  std::vector<std::string> heights;
  std::size_t first = 0;
  for (std::size_t place = 0; place < head.names.size(); ++place) {
    const std::string& name = head.names[place];
    const bool is_known = std::any_of(columns.of.begin(), columns.of.end(),
                                      [&](const auto& column) { return column && column->place == place; });
    if (is_known || is_height_of_box(head, name) || !hints_at(name, NameHint::height)) continue;
    if (heights.empty()) first = place;
    heights.push_back(fmt::format("'{}'", name));
  }
  if (heights.empty()) return;
  const std::string others = columns_text(head, columns);
  refuse(
      head, "{} may be {}: say {} to use {}, or {} to leave heights out",
      heights.size() == 1 ? "column " + heights.front() : fmt::format("columns {}", fmt::join(heights, ", ")),
      heights.size() == 1 ? "a height" : "heights",
      columns_option(fmt::format("{},z={}", others, column_word(head, first))),
      heights.size() == 1 ? "it" : "one", columns_option(others));
}

/// True for rows of person and frame: frame id x z(=0) y vx vz(=0) vy, without a header. Numbers that are no
/// frames may be times, as in the recordings of ATC: time id x y z speed and two angles.
bool looks_like_obsmat(const TableHead& head) {
  constexpr double most_frames = 1e8;
  const auto& fields = head.first;
  if (!head.names.empty() || fields.size() != 8) return false;
  const auto frame = parse_number(fields[0]);
  return frame && *frame == std::floor(*frame) && *frame < most_frames && parse_number(fields[3]) == 0.0 &&
         parse_number(fields[6]) == 0.0;
}

TableColumns unlabelled_obsmat(const TableHead& head) {
  TableColumns columns = preset_columns(head, *preset_named("ucy"));
  columns.format = "obsmat";
  columns.film = TableColumns::Film::none;
  columns.time_problem =
      "it looks like an obsmat, which does not say its frame rate: expected --format ucy, --format eth or "
      "--frame-rate";
  return columns;
}

TableColumns recognised(const TableHead& head, const ColumnHints& hints, ColumnUse use) {
  if (!hints.columns.empty()) {
    TableColumns columns = said_columns(head, hints.columns, nullptr);
    columns.format = "columns as given";
    // Those of the bodies are found beside the time that is said.
    if (!columns.id_is_file && (columns[Quantity::time] || columns[Quantity::frame]))
      find_pairs(head, hints, columns);
    return columns;
  }
  if (!hints.format.empty() && hints.format != "table") {
    if (const Preset* const preset = preset_named(hints.format)) return preset_columns(head, *preset);
    throw ProgramError(
        fmt::format("--format: expected one of {}, but got '{}'", preset_names(), hints.format));
  }
  if (hints.format.empty()) {
    if (const Preset* const preset = recognised_preset(head)) return preset_columns(head, *preset);
    if (use == ColumnUse::positions && looks_like_obsmat(head)) return unlabelled_obsmat(head);
  }
  TableColumns columns = usual_columns(head, hints, use);
  find_pairs(head, hints, columns);
  return columns;
}

/// Makes x and y longitude and latitude if their names, their units or the hints say so.
void understand_places(const TableHead& head, const ColumnHints& hints, TableColumns& columns) {
  auto &x = columns[Quantity::x], &y = columns[Quantity::y];
  auto &lon = columns[Quantity::longitude], &lat = columns[Quantity::latitude];
  const auto is_angle = [&](const std::optional<Column>& column, Quantity angle) {
    if (!column || head.names.empty()) return false;
    const std::string& name = head.names[column->place];
    if (hints_at(name, angle == Quantity::longitude ? NameHint::longitude : NameHint::latitude)) return true;
    const auto meaning = meaning_of(name);
    return meaning && (meaning->quantity == angle || unit_named(meaning->unit, Measure::angle).has_value());
  };
  const bool said = hints.positions == "lonlat" || hints.unit == "deg";
  const bool by_name = is_angle(x, Quantity::longitude) && is_angle(y, Quantity::latitude);
  const bool swapped = is_angle(x, Quantity::latitude) && is_angle(y, Quantity::longitude) && !by_name;
  if (swapped && hints.positions.empty())
    throw ProgramError(fmt::format(
        "--columns: expected a longitude as x and a latitude as y, but got '{}' and '{}': say lon={},lat={}",
        head.names[x->place], head.names[y->place], column_word(head, y->place),
        column_word(head, x->place)));
  const bool one_alone = is_angle(x, Quantity::longitude) != is_angle(y, Quantity::latitude);
  if (x && y && one_alone && !swapped && !said && hints.positions != "plane")
    refuse(head, "{} are degrees, but {} are not said to be: say --positions lonlat or plane",
           column_text(head, is_angle(x, Quantity::longitude) ? x->place : y->place),
           column_text(head, is_angle(x, Quantity::longitude) ? y->place : x->place));
  if (x && y && !lon && !lat && hints.positions != "plane" && (said || by_name)) {
    lon = std::exchange(x, std::nullopt);
    lat = std::exchange(y, std::nullopt);
    take_unit_of_column(head, Quantity::longitude, *lon);
    take_unit_of_column(head, Quantity::latitude, *lat);
  }
  if (lon && lat && !x && !y) {
    if (hints.positions == "plane") {
      x = Column{.place = std::exchange(lon, std::nullopt)->place};
      y = Column{.place = std::exchange(lat, std::nullopt)->place};
    }
    columns.positions_said = true;
  }
  if (!hints.positions.empty() || !hints.unit.empty()) columns.positions_said = true;
  columns.geographic = lon.has_value();
}

/// True for a field with two coordinates: POINT (8.5 47), (1, 2) or 47.5,8.5.
bool has_two_coordinates(std::string_view field) {
  constexpr std::string_view number = "0123456789+-.";
  const std::size_t begin = field.find_first_of(number), end = field.find_last_of(number);
  if (begin == std::string_view::npos) return false;
  const std::string_view pair = field.substr(begin, end + 1 - begin);
  const std::size_t gap = std::min(pair.find_first_not_of(number), pair.size());
  const std::size_t second = std::min(pair.find_first_not_of(", ", gap), pair.size());
  const std::string_view one = pair.substr(0, gap), other = pair.substr(second);
  const bool are_numbers = second > gap && parse_number(one) && parse_number(other);
  // 47,5 is one number.
  const bool are_decimals = one.find('.') != one.npos && other.find('.') != other.npos;
  return are_numbers && (begin > 0 || are_decimals);
}

/// Returns what to do about a table without a column that others of its kind have; empty for others.
std::string advice_on_columns(const TableHead& head, const TableColumns& columns) {
  for (std::size_t place = 0; place < std::min(head.first.size(), head.names.size()); ++place)
    if (has_two_coordinates(head.first[place]))
      return fmt::format(" (both coordinates of {} have to be in columns of their own)",
                         column_text(head, place));
  const char separator = head.separator;
  if (!columns.bodies.empty() && !columns[Quantity::time] && !columns[Quantity::frame])
    return fmt::format(
        " (if each row is a frame, awk 'NR==1{{print \"frame{0}\"$0;next}}{{print NR-2\"{0}\"$0}}' numbers "
        "them)",
        separator == '\t' ? std::string("\\t") : std::string(1, separator));
  return {};
}

/// Returns the message about columns that were not found, with those that were.
std::string missing_columns_text(const TableHead& head, const TableColumns& columns) {
  const std::string text = fmt::format(
      "{}: expected columns for id, time, x and y (or lon and lat) by their usual names, --columns or "
      "--format; it has {}",
      head.file, head.text());
  const std::string_view above = "lines above the header have to be left out or begin with #";
  if (head.names.empty())
    return fmt::format(
        "{}: say --columns id=...,time=...,x=...,y=... with the numbers of its columns, whose first row is "
        "{} ({})",
        text, shown_field(fmt::format("{}", fmt::join(head.first, " "))), above);
  constexpr std::size_t fewest = 4;
  TableColumns likely = columns;
  add_likely_columns(head, likely);
  if (columns_text(head, likely).empty() && head.names.size() < fewest)
    return fmt::format("{} ({})", text, above);
  return fmt::format("{}: say {}{}", text, whole_columns_option(head, columns),
                     advice_on_columns(head, columns));
}

void require_columns(const TableHead& head, const ColumnHints& hints, const TableColumns& columns) {
  const auto has = [&](Quantity quantity) { return columns[quantity].has_value(); };
  const bool plane = has(Quantity::x) && has(Quantity::y);
  const bool earth = has(Quantity::longitude) && has(Quantity::latitude);
  const bool half =
      has(Quantity::x) != has(Quantity::y) || has(Quantity::longitude) != has(Quantity::latitude);
  const bool has_id = has(Quantity::id) || columns.id_is_file || !columns.bodies.empty();
  const bool has_time = has(Quantity::time) != has(Quantity::frame), has_place = plane != earth && !half;
  if (!has_id || !has_time || !has_place) {
    if (!hints.columns.empty())
      throw ProgramError(
          fmt::format("--columns: expected id=... (or id=@file), time=... (or frame=...), x=...,y=... (or "
                      "lon=...,lat=...) and perhaps z=..., but got '{}'",
                      hints.columns));
    throw ProgramError(missing_columns_text(head, columns));
  }
  if (has(Quantity::vx) != has(Quantity::vy) ||
      (has(Quantity::course) && !has(Quantity::speed) && !hints.sizes) ||
      (has(Quantity::vx) && has(Quantity::speed)))
    refuse(head, "expected either vx and vy or speed and course, or neither: say which with --columns");
}

/// Finds columns of N, S, E and W, each behind that of its degrees.
void find_hemispheres(const TableHead& head, TableColumns& columns) {
  if (!columns.geographic || !columns.bodies.empty()) return;
  const auto behind = [&](const Column& angle, std::string_view letters) -> std::optional<std::size_t> {
    const std::size_t place = angle.place + 1;
    if (place >= head.columns() || head.first[place].size() != 1) return std::nullopt;
    return letters.find(head.first[place][0]) != std::string_view::npos ? std::optional(place) : std::nullopt;
  };
  columns.east_or_west = behind(columns.x(), "EWew");
  columns.north_or_south = behind(columns.y(), "NSns");
}

void list_unused(const TableHead& head, TableColumns& columns) {
  for (std::size_t place = 0; place < head.columns(); ++place) {
    const bool is_used =
        std::any_of(columns.of.begin(), columns.of.end(),
                    [&](const auto& column) { return column && column->place == place; }) ||
        std::any_of(
            columns.bodies.begin(), columns.bodies.end(),
            [&](const auto& body) { return body.x == place || body.y == place || body.z == place; }) ||
        columns.east_or_west == place || columns.north_or_south == place || columns.nanoseconds == place ||
        (columns.rotation && std::ranges::count(*columns.rotation, place) > 0);
    if (!is_used) columns.unused.push_back(place);
  }
}

}  // namespace

TableColumns find_columns(const TableHead& head, const ColumnHints& hints, ColumnUse use) {
  const bool may_be_zone = use == ColumnUse::positions;
  if (!(hints.positions.empty() || hints.positions == "lonlat" || hints.positions == "plane" ||
        (may_be_zone && hints.positions.starts_with("utm:"))))
    throw ProgramError(fmt::format("--positions: expected lonlat{}, but got '{}'",
                                   may_be_zone ? ", plane or a UTM zone such as utm:33N" : " or plane",
                                   hints.positions));
  TableColumns columns = recognised(head, hints, use);
  keep_used(hints, use, columns);
  columns.decimal_comma = has_decimal_commas(head.separator);
  understand_places(head, hints, columns);
  require_columns(head, hints, columns);
  if (hints.columns.empty() && !columns.has_own_heights) ask_for_heights(head, columns);
  find_parts_of_time(head, columns);
  understand_lengths(head, hints, columns);
  understand_time(head, use, columns);
  apply_time_hints(hints, columns);
  if (hints.dates != DateOrder::unknown) columns.dates = hints.dates;
  columns.height_advice =
      fmt::format("{} (or :m)", columns_option(columns_text(head, columns, Quantity::z, ":ft")));
  columns.time_advice = columns_option(columns_text(head, columns, {}, {}, Quantity::date));
  columns.file_advice = columns_option("id=@file," + columns_text(head, columns, {}, {}, Quantity::id));
  ask_for_units_of_craft(head, columns);
  find_hemispheres(head, columns);
  if (hints.sizes) find_rotation(head, columns);
  if (columns.geographic && columns.z() && !columns.z()->has_unit) columns.format += ", heights in m";
  if (!hints.where.empty())
    columns.where =
        columns.where.empty() ? hints.where : fmt::format("({}) and ({})", columns.where, hints.where);
  list_unused(head, columns);
  columns.is_ais = columns[Quantity::id] && !head.names.empty() &&
                   same_name(head.names[columns[Quantity::id]->place], "MMSI");
  if (hints.sizes) require_sizes(head, columns);
  return columns;
}

}  // namespace kinesphere::program
