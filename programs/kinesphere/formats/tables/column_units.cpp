// Units of the numbers in columns, by names, options and what is usual; and what the times are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/units.hpp"
#include "formats/tables/column_steps.hpp"

namespace kinesphere::program {
namespace {

/// True if the row of units has one without brackets for the times, so that all its labels are units.
bool has_plain_units(const TableHead& head) {
  for (std::size_t place = 0; place < std::min(head.names.size(), head.units.size()); ++place) {
    const auto meaning = meaning_of(head.names[place]);
    if (meaning && meaning->quantity == Quantity::time && unit_named(head.units[place], Measure::time))
      return true;
  }
  return false;
}

/// Asks for the units of heights and speeds beside ten-millionths of degrees: in messages of MAVLink and GPS
/// they are mostly millimetres, and centimetres or millimetres a second.
void ask_beside_whole_degrees(const TableHead& head, const TableColumns& columns) {
  if (*unit_named("degE7", Measure::angle) != columns.x().unit) return;
  for (const auto& [quantity, unit] : {std::pair(Quantity::z, "mm"), std::pair(Quantity::vx, "cm/s"),
                                       std::pair(Quantity::vy, "cm/s"), std::pair(Quantity::vz, "cm/s")}) {
    const auto& column = columns[quantity];
    if (column && !column->has_unit)
      refuse(head,
             "{} does not say its unit, which beside ten-millionths of degrees is mostly {}: say {}, or "
             "another unit",
             column_text(head, column->place), unit,
             columns_option(columns_text(head, columns, quantity, fmt::format(":{}", unit))));
  }
}

/// Returns the columns that are lengths or speeds.
std::vector<Quantity> measured(const TableColumns& columns) {
  std::vector<Quantity> all;
  for (std::size_t k = 0; k < quantity_count; ++k) {
    const Measure measure = measure_of(static_cast<Quantity>(k));
    if (columns.of[k] && (measure == Measure::length || measure == Measure::speed))
      all.push_back(static_cast<Quantity>(k));
  }
  return all;
}

/// Reads a rate from a comment such as "framerate: 25 fps".
std::optional<double> frame_rate_in(const TableHead& head) {
  constexpr std::string_view label = "framerate:";
  for (std::string_view comment : head.comments) {
    if (!comment.starts_with(label)) continue;
    comment.remove_prefix(std::min(comment.find_first_not_of(' ', label.size()), comment.size()));
    const auto rate = parse_number(comment.substr(0, comment.find(' ')));
    if (rate && *rate > 0) return rate;
  }
  return std::nullopt;
}

}  // namespace

bool set_unit(Column& column, std::string_view unit, Quantity quantity) {
  const Measure measure = measure_of(quantity);
  // Lengths that are degrees turn out to be so below.
  auto size = unit_named(unit, measure);
  if (!size && measure == Measure::length && !is_pixel(unit)) size = unit_named(unit, Measure::angle);
  if (!size) return measure == Measure::length && is_pixel(unit);
  column.unit = *size;
  column.has_unit = true;
  return true;
}

std::string unit_of_column(const TableHead& head, std::size_t place, Quantity quantity) {
  if (!head.names.empty()) {
    if (const auto meaning = meaning_of(head.names[place]); meaning && meaning->quantity == quantity) {
      if (!meaning->unit.empty()) return meaning->unit;
    } else if (const auto unit = unit_in_name(head.names[place], measure_of(quantity)); !unit.empty()) {
      return std::string(unit);
    }
  }
  if (head.units.empty() || measure_of(quantity) == Measure::none) return {};
  const std::string_view text = head.units[place];
  const std::string_view unit = without_brackets(text);
  Column ignored;
  if (unit.empty() || unit == "-" || set_unit(ignored, unit, quantity))
    return std::string(unit == "-" ? "" : unit);
  // A label without brackets says nothing, but among units.
  if (unit.size() == trimmed(text).size() && !has_plain_units(head)) return {};
  // A time in a unit of length is a mistake that some programs make in all files.
  if (quantity == Quantity::time || is_unit(unit)) return {};
  refuse(head, "{} is in '{}', which is no known unit: say its unit with --columns, as {}={}:m",
         column_text(head, place), unit, key_of(quantity), column_word(head, place));
}

void take_unit_of_column(const TableHead& head, Quantity quantity, Column& column) {
  const std::string unit = unit_of_column(head, column.place, quantity);
  if (!unit.empty()) set_unit(column, unit, quantity);
}

void understand_lengths(const TableHead& head, const ColumnHints& hints, TableColumns& columns) {
  const bool unit_is_said = !hints.unit.empty() && hints.unit != "deg";
  const double said =
      unit_is_said && hints.unit != "nm" ? unit_named(hints.unit, Measure::length).value_or(0.0) : 0.0;
  if (unit_is_said && said == 0.0)
    throw ProgramError(
        fmt::format("--unit: expected {} or deg, but got '{}'", unit_list(Measure::length), hints.unit));
  const std::vector<Quantity> lengths = measured(columns);
  std::optional<Quantity> with, without;
  for (const Quantity quantity : lengths) {
    Column& column = *columns[quantity];
    if (unit_is_said && column.has_unit && column.unit != said && measure_of(quantity) == Measure::length)
      throw ProgramError(
          fmt::format("--unit: expected none, or that of {} of {}, but got {}: {} says it of one column",
                      column_text(head, column.place), head.file, hints.unit,
                      columns_option(fmt::format("{}={}:{}", key_of(quantity),
                                                 column_word(head, column.place), hints.unit))));
    const auto meaning = head.names.empty() ? std::nullopt : meaning_of(head.names[column.place]);
    const bool needs_unit = meaning && meaning->needs_unit;
    if (unit_is_said && !column.has_unit && measure_of(quantity) == Measure::length) {
      column.unit = said;
      column.has_unit = true;
    }
    // Where lengths are metres, speeds are metres a second.
    if (said == 1.0 && measure_of(quantity) == Measure::speed && !needs_unit) column.has_unit = true;
    if (!column.has_unit && needs_unit)
      refuse(head, "{} does not say its unit: say {}, or another unit ({})", column_text(head, column.place),
             columns_option(columns_text(head, columns, quantity, ":kt")), unit_list(Measure::speed));
    (column.has_unit ? with : without) = (column.has_unit ? with : without).value_or(quantity);
  }
  // Heights and speeds of places on the earth are metres and seconds.
  const bool zone = hints.positions.starts_with("utm");
  columns.in_metres = columns.geographic || zone || with.has_value();
  if (columns.geographic || !with || !without) return;
  refuse(head, "{} does not say its unit, but {} does: say {}={}:UNIT with --columns{}",
         column_text(head, columns[*without]->place), column_text(head, columns[*with]->place),
         key_of(*without), column_word(head, columns[*without]->place),
         measure_of(*without) == Measure::length ? ", or --unit" : "");
}

void ask_for_units_of_craft(const TableHead& head, const TableColumns& columns) {
  if (!columns.geographic) return;
  const auto is_of_ships = [](const std::string& name) {
    return same_name(name, "mmsi") || same_name(name, "sourcemmsi") || same_name(name, "imo");
  };
  ask_beside_whole_degrees(head, columns);
  const auto has = [&](std::string_view plain) {
    return std::any_of(head.names.begin(), head.names.end(),
                       [&](const std::string& name) { return plain_name(name) == plain; });
  };
  const auto& speed = columns[Quantity::speed];
  if (speed && !speed->has_unit && has("fixtime") && has("deviceid"))
    refuse(
        head,
        "{} does not say its unit, which is kt in positions of Traccar (fixTime, deviceId): say {} (or :m/s)",
        column_text(head, speed->place), columns_option(columns_text(head, columns, Quantity::speed, ":kt")));
  const auto craft = std::find_if(head.names.begin(), head.names.end(), [&](const std::string& name) {
    return hints_at(name, NameHint::aircraft) || is_of_ships(name);
  });
  if (craft == head.names.end()) return;
  const auto ask = [&](Quantity quantity, std::string_view what, std::string_view unit,
                       std::string_view other) {
    const auto& column = columns[quantity];
    if (!column || column->has_unit || (quantity == Quantity::z && is_of_ships(*craft))) return;
    refuse(head, "{} does not say its unit, which for {} (column '{}') may be {} or {}: say {} (or :{})",
           column_text(head, column->place), what, *craft, unit, other,
           columns_option(columns_text(head, columns, quantity, fmt::format(":{}", unit))), other);
  };
  ask(Quantity::z, "heights of aircraft", "ft", "m");
  ask(Quantity::speed, "speeds of ships and aircraft", "kt", "m/s");
}

void find_parts_of_time(const TableHead& head, TableColumns& columns) {
  const auto& time = columns[Quantity::time];
  if (!time || head.names.empty()) return;
  const std::string& name = head.names[time->place];
  const bool is_whole = is_whole_seconds(name);
  const bool is_given = columns.format == "columns as given" && is_whole && time->said_unit.empty();
  if (columns.format != "table" && !is_given) return;
  for (std::size_t place = 0; place < head.names.size(); ++place)
    if (are_parts_of_time(name, head.names[place])) columns.nanoseconds = place;
  const bool is_part = hints_at(name, NameHint::part_of_clock);
  for (std::size_t place = 0; place < head.names.size(); ++place)
    if (place != time->place && place != columns.nanoseconds &&
        (hints_at(head.names[place], NameHint::part_of_time) ||
         (is_part && hints_at(head.names[place], NameHint::part_of_clock))))
      refuse(head,
             "{} may be a part of the time, as {} is: write both as one column of times, or say {} to use "
             "the latter alone",
             column_text(head, place), column_text(head, time->place),
             columns_option(columns_text(head, columns, Quantity::time, is_whole ? ":s" : "")));
}

void understand_time(const TableHead& head, ColumnUse use, TableColumns& columns) {
  auto &time = columns[Quantity::time], &frame = columns[Quantity::frame];
  const auto meaning = time && !head.names.empty() ? meaning_of(head.names[time->place]) : std::nullopt;
  const bool is_frame = frame || (meaning && meaning->quantity == Quantity::frame);
  if (is_frame) {
    if (frame) time = std::exchange(frame, std::nullopt);
    columns.time_kind = TimeKind::frames;
    // The rate of these films turns out with their last row.
    if (columns.film != TableColumns::Film::none && use == ColumnUse::reports) columns.time_unit_said = false;
    if (columns.time_unit_said || !columns.time_problem.empty()) return;
    if (const auto rate = frame_rate_in(head)) {
      columns.time_unit.rate = *rate;
      columns.time_unit_said = true;
    } else {
      columns.time_problem =
          fmt::format("expected --frame-rate, because {} counts frames", column_text(head, time->place));
    }
    return;
  }
  if (time->has_unit) {
    // The quotient keeps 1/1000 exact.
    columns.time_unit =
        time->unit < 1.0 ? TimeUnit{1.0, std::round(1.0 / time->unit)} : TimeUnit{time->unit, 1.0};
    columns.time_unit_said = true;
  } else if (use == ColumnUse::positions && !(meaning && meaning->quantity == Quantity::time)) {
    columns.time_problem = fmt::format(
        "expected --time-unit or --frame-rate, because column {} does not say whether its numbers are "
        "seconds",
        time->place + 1);
  }
}

void apply_time_hints(const ColumnHints& hints, TableColumns& columns) {
  const std::string& unit = hints.time_unit;
  const bool frames = unit == "frames";
  columns.times_are_clocks = unit == "clock";
  const auto known = columns.times_are_clocks ? TimeUnit{} : time_unit_named(unit);
  if (!unit.empty() && !frames && !known)
    throw ProgramError(
        fmt::format("--time-unit: expected s, ms, us, ns, min, h, d, frames or clock, but got '{}'", unit));
  if (known && hints.frame_rate)
    throw ProgramError(
        fmt::format("--frame-rate: expected only where frames are counted, not with --time-unit {}", unit));
  if (hints.frame_rate) {
    if (!(*hints.frame_rate > 0))
      throw ProgramError(fmt::format("--frame-rate: expected a number > 0, but got {}", *hints.frame_rate));
    columns.time_kind = TimeKind::frames;
    columns.time_unit = {1.0, *hints.frame_rate};
    columns.film = TableColumns::Film::none;
  } else if (known) {
    columns.time_kind = TimeKind::number;
    columns.time_unit = *known;
    columns.film = TableColumns::Film::none;
  } else if (frames && (columns.time_kind != TimeKind::frames || !columns.time_problem.empty())) {
    columns.time_problem = "expected --frame-rate with --time-unit frames";
    return;
  } else {
    return;
  }
  columns.time_unit_said = true;
  columns.time_problem.clear();
}

}  // namespace kinesphere::program
