// Lengths, speeds, accelerations and times of the command line, with their units.
#include "watch/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>

#include "ascii_text.hpp"
#include "number_text.hpp"
#include "program_error.hpp"

namespace kinesphere::program {
namespace {

struct NamedUnit {
  std::string_view name;
  double size;
};

constexpr NamedUnit measured_lengths[] = {{"m", 1.0},   {"km", 1e3},    {"cm", 0.01},   {"mm", 0.001},
                                          {"ft", foot}, {"NM", 1852.0}, {"nmi", 1852.0}};
constexpr NamedUnit measured_speeds[] = {
    {"m/s", 1.0}, {"kt", knot}, {"km/h", 1.0 / 3.6}, {"ft/min", foot / 60.0}, {"ft/s", foot}};
constexpr NamedUnit measured_accelerations[] = {{"m/s2", 1.0}, {"g", 9.80665}};
constexpr NamedUnit measured_times[] = {
    {"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}};

std::span<const NamedUnit> units_of(Measure measure) {
  switch (measure) {
    case Measure::length:
      return measured_lengths;
    case Measure::speed:
      return measured_speeds;
    case Measure::acceleration:
      return measured_accelerations;
    case Measure::time:
      break;
  }
  return measured_times;
}

std::string unit_list(Measure measure) {
  std::string list;
  for (const NamedUnit& unit : units_of(measure)) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  return list;
}

}  // namespace

double unit_named(std::string_view unit, Measure measure) {
  for (const NamedUnit& known : units_of(measure))
    if (same_name(known.name, unit)) return known.size;
  return 0.0;
}

double parse_measure(std::string_view text, Measure measure, std::string_view option) {
  std::size_t end = std::min(text.find_first_not_of("0123456789.+-eE"), text.size());
  // An e that no digit follows is not part of the number.
  while (end > 0 && (text[end - 1] == 'e' || text[end - 1] == 'E')) --end;
  std::string_view unit = text.substr(end);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  const auto number = parse_number(text.substr(0, end));
  const double size = unit.empty() ? 1.0 : unit_named(unit, measure);
  if (!number || size == 0.0 || *number < 0.0)
    throw ProgramError(fmt::format("{}: expected a number >= 0 and perhaps a unit ({}), but got '{}'", option,
                                   unit_list(measure), text));
  return *number * size;
}

ErrorBound parse_spread(std::string_view text, Measure measure, std::string_view option) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return ErrorBound(parse_measure(text, measure, option));
  return ErrorBound::cylinder(parse_measure(text.substr(0, colon), measure, option),
                              parse_measure(text.substr(colon + 1), measure, option));
}

}  // namespace kinesphere::program
