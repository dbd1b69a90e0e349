// Units in headers and options: their names and sizes.
#include "formats/fields/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <span>

#include "base/ascii_text.hpp"
#include "base/number_text.hpp"
#include "base/program_error.hpp"
#include "formats/fields/line_text.hpp"

namespace kinesphere::program {
namespace {

/// The first name is the usual one; others may follow, separated by blanks.
struct NamedUnit {
  std::string_view names;
  double size;
  double rate = 1.0;  ///< times: so many to a second
};

constexpr NamedUnit length_units[] = {
    {"m metre metres meter meters", 1.0},
    {"km kilometre kilometres kilometer kilometers", 1e3},
    {"cm centimetre centimetres centimeter centimeters", 0.01},
    {"mm millimetre millimetres millimeter millimeters", 0.001},
    {"um \xC2\xB5m \xCE\xBCm \xB5m micron microns micrometre micrometer", 1e-6},
    {"ft feet foot", foot},
    {"NM nmi", 1852.0},
    {"mi mile miles", 1609.344},
    {"yd yard yards", 0.9144},
    {"inch inches", 0.0254},
    {"FL hft", 100.0 * foot},
    {"kft", 1000.0 * foot}};
constexpr NamedUnit speed_units[] = {{"m/s mps m_s ms-1", 1.0},
                                     {"kt kts kn knot knots", knot},
                                     {"km/h kmh kph km_h", 1.0 / 3.6},
                                     {"ft/min fpm ft_min", foot / 60.0},
                                     {"ft/s fps ft_s", foot},
                                     {"mph", 1609.344 / 3600.0},
                                     {"cm/s cm_s", 0.01},
                                     {"mm/s mm_s", 0.001},
                                     {"km/s km_s", 1e3}};
constexpr NamedUnit acceleration_units[] = {{"m/s2", 1.0}, {"g", 9.80665}};
constexpr NamedUnit time_units[] = {{"s sec secs second seconds", 1.0},
                                    {"ms msec millis millisecond milliseconds", 1.0, 1e3},
                                    {"us usec \xC2\xB5s \xCE\xBCs \xB5s microsecond microseconds", 1.0, 1e6},
                                    {"ns nsec nanosecond nanoseconds", 1.0, 1e9},
                                    {"min minute minutes", 60.0},
                                    {"h hour hours", 3600.0},
                                    {"d day days", 86400.0}};
constexpr NamedUnit angle_units[] = {{"deg degree degrees \xC2\xB0 \xB0", 1.0},
                                     {"rad radian radians", 180.0 / 3.14159265358979323846},
                                     {"degE7", 1e-7},
                                     {"semicircles semicircle", 180.0 / 2147483648.0}};

std::span<const NamedUnit> units_of(Measure measure) {
  switch (measure) {
    case Measure::length:
      return length_units;
    case Measure::speed:
      return speed_units;
    case Measure::acceleration:
      return acceleration_units;
    case Measure::time:
      return time_units;
    case Measure::angle:
      return angle_units;
    case Measure::none:
      break;
  }
  return {};
}

const NamedUnit* known_unit(std::string_view name, Measure measure) {
  for (const NamedUnit& unit : units_of(measure))
    if (is_word_of(name, unit.names)) return &unit;
  return nullptr;
}

}  // namespace

std::optional<double> unit_named(std::string_view unit, Measure measure) {
  const NamedUnit* const known = known_unit(unit, measure);
  return known == nullptr ? std::nullopt : std::optional(known->size / known->rate);
}

std::optional<TimeUnit> time_unit_named(std::string_view name) {
  const NamedUnit* const known = known_unit(name, Measure::time);
  return known == nullptr ? std::nullopt : std::optional(TimeUnit{known->size, known->rate});
}

std::string unit_list(Measure measure) {
  std::string list;
  for (const NamedUnit& unit : units_of(measure))
    list += (list.empty() ? "" : ", ") + std::string(unit.names.substr(0, unit.names.find(' ')));
  return list;
}

double parse_measure(std::string_view text, Measure measure, std::string_view option) {
  std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  // An e that no digit follows is not part of the number.
  while (end > 0 && (text[end - 1] == 'e' || text[end - 1] == 'E')) --end;
  std::string_view unit = text.substr(end);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  const auto number = parse_number(text.substr(0, end));
  const double size = unit.empty() ? 1.0 : unit_named(unit, measure).value_or(0.0);
  if (!number || size == 0.0 || *number < 0.0)
    throw ProgramError(fmt::format("{}: expected a number >= 0 and perhaps a unit ({}), but got '{}'", option,
                                   unit_list(measure), text));
  // Reachable sets of such tracks would have no digits left; no recording has 300 years.
  const double largest = measure == Measure::time ? 1e10 : 1e15;
  if (*number * size > largest)
    throw ProgramError(fmt::format("{}: expected at most {:g}{}, but got '{}'", option, largest,
                                   measure == Measure::time ? " s" : "", text));
  return *number * size;
}

bool has_unit_behind(std::string_view number) { return !parse_number(number).has_value(); }

bool is_pixel(std::string_view unit) {
  return same_name(unit, "px") || same_name(unit, "pixel") || same_name(unit, "pixels");
}

bool is_unit(std::string_view text) {
  const std::string_view unit = without_brackets(text);
  if (is_pixel(unit)) return true;
  constexpr Measure all[] = {Measure::length, Measure::speed, Measure::acceleration, Measure::time,
                             Measure::angle};
  return std::any_of(std::begin(all), std::end(all),
                     [&](Measure measure) { return known_unit(unit, measure) != nullptr; });
}

std::string_view without_brackets(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && (text.front() == '(' || text.front() == '[') &&
      (text.back() == ')' || text.back() == ']'))
    text = trimmed(text.substr(1, text.size() - 2));
  return text;
}

}  // namespace kinesphere::program
