// Units of the numbers in columns, by names, options and what is usual.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/ascii_text.hpp"
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
      throw ProgramError(
          fmt::format("{}: {} does not say its unit, which beside ten-millionths of degrees is mostly {}: "
                      "say {}, or another unit",
                      head.file, column_text(head, column->place), unit,
                      columns_option(columns_text(head, columns, quantity, fmt::format(":{}", unit)))));
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
  throw ProgramError(
      fmt::format("{}: {} is in '{}', which is no known unit: say its unit with --columns, as {}={}:m",
                  head.file, column_text(head, place), unit, key_of(quantity), column_word(head, place)));
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
          fmt::format("--unit: expected none, or that of {} of {}, but got {}: {} says it of "
                      "one column",
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
      throw ProgramError(fmt::format("{}: {} does not say its unit: say {}, or another unit ({})", head.file,
                                     column_text(head, column.place),
                                     columns_option(columns_text(head, columns, quantity, ":kt")),
                                     unit_list(Measure::speed)));
    (column.has_unit ? with : without) = (column.has_unit ? with : without).value_or(quantity);
  }
  // Heights and speeds of places on the earth are metres and seconds.
  const bool zone = hints.positions.starts_with("utm");
  columns.in_metres = columns.geographic || zone || with.has_value();
  if (columns.geographic || !with || !without) return;
  throw ProgramError(fmt::format("{}: {} does not say its unit, but {} does: say {}={}:UNIT with --columns{}",
                                 head.file, column_text(head, columns[*without]->place),
                                 column_text(head, columns[*with]->place), key_of(*without),
                                 column_word(head, columns[*without]->place),
                                 measure_of(*without) == Measure::length ? ", or --unit" : ""));
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
    throw ProgramError(
        fmt::format("{}: {} does not say its unit, which is kt in positions of Traccar (fixTime, deviceId): "
                    "say {} (or :m/s)",
                    head.file, column_text(head, speed->place),
                    columns_option(columns_text(head, columns, Quantity::speed, ":kt"))));
  const auto craft = std::find_if(head.names.begin(), head.names.end(), [&](const std::string& name) {
    return is_of_aircraft(name) || is_of_ships(name);
  });
  if (craft == head.names.end()) return;
  const auto ask = [&](Quantity quantity, std::string_view what, std::string_view unit,
                       std::string_view other) {
    const auto& column = columns[quantity];
    if (!column || column->has_unit || (quantity == Quantity::z && is_of_ships(*craft))) return;
    throw ProgramError(
        fmt::format("{}: {} does not say its unit, which for {} (column '{}') may be {} or {}: say "
                    "{} (or :{})",
                    head.file, column_text(head, column->place), what, *craft, unit, other,
                    columns_option(columns_text(head, columns, quantity, fmt::format(":{}", unit))), other));
  };
  ask(Quantity::z, "heights of aircraft", "ft", "m");
  ask(Quantity::speed, "speeds of ships and aircraft", "kt", "m/s");
}

}  // namespace kinesphere::program
